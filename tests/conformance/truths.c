/* SPDX-License-Identifier: MIT */
#include "truths.h"

#include <math.h>
#include <stdio.h>

#include "camera.h"
#include "render_scene.h"
#include "scene_builder.h"

typedef struct Check {
    HdRenderer *renderer;
    HdPrecision precision;
    const char *label;
    int checked, failed;
    double tolerance; /* relative */
    bool quiet;       /* only the first wrong pixel of a truth is printed */
} Check;

static HdFrame render(const Check *check, const HdScene *scene, const HdCamera *camera) {
    return render_scene(check->renderer, scene, camera, check->precision, "truths");
}

static void begin(Check *check) {
    check->quiet = false;
}

static void expect(Check *check, const char *truth, int x, int y, double found, double expected) {
    check->checked++;
    if (fabs(found - expected) <= check->tolerance * (fabs(expected) + 1e-3))
        return;
    check->failed++;
    if (!check->quiet)
        printf("UNTRUE %s at (%d, %d): %.9g, expected %.9g on %s\n", truth, x, y, found, expected,
               check->label);
    check->quiet = true;
}

/* A truth about no pixel is none. */
static void expect_compared(Check *check, const char *truth, int compared, int at_least) {
    check->checked++;
    if (compared >= at_least)
        return;
    check->failed++;
    printf("UNTRUE %s: %d pixels say something, expected at least %d on %s\n", truth, compared,
           at_least, check->label);
}

static double red(const HdFrame *frame, int x, int y) {
    return (double)frame->rgb[3 * (y * frame->width + x)];
}

/* The direction through the point (x, y), counted in pixels from the upper left corner. */
static HdVec3 direction_at(const HdScene *scene, const HdCamera *camera, double x, double y) {
    double step = 2.0 * camera->tangent_of_half_fov / scene->width;
    HdVec3 right = hd_scale(camera->right, (x - 0.5 * scene->width) * step);
    HdVec3 down = hd_scale(camera->up, -(y - 0.5 * scene->height) * step);
    return hd_normalize(hd_add(camera->forward, hd_add(right, down)));
}

/* A surface that shows its colour and nothing else. */
static HdMaterial glowing(double radiance) {
    HdMaterial material = build_material(hd_vec3(radiance, radiance, radiance), 0.0, 0.0);
    material.ambient = 1.0;
    material.diffuse = material.specular = 0.0;
    return material;
}

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

/* What Phong's formula gives for a point of a level floor that is seen in direction `d`. */
static double phong_radiance(const HdScene *scene, HdVec3 point, HdVec3 d) {
    const HdMaterial *m = &scene->floor.material;
    HdVec3 mirrored = hd_vec3(d.x, d.y, -d.z);
    double radiance = m->ambient * m->colour.x;
    for (int i = 0; i < scene->light_count; i++) {
        HdVec3 to_light = hd_sub(scene->lights[i].position, point);
        double distance = hd_length(to_light), d0 = scene->lights[i].falloff.distance;
        double f = d0 > 0.0 ? 1.0 / (1.0 + distance * distance / (d0 * d0)) : 1.0;
        HdVec3 l = hd_scale(to_light, 1.0 / distance);
        radiance += f * scene->lights[i].intensity.x *
                    (m->diffuse * m->colour.x * l.z +
                     m->specular * pow(fmax(hd_dot(mirrored, l), 0.0), m->shininess));
    }
    return radiance;
}

/* Phong's formula on a floor, evaluated by itself for each pixel. */
static void check_phong(Check *check) {
    HdScene scene;
    HdCamera camera;
    int compared = 0;
    begin(check);
    build_scene(&scene, 40, 30, 1, 0, 0, 2);
    scene.background = hd_vec3(0.0, 0.0, 0.0);
    build_square_floor(&scene, 50.0, -1.0);
    scene.floor.material.ambient = 0.1;
    build_light(&scene, 0, hd_vec3(1.0, 2.0, 2.0), hd_vec3(1.5, 1.5, 1.5));
    build_light(&scene, 1, hd_vec3(-2.0, 1.0, 0.5), hd_vec3(0.7, 0.7, 0.7));
    scene.lights[1].falloff.distance = 1.5;
    build_camera(&camera, hd_vec3(0.0, -4.0, 1.0), hd_vec3(0.0, 0.5, -1.0), 60.0);
    HdFrame frame = render(check, &scene, &camera);
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++) {
            HdVec3 d = direction_at(&scene, &camera, x + 0.5, y + 0.5);
            if (d.z > -0.05)
                continue;
            HdVec3 point = hd_add(camera.eye, hd_scale(d, (-1.0 - camera.eye.z) / d.z));
            expect(check, "Phong", x, y, red(&frame, x, y), phong_radiance(&scene, point, d));
            compared++;
        }
    expect_compared(check, "Phong", compared, 800);
    hd_frame_free(&frame);
    hd_scene_free(&scene);
}

/* The middle pixel looks at `target` on the floor z = -1, lit by one light through whatever is
   between: the ratio of the radiance with and without the solids is the transmittance. */
static void check_transmittance(Check *check, const char *truth, HdScene *scene, HdVec3 target,
                                double expected) {
    HdCamera camera;
    double radiance[2];
    int solid_count = scene->solid_count;
    scene->background = hd_vec3(0.0, 0.0, 0.0);
    build_square_floor(scene, 40.0, -1.0);
    build_camera(&camera, hd_vec3(target.x + 1.0, target.y - 3.0, -0.6), target, 1.0);
    for (int i = 0; i < 2; i++) {
        scene->solid_count = i == 0 ? solid_count : 0;
        HdFrame frame = render(check, scene, &camera);
        radiance[i] = red(&frame, 1, 1);
        hd_frame_free(&frame);
    }
    scene->solid_count = solid_count;
    expect(check, truth, 1, 1, radiance[0] / radiance[1], expected);
    hd_scene_free(scene);
}

static void clear_glass(HdScene *scene, int solid, double transmission) {
    scene->solids[solid].rim_width = 0.0;
    scene->solids[solid].lights.per_edge = 0;
    scene->solids[solid].face.reflection = 0.0;
    scene->solids[solid].face.transmission = transmission;
}

static void build_glass_scene(HdScene *scene, int solids, HdVec3 light) {
    build_scene(scene, 3, 3, 1, 0, solids, 1);
    build_light(scene, 0, light, hd_vec3(1.0, 1.0, 1.0));
}

static void build_glass(HdScene *scene, int index, HdSolidKind kind, HdVec3 centre, double radius,
                        double grey, double transmission) {
    build_solid(scene, index, kind, centre, radius, hd_vec3(grey, grey, grey), 0);
    clear_glass(scene, index, transmission);
}

/* Light through n panes: every solid has two faces on the way, wherever the ray meets them. */
static void check_panes(Check *check) {
    HdScene scene;
    begin(check);
    for (int n = 0; n <= 4; n++) {
        build_glass_scene(&scene, n, hd_vec3(0.3, 0.2, 12.0));
        for (int i = 0; i < n; i++)
            build_glass(&scene, i, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 1.0 + 2.2 * i), 1.5, 0.9, 0.8);
        check_transmittance(check, "n panes", &scene, hd_vec3(0.1, 0.1, -1.0), pow(0.72, 2 * n));
    }
}

static void check_panes_through_corners(Check *check) {
    HdScene scene;
    begin(check);
    for (int n = 1; n <= 4; n++) {
        build_glass_scene(&scene, n, hd_vec3(0.0, 0.0, 12.0));
        for (int i = 0; i < n; i++)
            build_glass(&scene, i, HD_OCTAHEDRON, hd_vec3(0.0, 0.0, 1.0 + 2.5 * i), 1.0, 0.5, 1.0);
        check_transmittance(check, "n panes, through corners", &scene, hd_vec3(0.0, 0.0, -1.0),
                            pow(0.5, 2 * n));
    }
}

/* Through two opposite edges of a cube: as clear glass, and where a rim stops the light. */
static void check_panes_through_edges(Check *check) {
    HdScene scene;
    begin(check);
    for (int rim = 0; rim < 2; rim++) {
        build_glass_scene(&scene, 1, hd_vec3(4.0, 0.25, 6.0));
        build_glass(&scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 2.0), sqrt(3.0), 0.5, 1.0);
        scene.solids[0].rim_width = rim ? 0.05 : 0.0;
        check_transmittance(check, rim ? "opaque rim" : "two panes, through edges", &scene,
                            hd_vec3(-3.0, 0.25, -1.0), rim ? 0.0 : 0.25);
    }
}

/* One face is on the way. */
static void check_light_inside(Check *check) {
    HdScene scene;
    begin(check);
    build_glass_scene(&scene, 1, hd_vec3(0.0, 0.0, 2.0));
    build_glass(&scene, 0, HD_DODECAHEDRON, hd_vec3(0.0, 0.0, 2.0), 1.0, 0.5, 0.9);
    check_transmittance(check, "light inside", &scene, hd_vec3(0.3, 0.2, -1.0), 0.45);
}

/* How far a ray runs within a solid, by its planes; below zero where it passes by. */
static double way_within(const HdSolid *solid, HdVec3 eye, HdVec3 d) {
    HdPlatonic shape;
    HdVec3 from = hd_sub(eye, solid->centre);
    double enter = 0.0, leave = 1e9;
    hd_platonic(solid->kind, &shape);
    for (int i = 0; i < shape.face_count; i++) {
        double outside = hd_dot(from, shape.face_normal[i]) - shape.inradius * solid->circumradius;
        double approach = -hd_dot(d, shape.face_normal[i]);
        if (approach > 0.0)
            enter = fmax(enter, outside / approach);
        else if (approach < 0.0)
            leave = fmin(leave, outside / approach);
    }
    return leave - enter;
}

/* The solid shows its ambient light, and no other, in front of a black background. */
static void expect_only_ambient(Check *check, const HdScene *scene, const HdCamera *camera,
                                const HdFrame *frame, double ambient) {
    int compared = 0;
    for (int y = 0; y < frame->height; y++)
        for (int x = 0; x < frame->width; x++) {
            HdVec3 d = direction_at(scene, camera, x + 0.5, y + 0.5);
            double way = way_within(&scene->solids[0], camera->eye, d);
            if (fabs(way) < 1e-3)
                continue;
            expect(check, "own edge lights", x, y, red(frame, x, y), way > 0.0 ? ambient : 0.0);
            compared += way > 0.0;
        }
    expect_compared(check, "own edge lights", compared, 400);
    expect(check, "own edge lights, tests", 0, 0, (double)frame->shadow_tests, 0.0);
}

/* The faces of a solid that is alone with its edge lights see none of them from outside. */
static void check_own_lights(Check *check) {
    HdScene scene;
    HdCamera camera;
    begin(check);
    for (int kind = 0; kind < HD_SOLID_KIND_COUNT; kind++) {
        build_scene(&scene, 60, 60, 1, 0, 1, 0);
        scene.background = hd_vec3(0.0, 0.0, 0.0);
        build_solid(&scene, 0, (HdSolidKind)kind, hd_vec3(0.3, 0.2, 0.1), 1.0,
                    hd_vec3(0.5, 0.5, 0.5), 3);
        scene.solids[0].face.ambient = 0.25;
        scene.solids[0].lights.intensity = 1.0;
        scene.solids[0].lights.disc_radius = scene.solids[0].rim_width = 0.0;
        build_camera(&camera, hd_vec3(2.1, -3.2, 1.3), hd_vec3(0.3, 0.2, 0.1), 40.0);
        HdFrame frame = render(check, &scene, &camera);
        expect_only_ambient(check, &scene, &camera, &frame, 0.25 * 0.5);
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
        expect(check, "number of rays", 0, 0, (double)hd_frame_rays(&frame), 24.0 * 16.0 * (depth + 1));
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

void check_truths(HdRenderer *renderer, HdPrecision precision, const char *label, int *checked,
                  int *failed) {
    Check check = {.renderer = renderer,
                   .precision = precision,
                   .label = label,
                   .tolerance = precision == HD_PRECISION_FLOAT ? 3e-5 : 3e-7};
    check_projection(&check);
    check_phong(&check);
    check_panes(&check);
    check_panes_through_corners(&check);
    check_panes_through_edges(&check);
    check_light_inside(&check);
    check_own_lights(&check);
    check_mirror_series(&check);
    check_mirror_box(&check);
    check_half_plane(&check);
    check_edges_and_corners(&check);
    *checked += check.checked;
    *failed += check.failed;
}
