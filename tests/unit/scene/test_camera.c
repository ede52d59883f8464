/* SPDX-License-Identifier: MIT */
#include <float.h>

#include "scene/camera.h"
#include "unit_test.h"

static const double tolerance = 1e-14;

/* The flight of the official example. */
static HdScene example(void) {
    return (HdScene){
        .frame_count = 1024,
        .eye = {.cylinder = {.r0 = 7.0,
                             .z0 = 3.0,
                             .r_amplitude = 2.0,
                             .z_amplitude = 1.0,
                             .r_frequency = 2.0,
                             .z_frequency = 6.0,
                             .phi_frequency = 1.0}},
        .target = {.cylinder = {.r0 = 2.0,
                                .r_amplitude = 0.5,
                                .z_amplitude = 0.1,
                                .r_frequency = 1.0,
                                .z_frequency = 4.0,
                                .phi_frequency = 1.0}},
        .field_of_view_degrees = 120.0,
    };
}

/* Eye and target stand still. */
static HdScene still(HdCylinderPath eye, HdCylinderPath target) {
    return (HdScene){.frame_count = 1,
                     .eye = {.cylinder = eye},
                     .target = {.cylinder = target},
                     .field_of_view_degrees = 90.0};
}

static HdCamera camera_of(const HdScene *scene, int frame) {
    static HdError error;
    HdCamera camera;
    if (hd_camera_at(&camera, scene, frame, &error) != HD_OK)
        fail_msg("%s", error.message);
    return camera;
}

static void expect_vector(HdVec3 actual, double x, double y, double z, double off) {
    expect_near(actual.x, x, off);
    expect_near(actual.y, y, off);
    expect_near(actual.z, z, off);
}

TEST(test_known_positions) {
    const HdPath path = {.cylinder = {.r0 = 5.0,
                                      .z0 = 1.0,
                                      .phi0 = 0.0,
                                      .r_amplitude = 2.0,
                                      .z_amplitude = 0.5,
                                      .r_frequency = 1.0,
                                      .z_frequency = 2.0,
                                      .phi_frequency = 1.0}};
    expect_vector(hd_path_point(&path, 0, 8), 5.0, 0.0, 1.0, tolerance);
    expect_vector(hd_path_point(&path, 2, 8), 0.0, 7.0, 1.0, tolerance);
    expect_vector(hd_path_point(&path, 4, 8), -5.0, 0.0, 1.0, tolerance);
    expect_vector(hd_path_point(&path, 6, 8), 0.0, -3.0, 1.0, tolerance);
    const double r = 5.0 + sqrt(2.0);
    expect_vector(hd_path_point(&path, 1, 8), r * sqrt(0.5), r * sqrt(0.5), 1.5, tolerance);
}

TEST(test_phases_and_start) {
    const double quarter = acos(0.0);
    const HdPath path = {.cylinder = {.r0 = 5.0,
                                      .z0 = 1.0,
                                      .phi0 = quarter,
                                      .r_amplitude = 2.0,
                                      .z_amplitude = 0.5,
                                      .r_phase = quarter,
                                      .z_phase = -quarter}};
    expect_vector(hd_path_point(&path, 0, 3), 0.0, 7.0, 0.5, tolerance);
    expect_vector(hd_path_point(&path, 2, 3), 0.0, 7.0, 0.5, tolerance);
}

TEST(test_every_frame_follows_the_formula) {
    const HdScene scene = example();
    for (int k = 0; k < 1024; k++) {
        const double t = 2.0 * acos(-1.0) * k / 1024.0;
        const double r = 7.0 + 2.0 * sin(2.0 * t);
        expect_vector(hd_path_point(&scene.eye, k, 1024), r * cos(t), r * sin(t),
                      3.0 + sin(6.0 * t), 1e-13);
    }
}

TEST(test_the_loop_closes) {
    const HdScene scene = example();
    const int counts[4] = {1, 7, 1024, 10000000};
    for (int i = 0; i < 4; i++) {
        const HdVec3 first = hd_path_point(&scene.eye, 0, counts[i]);
        const HdVec3 last = hd_path_point(&scene.eye, counts[i], counts[i]);
        expect_vector(last, first.x, first.y, first.z, tolerance);
    }
}

static void expect_orthonormal(const HdCamera *camera) {
    expect_near(hd_length(camera->right), 1.0, tolerance);
    expect_near(hd_length(camera->up), 1.0, tolerance);
    expect_near(hd_length(camera->forward), 1.0, tolerance);
    expect_near(hd_dot(camera->right, camera->up), 0.0, tolerance);
    expect_near(hd_dot(camera->right, camera->forward), 0.0, tolerance);
    expect_near(hd_dot(camera->up, camera->forward), 0.0, tolerance);
    const HdVec3 back = hd_cross(camera->right, camera->up);
    expect_vector(back, -camera->forward.x, -camera->forward.y, -camera->forward.z, tolerance);
}

TEST(test_the_basis_is_orthonormal_and_level) {
    const HdScene scene = example();
    for (int k = 0; k < 1024; k++) {
        const HdCamera camera = camera_of(&scene, k);
        const HdVec3 target = hd_path_point(&scene.target, k, 1024);
        expect_orthonormal(&camera);
        expect_near(camera.right.z, 0.0, tolerance);
        assert_true(camera.up.z > 0.0);
        const HdVec3 forward = hd_normalize(hd_sub(target, camera.eye));
        expect_vector(camera.forward, forward.x, forward.y, forward.z, tolerance);
    }
}

TEST(test_a_level_view) {
    const HdScene scene = still((HdCylinderPath){.r0 = 4.0}, (HdCylinderPath){.r0 = 1.0});
    const HdCamera camera = camera_of(&scene, 0);
    expect_vector(camera.eye, 4.0, 0.0, 0.0, tolerance);
    expect_vector(camera.forward, -1.0, 0.0, 0.0, tolerance);
    expect_vector(camera.right, 0.0, 1.0, 0.0, tolerance);
    expect_vector(camera.up, 0.0, 0.0, 1.0, tolerance);
}

/* The vertical view is compared with one that is tilted a little towards the axis. */
static void expect_vertical(double eye_z, double forward_z) {
    const double phi = 0.7;
    const HdCylinderPath eye = {.r0 = 3.0, .z0 = eye_z, .phi0 = phi};
    const HdScene vertical = still(eye, (HdCylinderPath){.r0 = 3.0, .phi0 = phi});
    const HdScene tilted = still(eye, (HdCylinderPath){.r0 = 3.0 - 1e-6, .phi0 = phi});
    const HdCamera camera = camera_of(&vertical, 0);
    const HdCamera near = camera_of(&tilted, 0);
    expect_orthonormal(&camera);
    expect_orthonormal(&near);
    expect_vector(camera.forward, 0.0, 0.0, forward_z, 0.0);
    expect_vector(camera.up, forward_z * cos(phi), forward_z * sin(phi), 0.0, tolerance);
    expect_vector(near.up, camera.up.x, camera.up.y, camera.up.z, 1e-6);
    expect_vector(near.right, camera.right.x, camera.right.y, camera.right.z, 1e-6);
}

TEST(test_straight_down) {
    expect_vertical(5.0, -1.0);
}

TEST(test_straight_up) {
    expect_vertical(-5.0, 1.0);
}

TEST(test_on_the_axis) {
    HdScene scene =
        still((HdCylinderPath){.z0 = 5.0, .phi_frequency = 1.0}, (HdCylinderPath){.z0 = 0.0});
    scene.frame_count = 4;
    const HdCamera camera = camera_of(&scene, 1);
    expect_orthonormal(&camera);
    expect_vector(camera.up, 0.0, -1.0, 0.0, tolerance);
}

static HdPath standing_at(double x, double y, double z) {
    return (HdPath){.is_fixed = true, .point = hd_vec3(x, y, z)};
}

static HdCamera fixed_camera(HdVec3 eye, HdVec3 target) {
    const HdScene scene = {.frame_count = 1,
                           .eye = {.is_fixed = true, .point = eye},
                           .target = {.is_fixed = true, .point = target},
                           .field_of_view_degrees = 90.0};
    return camera_of(&scene, 0);
}

TEST(test_a_fixed_point_stays) {
    HdPath path = standing_at(0.1, -0.2, 0.3);
    path.cylinder = (HdCylinderPath){.r0 = 5.0, .z0 = 1.0, .phi_frequency = 1.0};
    for (int frame = 0; frame < 7; frame++)
        expect_vector(hd_path_point(&path, frame, 7), 0.1, -0.2, 0.3, 0.0);
}

/* The picture's up is the direction towards the z axis, or away from it, and that of a view that is
   tilted a little. */
TEST(test_vertical_from_a_fixed_eye) {
    const HdVec3 places[4] = {
        {3.0, 4.0, 5.0}, {-3.0, 4.0, -5.0}, {-1e-3, -1e-3, 2.0}, {1e9, -2e9, 7e9}};
    for (int i = 0; i < 4; i++) {
        const HdVec3 eye = places[i];
        const double r = hypot(eye.x, eye.y);
        for (int sign = -1; sign <= 1; sign += 2) {
            const double height = sign * r;
            const HdCamera camera = fixed_camera(eye, hd_vec3(eye.x, eye.y, eye.z + height));
            const double inward = 1.0 - 1e-6; /* of the tilted view's target */
            const HdCamera near =
                fixed_camera(eye, hd_vec3(eye.x * inward, eye.y * inward, eye.z + height));
            expect_orthonormal(&camera);
            expect_vector(camera.forward, 0.0, 0.0, sign, 0.0);
            expect_vector(camera.up, sign * eye.x / r, sign * eye.y / r, 0.0, tolerance);
            expect_vector(near.up, camera.up.x, camera.up.y, camera.up.z, 2e-6);
            expect_vector(near.right, camera.right.x, camera.right.y, camera.right.z, 2e-6);
        }
    }
}

/* phi is 0 there. */
TEST(test_vertical_from_a_fixed_eye_on_the_axis) {
    const HdCamera down = fixed_camera(hd_vec3(0.0, 0.0, 5.0), hd_vec3(0.0, 0.0, 0.0));
    expect_orthonormal(&down);
    expect_vector(down.forward, 0.0, 0.0, -1.0, 0.0);
    expect_vector(down.up, -1.0, 0.0, 0.0, 0.0);
    const HdCamera up = fixed_camera(hd_vec3(0.0, -0.0, 5.0), hd_vec3(0.0, 0.0, 9.0));
    expect_orthonormal(&up);
    expect_vector(up.forward, 0.0, 0.0, 1.0, 0.0);
    expect_vector(up.up, 1.0, 0.0, 0.0, 0.0);
}

TEST(test_a_fixed_eye_follows_the_target) {
    HdScene scene = example();
    scene.eye = standing_at(1.0, 2.0, 6.0);
    for (int k = 0; k < 1024; k++) {
        const HdCamera camera = camera_of(&scene, k);
        const HdVec3 target = hd_path_point(&scene.target, k, 1024);
        const HdVec3 forward = hd_normalize(hd_sub(target, hd_vec3(1.0, 2.0, 6.0)));
        expect_orthonormal(&camera);
        expect_vector(camera.eye, 1.0, 2.0, 6.0, 0.0);
        expect_vector(camera.forward, forward.x, forward.y, forward.z, tolerance);
        expect_near(camera.right.z, 0.0, tolerance);
    }
}

TEST(test_a_moving_eye_watches_a_fixed_target) {
    HdScene scene = example();
    scene.target = standing_at(0.0, 0.0, 1.0);
    for (int k = 0; k < 1024; k += 64) {
        const HdCamera camera = camera_of(&scene, k);
        const HdVec3 eye = hd_path_point(&scene.eye, k, 1024);
        const HdVec3 forward = hd_normalize(hd_sub(hd_vec3(0.0, 0.0, 1.0), eye));
        expect_vector(camera.eye, eye.x, eye.y, eye.z, 0.0);
        expect_vector(camera.forward, forward.x, forward.y, forward.z, tolerance);
    }
}

TEST(test_a_fixed_eye_at_the_target) {
    static HdError error;
    HdCamera camera;
    HdScene scene = example();
    scene.eye = scene.target = standing_at(0.0, 0.0, 0.0);
    assert_int_equal(hd_camera_at(&camera, &scene, 3, &error), HD_BAD_INPUT);
    expect_contains(error.message, "frame 3: the eye is at the target (0, 0, 0)");
    scene.eye = standing_at(1.0, 1.0, 1.0);
    scene.target = standing_at(1.0, 1.0 + 1e-15, 1.0);
    assert_int_equal(hd_camera_at(&camera, &scene, 0, &error), HD_BAD_INPUT);
    scene.target = standing_at(1.0, 1.0 + 1e-12, 1.0);
    assert_int_equal(hd_camera_at(&camera, &scene, 0, &error), HD_OK);
}

TEST(test_very_far_and_very_near) {
    const double sizes[4] = {1e-310, 1e-200, 1e200, 1e300};
    for (int i = 0; i < 4; i++) {
        const HdScene scene =
            still((HdCylinderPath){.r0 = sizes[i], .z0 = sizes[i]}, (HdCylinderPath){.r0 = 0.0});
        const HdCamera camera = camera_of(&scene, 0);
        expect_orthonormal(&camera);
        expect_vector(camera.forward, -sqrt(0.5), 0.0, -sqrt(0.5), tolerance);
    }
}

TEST(test_the_eye_at_the_target) {
    static HdError error;
    HdCamera camera;
    const double quarter = acos(0.0);
    const HdCylinderPath here = {.r0 = 3.0, .z0 = 2.0, .phi0 = 1.0};
    /* The same place, reached by another sum: it differs in the last bit. */
    const HdCylinderPath again = {
        .r0 = 2.7, .z0 = 2.0, .phi0 = 1.0 + 4.0 * quarter, .r_amplitude = 0.3, .r_phase = quarter};
    const HdScene same = still(here, here), nearly = still(here, again);
    const HdScene origin = still((HdCylinderPath){.r0 = 0.0}, (HdCylinderPath){.r0 = 0.0});
    assert_int_equal(hd_camera_at(&camera, &same, 0, &error), HD_BAD_INPUT);
    expect_contains(error.message, "frame 0: the eye is at the target");
    assert_int_equal(error.status, HD_BAD_INPUT);
    assert_int_equal(hd_camera_at(&camera, &nearly, 0, &error), HD_BAD_INPUT);
    assert_int_equal(hd_camera_at(&camera, &origin, 0, &error), HD_BAD_INPUT);
}

TEST(test_too_far_for_a_number) {
    static HdError error;
    HdCamera camera;
    const HdScene scene = still((HdCylinderPath){.z0 = DBL_MAX}, (HdCylinderPath){.z0 = -DBL_MAX});
    assert_int_equal(hd_camera_at(&camera, &scene, 0, &error), HD_BAD_INPUT);
    expect_contains(error.message, "frame 0: the eye or the target is too far away");
}

TEST(test_field_of_view) {
    const double views[4][2] = {
        {90.0, 1.0}, {120.0, sqrt(3.0)}, {60.0, 1.0 / sqrt(3.0)}, {45.0, sqrt(2.0) - 1.0}};
    HdScene scene = example();
    for (int i = 0; i < 4; i++) {
        scene.field_of_view_degrees = views[i][0];
        expect_near(camera_of(&scene, 0).tangent_of_half_fov, views[i][1], tolerance);
    }
    scene.field_of_view_degrees = 179.0;
    expect_near(camera_of(&scene, 0).tangent_of_half_fov, 114.58865012930961, 1e-10);
}
