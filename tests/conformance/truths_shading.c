/* SPDX-License-Identifier: MIT */
/* Phong's formula and the transmittance on the way to a light. */
#include <math.h>

#include "certify/scene_builder.h"
#include "scene/camera.h"
#include "truth_check.h"
#include "truths.h"

static double faded(const HdFalloff *falloff, double distance) {
    double length = falloff->end > 0.0 ? falloff->end : falloff->distance;
    double ratio = length > 0.0 ? distance / length : 0.0;
    if (falloff->end > 0.0)
        return pow(fmax(1.0 - ratio * ratio, 0.0), 2.0);
    return 1.0 / (1.0 + ratio * ratio);
}

/* What Phong's formula gives for a point of a level floor that is seen in direction `d`. */
static double phong_radiance(const HdScene *scene, HdVec3 point, HdVec3 d) {
    const HdMaterial *m = &scene->floor.material;
    HdVec3 mirrored = hd_vec3(d.x, d.y, -d.z);
    double radiance = m->ambient * m->colour.x;
    for (int i = 0; i < scene->light_count; i++) {
        HdVec3 to_light = hd_sub(scene->lights[i].position, point);
        double distance = hd_length(to_light);
        HdVec3 l = hd_scale(to_light, 1.0 / distance);
        radiance += faded(&scene->lights[i].falloff, distance) * scene->lights[i].intensity.x *
                    (m->diffuse * m->colour.x * l.z +
                     m->specular * pow(fmax(hd_dot(mirrored, l), 0.0), m->shininess));
    }
    return radiance;
}

/* How many lights reach the point: the others end before it. */
static int lights_in_reach(const HdScene *scene, HdVec3 point) {
    int count = 0;
    for (int i = 0; i < scene->light_count; i++) {
        double distance = hd_length(hd_sub(scene->lights[i].position, point));
        double end = scene->lights[i].falloff.end;
        count += end == 0.0 || distance < end;
    }
    return count;
}

/* Phong's formula on a floor, evaluated by itself for each pixel; the second light fades. */
static void check_phong(Check *check, const char *truth, HdFalloff falloff, int dark_at_least) {
    HdScene scene;
    HdCamera camera;
    int compared = 0, in_reach = 0;
    begin(check);
    build_scene(&scene, 40, 30, 1, 0, 0, 2);
    scene.background = hd_vec3(0.0, 0.0, 0.0);
    build_square_floor(&scene, 50.0, -1.0);
    scene.floor.material.ambient = 0.1;
    build_light(&scene, 0, hd_vec3(1.0, 2.0, 2.0), hd_vec3(1.5, 1.5, 1.5));
    build_light(&scene, 1, hd_vec3(-2.0, 1.0, 0.5), hd_vec3(0.7, 0.7, 0.7));
    scene.lights[1].falloff = falloff;
    build_camera(&camera, hd_vec3(0.0, -4.0, 1.0), hd_vec3(0.0, 0.5, -1.0), 60.0);
    HdFrame frame = render(check, &scene, &camera);
    for (int y = 0; y < frame.height; y++)
        for (int x = 0; x < frame.width; x++) {
            HdVec3 d = direction_at(&scene, &camera, x + 0.5, y + 0.5);
            HdVec3 point = hd_add(camera.eye, hd_scale(d, (-1.0 - camera.eye.z) / d.z));
            if (d.z > 0.0 || fmax(fabs(point.x), fabs(point.y)) > 50.0)
                continue;
            in_reach += lights_in_reach(&scene, point);
            if (d.z > -0.05)
                continue;
            expect(check, truth, x, y, red(&frame, x, y), phong_radiance(&scene, point, d));
            compared++;
        }
    expect_compared(check, truth, compared, 800);
    expect_compared(check, truth, 2 * compared - in_reach, dark_at_least);
    expect(check, truth, 0, 0, (double)frame.shadow_tests, in_reach);
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

static void build_glass_scene(HdScene *scene, int solids, HdVec3 light) {
    build_scene(scene, 3, 3, 1, 0, solids, 1);
    build_light(scene, 0, light, hd_vec3(1.0, 1.0, 1.0));
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

/* Whatever runs from the floor to the light meets outer sides going in and inner ones going out. */
static void check_inner_panes(Check *check) {
    HdScene scene;
    begin(check);
    for (int inside = 0; inside < 2; inside++) {
        build_glass_scene(&scene, 2, hd_vec3(0.3, 0.2, inside ? 3.5 : 12.0));
        for (int i = 0; i < 2; i++) {
            build_glass(&scene, i, HD_HEXAHEDRON, hd_vec3(0.0, 0.0, 1.0 + 2.2 * i), 1.5, 0.9, 0.8);
            scene.solids[i].face.has_inner_side = true;
            scene.solids[i].face.inner_transmission = 0.5;
        }
        check_transmittance(check, inside ? "inner sides, light inside" : "inner sides", &scene,
                            hd_vec3(0.1, 0.1, -1.0), 0.72 * 0.45 * 0.72 * (inside ? 1.0 : 0.45));
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
    HdPlatonic shape = shape_of(solid);
    HdVec3 from = hd_sub(eye, solid->centre);
    double enter = 0.0, leave = 1e9;
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

void check_shading(Check *check) {
    check_phong(check, "Phong", (HdFalloff){.distance = 1.5}, -1000);
    check_phong(check, "Phong, a light that ends", (HdFalloff){.end = 3.5}, 100);
    check_panes(check);
    check_panes_through_corners(check);
    check_panes_through_edges(check);
    check_inner_panes(check);
    check_light_inside(check);
    check_own_lights(check);
}
