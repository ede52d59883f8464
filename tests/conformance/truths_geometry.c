/* SPDX-License-Identifier: MIT */
/* Where rays go: projection, samples, mirrors, edges and corners. */
#include <math.h>

#include "certify/scene_builder.h"
#include "scene/camera.h"
#include "truth_check.h"
#include "truths.h"

/* How far the picture of a small solid, by its centre of gravity, lies from the pixel (x, y). */
static double distance_to_picture(const HdFrame *frame, double x, double y) {
    double sum = 0.0, sum_x = 0.0, sum_y = 0.0;
    for (int j = 0; j < frame->height; j++)
        for (int i = 0; i < frame->width; i++) {
            sum += red(frame, i, j);
            sum_x += red(frame, i, j) * (i + 0.5);
            sum_y += red(frame, i, j) * (j + 0.5);
        }
    return sum > 0.0 ? hypot(sum_x / sum - x, sum_y / sum - y) : 1e9;
}

/* A small octahedron shows up around the pixel that perspective geometry gives for its centre. */
static void check_projection(Check *check) {
    static const HdVec3 points[] = {
        {0.0, 0.0, 0.0}, {0.7, 0.3, -0.4}, {-1.1, 2.0, 0.8}, {0.2, -1.0, 0.9}, {-0.6, 0.4, -0.7}};
    HdScene scene;
    HdCamera camera;
    begin(check);
    for (size_t i = 0; i < sizeof points / sizeof points[0]; i++) {
        build_scene(&scene, 161, 121, 1, 0, 1, 0);
        scene.background = hd_vec3(0.0, 0.0, 0.0);
        build_solid(&scene, 0, HD_OCTAHEDRON, points[i], 0.06, hd_vec3(1.0, 1.0, 1.0), 0);
        scene.solids[0].face = scene.solids[0].rim = glowing(1.0);
        build_camera(&camera, hd_vec3(1.0, -5.0, 0.5), hd_vec3(0.1, 0.2, 0.0), 50.0);
        HdFrame frame = render(check, &scene, &camera);
        HdVec3 offset = hd_sub(points[i], camera.eye);
        double depth = hd_dot(offset, camera.forward) * camera.tangent_of_half_fov;
        double x = 80.5 * (1.0 + hd_dot(offset, camera.right) / depth);
        double y = 60.5 - 80.5 * hd_dot(offset, camera.up) / depth;
        double miss = distance_to_picture(&frame, x, y);
        expect(check, "projection (pixels off, above 0.5)", (int)x, (int)y, miss > 0.5 ? miss : 0.0,
               0.0);
        hd_frame_free(&frame);
        hd_scene_free(&scene);
    }
}

/* Between mirrors that glow alike, the radiance is a geometric series, whatever the ray does. */
static void check_mirror_series(Check *check) {
    HdScene scene;
    HdCamera camera;
    const int depth = 9;
    const double reflection = 0.85;
    begin(check);
    for (int kind = 0; kind < HD_SOLID_KIND_COUNT; kind++) {
        build_scene(&scene, 24, 16, 1, depth, 1, 0);
        build_solid(&scene, 0, (HdSolidKind)kind, hd_vec3(0.0, 0.0, 0.0), 2.0,
                    hd_vec3(0.2, 0.2, 0.2), 0);
        scene.solids[0].rim_width = 0.0;
        scene.solids[0].face = glowing(0.2);
        scene.solids[0].face.reflection = reflection;
        build_camera(&camera, hd_vec3(0.05, -0.1, 0.02), hd_vec3(0.3, 0.9, 0.1), 100.0);
        HdFrame frame = render(check, &scene, &camera);
        double expected = 0.2 * (1.0 - pow(reflection, depth + 1)) / (1.0 - reflection);
        for (int y = 0; y < frame.height; y++)
            for (int x = 0; x < frame.width; x++)
                expect(check, "mirror series", x, y, red(&frame, x, y), expected);
        expect(check, "number of rays", 0, 0, (double)hd_frame_rays(&frame),
               24.0 * 16.0 * (depth + 1));
        hd_frame_free(&frame);
        hd_scene_free(&scene);
    }
}

/* How far a point lies from the nearest odd whole number: the walls of the unfolded box. */
static double wall_distance(double a) {
    return fabs(fmod(fabs(a), 2.0) - 1.0);
}

/* Follows a straight line through the mirror box [-1, 1]^3 unfolded over all of space; returns how
   many walls it passes before it meets a rim, or -1 where that is too close to call. */
static int unfolded_bounces(HdVec3 eye, HdVec3 d, double rim, int limit) {
    const double o[3] = {eye.x, eye.y, eye.z}, v[3] = {d.x, d.y, d.z};
    double next[3];
    for (int a = 0; a < 3; a++)
        next[a] = v[a] > 0.0 ? 1.0 : -1.0;
    for (int bounces = 0; bounces <= limit; bounces++) {
        int axis = 0;
        double t[3];
        for (int a = 0; a < 3; a++) {
            t[a] = fabs(v[a]) > 1e-12 ? (next[a] - o[a]) / v[a] : 1e30;
            axis = t[a] < t[axis] ? a : axis;
        }
        double nearest = 1.0;
        for (int a = 0; a < 3; a++)
            if (a != axis)
                nearest = fmin(nearest, wall_distance(o[a] + t[axis] * v[a]));
        if (fabs(nearest - rim) < 1e-4 || nearest < 1e-4)
            return -1;
        if (nearest < rim)
            return bounces;
        next[axis] += v[axis] > 0.0 ? 2.0 : -2.0;
    }
    return limit + 1;
}

/* A box of mirrors with glowing rims, against its unfolding. */
static void check_mirror_box(Check *check) {
    HdScene scene;
    HdCamera camera;
    const int depth = 14;
    const double reflection = 0.75, rim = 0.1;
    int compared = 0;
    begin(check);
    build_scene(&scene, 48, 36, 1, depth, 1, 0);
    build_solid(&scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 0.0), sqrt(3.0), hd_vec3(1.0, 1.0, 1.0),
                0);
    scene.solids[0].face = glowing(0.0);
    scene.solids[0].face.reflection = reflection;
    scene.solids[0].rim = glowing(0.8);
    scene.solids[0].rim_width = rim;
    build_camera(&camera, hd_vec3(0.1, -0.3, 0.2), hd_vec3(0.4, 0.9, -0.1), 95.0);
    HdFrame frame = render(check, &scene, &camera);
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++) {
            HdVec3 d = direction_at(&scene, &camera, x + 0.5, y + 0.5);
            int bounces = unfolded_bounces(camera.eye, d, rim, depth);
            if (bounces < 0)
                continue;
            double expected = bounces <= depth ? 0.8 * pow(reflection, bounces) : 0.0;
            expect(check, "mirror box", x, y, red(&frame, x, y), expected);
            compared++;
        }
    expect_compared(check, "mirror box", compared, 1500);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
}

/* How many of a pixel's n * n samples see the wall below, or -1 where that is too close to call. */
static int samples_on_wall(const HdScene *scene, const HdCamera *camera, int x, int y, int n) {
    int inside = 0;
    for (int s = 0; s < n * n; s++) {
        HdVec3 d =
            direction_at(scene, camera, x + (s % n + 0.5) / n, y + (double)(s / n) / n + 0.5 / n);
        double px = d.x / d.y * 4.0, pz = d.z / d.y * 4.0;
        double border = 31.0 - 60.5 * (90.0 - pz) / 180.0;
        if (fabs(px - border) < 1e-4)
            return -1;
        inside += px < border;
    }
    return inside;
}

/* An upright glowing wall with a slanting border: a pixel shows the share of its samples on it. */
static void check_half_plane(Check *check) {
    HdScene scene;
    HdCamera camera;
    const int n = 5;
    int partly = 0;
    begin(check);
    build_scene(&scene, 32, 24, n, 0, 0, 0);
    scene.background = hd_vec3(0.0, 0.0, 0.0);
    build_floor(&scene, hd_vec3(-90.0, 4.0, 90.0), hd_vec3(31.0, 4.0, 90.0),
                hd_vec3(-29.5, 4.0, -90.0), hd_vec3(-90.0, 4.0, -90.0));
    scene.floor.material = glowing(1.0);
    build_camera(&camera, hd_vec3(0.0, 0.0, 0.0), hd_vec3(0.0, 1.0, 0.0), 80.0);
    HdFrame frame = render(check, &scene, &camera);
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++) {
            int inside = samples_on_wall(&scene, &camera, x, y, n);
            if (inside < 0)
                continue;
            expect(check, "half-plane", x, y, red(&frame, x, y), (double)inside / (n * n));
            partly += inside > 0 && inside < n * n;
        }
    expect_compared(check, "half-plane, at the border", partly, 20);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
}

/* Through clear glass that halves the light at each face, a white background is 4^-k, exactly, for
   every ray that passes k solids, also for rays aimed at edges and corners: no face is missed or
   met twice. Returns how many pixels look through the solid. */
static int check_no_leaks(Check *check, HdSolidKind kind, HdVec3 aim) {
    HdScene scene;
    HdCamera camera;
    int crossed = 0;
    build_scene(&scene, 17, 17, 1, 8, 1, 0);
    scene.background = hd_vec3(1.0, 1.0, 1.0);
    build_glass(&scene, 0, kind, hd_vec3(0.0, 0.0, 0.0), 1.0, 0.5, 1.0);
    scene.solids[0].face.ambient = scene.solids[0].face.diffuse = 0.0;
    scene.solids[0].face.specular = 0.0;
    build_camera(&camera, hd_vec3(2.1, -3.2, 1.3), aim, 1e-5);
    HdFrame frame = render(check, &scene, &camera);
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++) {
            double found = red(&frame, x, y);
            bool crossed_twice = found == 0.25, missed = found == 1.0;
            expect(check, "faces crossed in pairs", x, y, crossed_twice || missed ? 1.0 : found,
                   1.0);
            crossed += crossed_twice;
        }
    hd_frame_free(&frame);
    hd_scene_free(&scene);
    return crossed;
}

static void check_edges_and_corners(Check *check) {
    begin(check);
    for (int kind = 0; kind < HD_SOLID_KIND_COUNT; kind++) {
        HdPlatonic shape;
        int crossed = 0;
        hd_platonic((HdSolidKind)kind, &shape);
        for (int v = 0; v < shape.vertex_count; v++)
            crossed += check_no_leaks(check, (HdSolidKind)kind, shape.vertex[v]);
        for (int e = 0; e < shape.edge_count; e += 3) {
            HdVec3 a = shape.vertex[shape.edge[e].vertex[0]];
            HdVec3 b = shape.vertex[shape.edge[e].vertex[1]];
            crossed += check_no_leaks(check, (HdSolidKind)kind,
                                      hd_add(hd_scale(a, 0.375), hd_scale(b, 0.625)));
        }
        expect_compared(check, "faces crossed in pairs", crossed, 1);
    }
}

void check_geometry(Check *check) {
    check_projection(check);
    check_mirror_series(check);
    check_mirror_box(check);
    check_half_plane(check);
    check_edges_and_corners(check);
}
