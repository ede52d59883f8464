/* SPDX-License-Identifier: MIT */
#include <float.h>

#include "scene/camera.h"
#include "unit_test.h"

static const double tolerance = 1e-14;

static const HdPath swinging = {.cylinder = {.r0 = 5.0,
                                             .z0 = 1.0,
                                             .r_amplitude = 2.0,
                                             .z_amplitude = 0.5,
                                             .r_frequency = 1.0,
                                             .z_frequency = 2.0,
                                             .phi_frequency = 1.0}};

static HdPath standing_at(double x, double y, double z) {
    return (HdPath){.is_fixed = true, .point = hd_vec3(x, y, z)};
}

/* Returns eye and target of the only frame. */
static HdScene still(HdPath eye, HdPath target) {
    return (HdScene){.frame_count = 1, .eye = eye, .target = target, .field_of_view_degrees = 90.0};
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
    expect_vector(hd_path_point(&swinging, 6, 8), 0.0, -3.0, 1.0, tolerance);
    const double r = 5.0 + sqrt(2.0), quarter = acos(0.0);
    expect_vector(hd_path_point(&swinging, 1, 8), r * sqrt(0.5), r * sqrt(0.5), 1.5, tolerance);
    const HdPath shifted = {.cylinder = {.r0 = 5.0,
                                         .z0 = 1.0,
                                         .phi0 = quarter,
                                         .r_amplitude = 2.0,
                                         .z_amplitude = 0.5,
                                         .r_phase = quarter,
                                         .z_phase = -quarter}};
    expect_vector(hd_path_point(&shifted, 2, 3), 0.0, 7.0, 0.5, tolerance);
    HdPath fixed = standing_at(0.1, -0.2, 0.3);
    fixed.cylinder = swinging.cylinder;
    expect_vector(hd_path_point(&fixed, 5, 7), 0.1, -0.2, 0.3, 0.0);
}

static void expect_orthonormal(const HdCamera *camera) {
    expect_near(hd_length(camera->right), 1.0, tolerance);
    expect_near(hd_length(camera->up), 1.0, tolerance);
    expect_near(hd_dot(camera->right, camera->up), 0.0, tolerance);
    const HdVec3 back = hd_cross(camera->right, camera->up);
    expect_vector(back, -camera->forward.x, -camera->forward.y, -camera->forward.z, tolerance);
}

TEST(test_the_basis_is_orthonormal_and_level) {
    const HdPath low = {
        .cylinder = {.r0 = 2.0, .z0 = -2.0, .z_amplitude = 0.1, .z_frequency = 4.0}};
    HdScene scene = still(swinging, low);
    scene.frame_count = 16;
    scene.field_of_view_degrees = 120.0;
    for (int k = 0; k < 16; k++) {
        const HdCamera camera = camera_of(&scene, k);
        const HdVec3 eye = hd_path_point(&swinging, k, 16), target = hd_path_point(&low, k, 16);
        const HdVec3 forward = hd_normalize(hd_sub(target, eye));
        expect_orthonormal(&camera);
        expect_near(camera.right.z, 0.0, tolerance);
        expect_near(camera.tangent_of_half_fov, sqrt(3.0), tolerance);
        assert_true(camera.up.z > 0.0);
        expect_vector(camera.eye, eye.x, eye.y, eye.z, 0.0);
        expect_vector(camera.forward, forward.x, forward.y, forward.z, tolerance);
    }
}

/* Up is the direction away from the axis, or towards it. */
static void expect_vertical(HdPath path, double cosine, double sine) {
    const HdVec3 eye = hd_path_point(&path, 0, 1);
    for (int sign = -1; sign <= 1; sign += 2) {
        const double z = eye.z + sign * hypot(eye.x, eye.y);
        const HdScene vertical = still(path, standing_at(eye.x, eye.y, z));
        const HdCamera camera = camera_of(&vertical, 0);
        expect_orthonormal(&camera);
        expect_vector(camera.forward, 0.0, 0.0, sign, 0.0);
        expect_vector(camera.up, sign * cosine, sign * sine, 0.0, tolerance);
    }
}

TEST(test_straight_up_and_down) {
    const HdVec3 places[] = {{-3.0, 4.0, -5.0}, {-1e-3, -1e-3, 2.0}, {1e9, -2e9, 7e9}};
    for (int i = 0; i < 3; i++) {
        const HdVec3 eye = places[i];
        const double r = hypot(eye.x, eye.y);
        expect_vertical(standing_at(eye.x, eye.y, eye.z), eye.x / r, eye.y / r);
    }
    expect_vertical((HdPath){.cylinder = {.r0 = 3.0, .z0 = 5.0, .phi0 = 0.7}}, cos(0.7), sin(0.7));
    /* On the axis phi is that of the path, or 0. */
    HdScene scene =
        still((HdPath){.cylinder = {.z0 = 5.0, .phi_frequency = 1.0}}, standing_at(0.0, 0.0, 0.0));
    scene.frame_count = 4;
    expect_vector(camera_of(&scene, 1).up, 0.0, -1.0, 0.0, tolerance);
    scene.eye = standing_at(0.0, -0.0, 5.0);
    expect_vector(camera_of(&scene, 1).up, -1.0, 0.0, 0.0, tolerance);
}

TEST(test_very_far_and_very_near) {
    const double sizes[] = {1e-310, 1e300};
    for (int i = 0; i < 2; i++) {
        const HdScene scene =
            still((HdPath){.cylinder = {.r0 = sizes[i], .z0 = sizes[i]}}, (HdPath){.is_fixed = 0});
        const HdCamera camera = camera_of(&scene, 0);
        expect_orthonormal(&camera);
        expect_vector(camera.forward, -sqrt(0.5), 0.0, -sqrt(0.5), tolerance);
    }
}

static void expect_refused(HdPath eye, HdPath target, int frame, const char *message) {
    HdError error;
    HdCamera camera;
    const HdScene scene = still(eye, target);
    assert_int_equal(hd_camera_at(&camera, &scene, frame, &error), HD_BAD_INPUT);
    expect_contains(error.message, message);
}

TEST(test_no_view) {
    const double quarter = acos(0.0);
    const HdPath here = {.cylinder = {.r0 = 3.0, .z0 = 2.0, .phi0 = 1.0}};
    /* The same place by another sum: it differs in the last bit. */
    const HdPath again = {.cylinder = {.r0 = 2.7,
                                       .z0 = 2.0,
                                       .phi0 = 1.0 + 4.0 * quarter,
                                       .r_amplitude = 0.3,
                                       .r_phase = quarter}};
    const HdPath place = standing_at(1.0, 1.0, 1.0);
    const HdPath far = standing_at(0.0, 0.0, DBL_MAX), below = standing_at(0.0, 0.0, -DBL_MAX);
    expect_refused(here, again, 0, "frame 0: the eye is at the target");
    expect_refused(place, place, 3, "frame 3: the eye is at the target (1, 1, 1)");
    const HdScene apart = still(place, standing_at(1.0, 1.0 + 1e-12, 1.0));
    camera_of(&apart, 0);
    expect_refused(far, below, 0,
                   "frame 0: the coordinates of the eye or the target are too large");
}
