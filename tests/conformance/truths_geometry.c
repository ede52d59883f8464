/* SPDX-License-Identifier: MIT */
/* Hits of faces: a ray crosses a closed solid's surface twice, wherever it is aimed, and a solid's
   own faces never hide what lies in front of them. Random rays show none of it. */
#include <math.h>

#include "truths.h"
#include "verify/scene_builder.h"

/* Between mirrors that glow equally, the radiance is a geometric series, whatever path the ray
   takes. */
static void check_mirror_series(Check *check) {
    HdScene scene;
    HdCamera camera;
    const int depth = 9;
    const double reflection = 0.85;
    for (int kind = 0; kind < HD_SOLID_KIND_COUNT; kind++) {
        build_scene(&scene, 24, 16, 1, depth, 1, 0);
        build_solid(&scene, 0, (HdSolidKind)kind, grey(0.0), 2.0, grey(0.2), 0);
        scene.solids[0].rim_width = 0.0;
        scene.solids[0].face = glowing(0.2);
        scene.solids[0].face.reflection = reflection;
        build_camera(&camera, hd_vec3(0.05, -0.1, 0.02), hd_vec3(0.3, 0.9, 0.1), 100.0);
        HdFrame frame = render_last(check, &scene, &camera);
        double expected = 0.2 * (1.0 - pow(reflection, depth + 1)) / (1.0 - reflection);
        for (int y = 0; y < frame.height; y++)
            for (int x = 0; x < frame.width; x++)
                expect(check, "mirror series", x, y, red(&frame, x, y), expected);
        expect(check, "number of rays", 0, 0, (double)hd_frame_rays(&frame),
               24.0 * 16.0 * (depth + 1));
        hd_frame_free(&frame);
    }
}

/* Clear glass halves the light at each face. A white background is then exactly 4^-k for every ray
   that passes k solids, also at edges and corners: no face is missed or hit twice. Returns the
   number of pixels that look through the solid. */
static int check_no_leaks(Check *check, HdSolidKind kind, HdVec3 aim) {
    HdScene scene;
    HdCamera camera;
    int crossed = 0;
    build_scene(&scene, 17, 17, 1, 8, 1, 0);
    scene.background = grey(1.0);
    build_glass(&scene, 0, kind, grey(0.0), 1.0, 0.5, 1.0);
    scene.solids[0].face.ambient = scene.solids[0].face.diffuse = 0.0;
    scene.solids[0].face.specular = 0.0;
    build_camera(&camera, hd_vec3(2.1, -3.2, 1.3), aim, 1e-5);
    HdFrame frame = render_last(check, &scene, &camera);
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++) {
            double found = red(&frame, x, y);
            bool crossed_twice = found == 0.25, missed = found == 1.0;
            expect(check, "faces crossed in pairs", x, y, crossed_twice || missed ? 1.0 : found,
                   1.0);
            crossed += crossed_twice;
        }
    hd_frame_free(&frame);
    return crossed;
}

static void check_edges_and_corners(Check *check) {
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

/* The middle pixel looks at `target` on the floor z = -1, lit by one light through the solids. The
   ratio of the radiance with and without them is the transmittance. */
static void check_transmittance(Check *check, const char *truth, HdScene *scene, HdVec3 target,
                                double expected) {
    HdCamera camera;
    double radiance[2];
    int solid_count = scene->solid_count;
    scene->background = grey(0.0);
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

static void build_glass_scene(HdScene *scene, int solids, HdVec3 light) {
    build_scene(scene, 3, 3, 1, 0, solids, 1);
    build_light(scene, 0, light, grey(1.0));
}

static void check_panes_through_corners(Check *check) {
    HdScene scene;
    for (int n = 1; n <= 4; n++) {
        build_glass_scene(&scene, n, hd_vec3(0.0, 0.0, 12.0));
        for (int i = 0; i < n; i++)
            build_glass(&scene, i, HD_OCTAHEDRON, hd_vec3(0.0, 0.0, 1.0 + 2.5 * i), 1.0, 0.5, 1.0);
        check_transmittance(check, "n panes, through corners", &scene, hd_vec3(0.0, 0.0, -1.0),
                            pow(0.5, 2 * n));
    }
}

/* Through two opposite edges of a cube: as clear glass, and with a rim that stops the light. */
static void check_panes_through_edges(Check *check) {
    HdScene scene;
    for (int rim = 0; rim < 2; rim++) {
        build_glass_scene(&scene, 1, hd_vec3(4.0, 0.25, 6.0));
        build_glass(&scene, 0, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 2.0), sqrt(3.0), 0.5, 1.0);
        scene.solids[0].rim_width = rim ? 0.05 : 0.0;
        check_transmittance(check, rim ? "opaque rim" : "two panes, through edges", &scene,
                            hd_vec3(-3.0, 0.25, -1.0), rim ? 0.0 : 0.25);
    }
}

/* The outer faces of a lone solid get no light from its edge lights: they show its ambient light
   and no other, in front of a black background. */
static void check_own_lights(Check *check) {
    const double ambient = 0.25 * 0.5;
    HdScene scene;
    HdCamera camera;
    for (int kind = 0; kind < HD_SOLID_KIND_COUNT; kind++) {
        int seen = 0;
        build_scene(&scene, 60, 60, 1, 0, 1, 0);
        scene.background = grey(0.0);
        build_solid(&scene, 0, (HdSolidKind)kind, hd_vec3(0.3, 0.2, 0.1), 1.0, grey(0.5), 3);
        scene.solids[0].face.ambient = 0.25;
        scene.solids[0].lights.intensity = 1.0;
        scene.solids[0].lights.disc_radius = scene.solids[0].rim_width = 0.0;
        build_camera(&camera, hd_vec3(2.1, -3.2, 1.3), hd_vec3(0.3, 0.2, 0.1), 40.0);
        HdFrame frame = render_last(check, &scene, &camera);
        for (int y = 0; y < frame.height; y++)
            for (int x = 0; x < frame.width; x++) {
                const double found = red(&frame, x, y);
                expect(check, "own edge lights", x, y, found, found != 0.0 ? ambient : 0.0);
                seen += found != 0.0;
            }
        expect_compared(check, "own edge lights", seen, 400);
        expect(check, "own edge lights, tests", 0, 0, (double)frame.shadow_tests, 0.0);
        hd_frame_free(&frame);
    }
}

void check_geometry(Check *check) {
    check_mirror_series(check);
    check_edges_and_corners(check);
    check_panes_through_corners(check);
    check_panes_through_edges(check);
    check_own_lights(check);
}
