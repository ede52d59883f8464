/* SPDX-License-Identifier: MIT */
#include "view/pace.h"

#include "unit_test.h"

static const HdDetail full = {640, 360, 4, 14};

static double seconds_of(const HdDetail *detail, double each) {
    return each * detail->width * detail->height * detail->samples * detail->samples;
}

/* What is chosen once pictures of a device that takes `each` seconds a sample were noted. */
static HdDetail settled(HdPace *pace, double each) {
    HdDetail detail = hd_pace_choose(pace, &full);
    for (int i = 0; i < 60; i++) {
        hd_pace_note(pace, &detail, seconds_of(&detail, each));
        detail = hd_pace_choose(pace, &full);
    }
    return detail;
}

/* All pixels come before more samples, and a picture is no smaller than it must be. */
TEST(pictures_are_made_in_time) {
    for (double each = 1e-9; each < 2e-6; each *= 1.7) {
        HdPace pace = {0};
        const HdDetail detail = settled(&pace, each);
        const HdDetail more = {full.width, full.height, detail.samples + 1, full.depth};
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

/* Pictures do not become stamps: their rays go less deep instead, and come back once there is time.
 */
TEST(depth_is_given_up_last) {
    HdPace pace = {0};
    HdDetail detail = settled(&pace, 1e-4);
    assert_int_equal(detail.width, 128);
    assert_int_equal(detail.depth, 2);
    detail = settled(&pace, 1e-10);
    assert_memory_equal(&detail, &full, sizeof detail);
    /* What is small already stays whole. */
    const HdDetail small = {64, 48, 1, 3};
    hd_pace_note(&pace, &small, 1.0);
    detail = hd_pace_choose(&pace, &small);
    assert_true(detail.width == 64 && detail.height == 48);
}

/* One that took too long counts at once, a quick one by and by. */
TEST(slow_pictures_count_more) {
    HdPace slower = {1e-6, 0}, faster = {1e-6, 0};
    const HdDetail detail = {100, 100, 1, 14};
    hd_pace_note(&slower, &detail, 2e-2);
    hd_pace_note(&faster, &detail, 5e-3);
    assert_true(slower.seconds_per_sample > 1.5e-6);
    assert_true(faster.seconds_per_sample > 0.85e-6 && faster.seconds_per_sample < 1e-6);
}
