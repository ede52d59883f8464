/* SPDX-License-Identifier: MIT */
/* A scene that is turned as a whole gives the picture that it gave before. */
#include <math.h>

#include "base/trigonometry.h"
#include "certify/scene_builder.h"
#include "scene/camera.h"
#include "truth_check.h"
#include "truths.h"

/* About x, then y, then z, each counterclockwise as seen from the axis's tip. */
static HdVec3 turn(HdVec3 v, HdVec3 degrees) {
    HdVec3 s = hd_scale(degrees, HD_PI / 180.0);
    v = hd_vec3(v.x, cos(s.x) * v.y - sin(s.x) * v.z, sin(s.x) * v.y + cos(s.x) * v.z);
    v = hd_vec3(cos(s.y) * v.x + sin(s.y) * v.z, v.y, cos(s.y) * v.z - sin(s.y) * v.x);
    return hd_vec3(cos(s.z) * v.x - sin(s.z) * v.y, sin(s.z) * v.x + cos(s.z) * v.y, v.z);
}

static void build_turned(HdScene *scene, HdCamera *camera, HdVec3 degrees) {
    build_scene(scene, 48, 36, 1, 3, 2, 1);
    build_light(scene, 0, turn(hd_vec3(3.0, -2.0, 5.0), degrees), hd_vec3(1.0, 0.9, 0.8));
    build_solid(scene, 0, HD_TETRAHEDRON, turn(hd_vec3(-1.2, 0.1, 0.0), degrees), 1.1,
                hd_vec3(1.0, 0.3, 0.2), 3);
    build_solid(scene, 1, HD_HEXAHEDRON, turn(hd_vec3(1.2, 0.3, 0.1), degrees), 1.2,
                hd_vec3(0.3, 0.5, 1.0), 2);
    for (int s = 0; s < 2; s++) {
        scene->solids[s].rotation_degrees = degrees;
        scene->solids[s].lights.colour_count = 3;
        for (int i = 0; i < 3; i++)
            scene->solids[s].lights.colours[i] = hd_vec3(i == 0, i == 1, i == 2);
    }
    build_square_floor(scene, 5.0, -1.4);
    build_texture(&scene->floor.texture, 5, 9);
    for (int i = 0; i < 4; i++)
        scene->floor.corners[i] = turn(scene->floor.corners[i], degrees);
    build_camera(camera, hd_vec3(0.4, -4.0, 1.2), hd_vec3(0.0, 0.0, 0.0), 60.0);
    camera->eye = turn(camera->eye, degrees);
    camera->right = turn(camera->right, degrees);
    camera->up = turn(camera->up, degrees);
    camera->forward = turn(camera->forward, degrees);
}

/* Rounding may push a sample over an edge: a few pixels may differ, and the counts a little. */
static void check_turned(Check *check, HdVec3 degrees) {
    const double small = check->target->precision == HD_PRECISION_FLOAT ? 1e-3 : 1e-6;
    HdScene scene;
    HdCamera camera;
    int different = 0;
    begin(check);
    build_turned(&scene, &camera, hd_vec3(0.0, 0.0, 0.0));
    HdFrame before = render_last(check, &scene, &camera);
    build_turned(&scene, &camera, degrees);
    HdFrame after = render_last(check, &scene, &camera);
    for (int y = 0; y < before.height; y++)
        for (int x = 0; x < before.width; x++)
            for (int c = 0; c < 3; c++)
                different +=
                    fabs(channel_of(&after, x, y, c) - channel_of(&before, x, y, c)) > small;
    int most = before.width * before.height * 3 / 100;
    expect_compared(check, "turned scene, of pixels alike", most - different, 0);
    double tests = (double)before.shadow_tests;
    expect_compared(check, "turned scene, of tests alike",
                    fabs((double)after.shadow_tests - tests) < 1e-3 * tests, 1);
    hd_frame_free(&before);
    hd_frame_free(&after);
}

void check_rotation(Check *check) {
    check_turned(check, hd_vec3(0.0, 0.0, 90.0));
    check_turned(check, hd_vec3(20.0, 30.0, 40.0));
    check_turned(check, hd_vec3(-100.0, 15.0, 200.0));
}
