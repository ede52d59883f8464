/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L /* fmemopen */
#include "view/motion.h"

#include <stdio.h>

#include "base/trigonometry.h"
#include "base/vector.h"
#include "unit_test.h"

static const HdPose start = {{3.0, -4.0, 2.0}, {1.0, 0.0, 0.5}};

static double distance(const HdPose *pose) {
    return hd_length(hd_sub(pose->eye, pose->target));
}

static void expect_point(HdVec3 actual, HdVec3 expected) {
    expect_near(actual.x, expected.x, 1e-12);
    expect_near(actual.y, expected.y, 1e-12);
    expect_near(actual.z, expected.z, 1e-12);
}

TEST(orbits_keep_target_and_distance) {
    HdPose pose = start;
    hd_pose_orbit(&pose, 0.7, 0.3);
    expect_point(pose.target, start.target);
    expect_near(distance(&pose), distance(&start), 1e-12);
    hd_pose_orbit(&pose, -0.7, -0.3);
    expect_point(pose.eye, start.eye);
    hd_pose_orbit(&pose, HD_PI / 2.0, 0.0);
    expect_point(pose.eye, hd_vec3(5.0, 2.0, 2.0)); /* a quarter turn of (2, -4) is (4, 2) */
}

TEST(dollies_end_far_and_near) {
    HdPose pose = start;
    hd_pose_dolly(&pose, 0.5);
    expect_point(pose.eye, hd_vec3(2.0, -2.0, 1.25));
    hd_pose_dolly(&pose, 1e-30);
    expect_near(distance(&pose), 1e-3, 1e-12);
    hd_pose_dolly(&pose, 1e30);
    expect_near(distance(&pose), 1e6, 1e-3);
    expect_point(pose.target, start.target);
}

TEST(orbits_go_over_no_pole) {
    for (int sign = -1; sign <= 1; sign += 2) {
        HdPose pose = start;
        for (int i = 0; i < 50; i++)
            hd_pose_orbit(&pose, 0.0, sign * 0.4);
        const HdVec3 away = hd_sub(pose.eye, pose.target);
        assert_true(away.z * sign > 0.999 * distance(&start));
        assert_true(away.x > 0.0 && away.y < 0.0); /* still on its own side */
        hd_pose_orbit(&pose, 0.0, -sign * 0.4);
        assert_true((pose.eye.z - pose.target.z) * sign < 0.95 * distance(&start));
    }
}

TEST(pans_move_eye_and_target_alike) {
    HdPose pose = {{0.0, -2.0, 0.0}, {0.0, 0.0, 0.0}};
    hd_pose_pan(&pose, 0.5, 0.25); /* of a distance of 2 */
    expect_point(pose.eye, hd_vec3(1.0, -2.0, 0.5));
    expect_point(pose.target, hd_vec3(1.0, 0.0, 0.5));
    HdPose down = {{0.0, 0.0, 2.0}, {0.0, 0.0, 0.0}}; /* sideways has no direction of its own */
    hd_pose_pan(&down, 0.5, 0.0);
    expect_near(hd_length(down.target), 1.0, 1e-12);
    expect_near(distance(&down), 2.0, 1e-12);
}

TEST(printed_and_applied_cameras_read_back) {
    const HdPose pose = {{0.1, -1.0 / 3.0, 1e-9}, {2.0, 0.0, -0.25}};
    char text[512] = "";
    HdPose back;
    double angle;
    FILE *file = fmemopen(text, sizeof text, "w");
    assert_non_null(file);
    hd_pose_print(file, &pose, 62.5);
    fclose(file);
    assert_int_equal(sscanf(text,
                            "\"camera\": {\"field_of_view\": %lf, \"frames\": 1, "
                            "\"eye\": [%lf, %lf, %lf], \"target\": [%lf, %lf, %lf]}",
                            &angle, &back.eye.x, &back.eye.y, &back.eye.z, &back.target.x,
                            &back.target.y, &back.target.z),
                     7);
    assert_true(angle == 62.5);
    assert_memory_equal(&back, &pose, sizeof back);
    HdScene scene = {.frame_count = 240};
    hd_pose_apply(&pose, &scene);
    assert_int_equal(scene.frame_count, 1);
    back = hd_pose_on_path(&scene, 0);
    assert_memory_equal(&back, &pose, sizeof back);
}

/* ---- resolution ---- */

static const HdDetail full = {640, 360, 4, 4, 14};

static double seconds_of(const HdDetail *detail, double each) {
    return each * detail->width * detail->height * detail->samples * detail->sample_rows;
}

/* Returns the choice after pictures of a device that takes `each` seconds a sample. */
static HdDetail settled(HdPace *pace, double each) {
    HdDetail detail = hd_pace_choose(pace, &full);
    for (int i = 0; i < 60; i++) {
        hd_pace_note(pace, &detail, seconds_of(&detail, each));
        detail = hd_pace_choose(pace, &full);
    }
    return detail;
}

/* All pixels come before more samples, and a picture is no smaller than necessary. */
TEST(pictures_are_made_in_time) {
    for (double each = 1e-9; each < 2e-6; each *= 1.7) {
        HdPace pace = {0};
        const HdDetail detail = settled(&pace, each);
        const HdDetail more = {full.width, full.height, detail.samples + 1, detail.samples + 1,
                               full.depth};
        assert_true(seconds_of(&detail, each) <= HD_MOVING_SECONDS * 1.0001);
        if (detail.samples < full.samples && detail.width == full.width)
            assert_true(seconds_of(&more, each) > HD_MOVING_SECONDS);
        if (detail.samples > 1)
            assert_int_equal(detail.width, full.width);
        if (detail.width < full.width)
            assert_true(seconds_of(&detail, each) > 0.9 * HD_MOVING_SECONDS);
        expect_near((double)detail.width / detail.height, (double)full.width / full.height, 0.02);
        assert_int_equal(detail.depth, full.depth);
    }
}

/* Pictures do not become tiny: their rays become less deep instead, and recover once there is
   time. */
TEST(depth_is_given_up_last) {
    HdPace pace = {0};
    HdDetail detail = settled(&pace, 1e-4);
    assert_int_equal(detail.width, 128);
    assert_int_equal(detail.depth, 2);
    detail = settled(&pace, 1e-10);
    assert_memory_equal(&detail, &full, sizeof detail);
    /* A small picture stays whole. */
    const HdDetail small = {64, 48, 1, 1, 3};
    hd_pace_note(&pace, &small, 1.0);
    detail = hd_pace_choose(&pace, &small);
    assert_true(detail.width == 64 && detail.height == 48);
}

/* A slow picture counts at once, a quick one gradually. */
TEST(slow_pictures_count_more) {
    HdPace slower = {1e-6, 0}, faster = {1e-6, 0};
    const HdDetail detail = {100, 100, 1, 1, 14};
    hd_pace_note(&slower, &detail, 2e-2);
    hd_pace_note(&faster, &detail, 5e-3);
    assert_true(slower.seconds_per_sample > 1.5e-6);
    assert_true(faster.seconds_per_sample > 0.85e-6 && faster.seconds_per_sample < 1e-6);
}
