/* SPDX-License-Identifier: MIT */
/* Sizes of launches, with devices whose speed is made up. */

#include "device/launch_size.h"
#include "unit_test.h"

/* The seconds that the piece of work number `at` of a frame takes. */
typedef double Cost(int at);

typedef struct Frame {
    int launches;
    double longest, seconds;
} Frame;

static Frame run_frame(HdLaunchSize *size, int items, int work, Cost *cost) {
    Frame frame = {0};
    hd_launch_size_begin_frame(size);
    for (int first = 0, count; first < items; first += count) {
        double seconds = 0.0;
        count = hd_launch_size_items(size, items - first, work, 4);
        assert_in_range(count, 1, items - first);
        for (int i = first; i < first + count; i++)
            seconds += work * cost(i);
        hd_launch_size_note(size, (double)count * work, seconds);
        frame.longest = seconds > frame.longest ? seconds : frame.longest;
        frame.seconds += seconds;
        frame.launches++;
    }
    return frame;
}

static double cheap(int at) {
    (void)at;
    return 1e-9;
}

static double costly(int at) {
    (void)at;
    return 2e-6;
}

/* As a sky above a city of glass. */
static double uneven(int at) {
    return at % 2000000 < 1000000 ? 1e-9 : 3e-7;
}

TEST(short_frames_are_one_launch) {
    HdLaunchSize size = hd_launch_size_start(100, HD_LAUNCH_SECONDS);
    Frame first = run_frame(&size, 1000000, 4, cheap);
    assert_in_range(first.launches, 2, 6);
    for (int i = 0; i < 4; i++)
        first = run_frame(&size, 1000000, 4, cheap);
    assert_int_equal(first.launches, 1);
}

TEST(long_frames_are_cut_below_the_limit) {
    HdLaunchSize size = hd_launch_size_start(10, HD_LAUNCH_SECONDS);
    Frame frame = run_frame(&size, 1000000, 1, costly);
    assert_true(frame.longest < HD_LAUNCH_SECONDS);
    frame = run_frame(&size, 1000000, 1, costly);
    assert_true(frame.longest < HD_LAUNCH_SECONDS);
    /* Not into more than they need. */
    assert_true(frame.launches < 1.3 * frame.seconds / (HD_LAUNCH_AIM * HD_LAUNCH_SECONDS) + 1.0);
}

/* ---- a few pixels whose threads last, whatever runs beside them ---- */

static double tail; /* seconds */

/* 640 x 480 pixels of 256 samples, of which those of one tenth of the rows have such pixels. */
static Frame run_tail_frame(HdLaunchSize *size, double each) {
    enum { PIXELS = 640 * 480, SAMPLES = 256, DEEP = PIXELS / 2, NO_LONGER = DEEP + PIXELS / 10 };
    Frame frame = {0};
    hd_launch_size_begin_frame(size);
    for (int first = 0, count; first < PIXELS; first += count) {
        count = hd_launch_size_items(size, PIXELS - first, SAMPLES, 2);
        double seconds = (double)count * SAMPLES * each;
        if (first < NO_LONGER && first + count > DEEP)
            seconds += tail;
        hd_launch_size_note(size, (double)count * SAMPLES, seconds);
        frame.longest = seconds > frame.longest ? seconds : frame.longest;
        frame.seconds += seconds;
        frame.launches++;
    }
    return frame;
}

static Frame run_tail_frames(HdLaunchSize *size, int count, double each) {
    Frame frame = {0};
    for (int i = 0; i < count; i++)
        frame = run_tail_frame(size, each);
    return frame;
}

/* Cutting does not pay there: it soon costs less than the frame, and never more than three times.
 */
TEST(slow_threads_are_not_cut_for) {
    static const int units[] = {5, 132};
    static const double samples_a_second[] = {1e8, 3e9};
    for (int device = 0; device < 2; device++) {
        for (tail = 0.02; tail < 0.5; tail *= 1.5) {
            HdLaunchSize size = hd_launch_size_start(units[device], HD_LAUNCH_SECONDS);
            double each = 1.0 / samples_a_second[device];
            double whole = 640.0 * 480.0 * 256.0 * each + tail;
            Frame frame = {0};
            for (int i = 0; i < 40; i++) {
                frame = run_tail_frame(&size, each);
                assert_true(frame.seconds < 4.0 * whole);
            }
            assert_true(frame.seconds < 2.0 * whole);
        }
    }
}

/* Once they are gone, launches are cut as before. */
TEST(slow_threads_are_forgotten) {
    HdLaunchSize size = hd_launch_size_start(5, HD_LAUNCH_SECONDS);
    tail = 0.3;
    assert_true(run_tail_frames(&size, 20, 1e-8).longest > 0.3);
    tail = 0.0;
    assert_true(run_tail_frames(&size, 40, 1e-8).longest < HD_LAUNCH_SECONDS);
}

/* Where nothing ends a kernel, launches may last ten times as long: the same frame is one launch.
 */
TEST(free_devices_are_cut_less) {
    HdLaunchSize size = hd_launch_size_start(132, HD_LAUNCH_SECONDS_FREE);
    tail = 0.06;
    assert_int_equal(run_tail_frames(&size, 12, 4e-10).launches, 1);
}

TEST(launches_at_most_double) {
    HdLaunchSize size = hd_launch_size_start(10, HD_LAUNCH_SECONDS);
    for (int i = 0; i < 40; i++) {
        int before = size.limit;
        hd_launch_size_note(&size, before, 0.0);
        assert_true(size.limit >= before && size.limit <= 2.0 * before);
    }
    assert_int_equal(size.limit, HD_MOST_LAUNCH_WORK);
}

/* After the first frame, which cannot know what is below the sky. */
TEST(costly_parts_are_remembered) {
    HdLaunchSize size = hd_launch_size_start(10, HD_LAUNCH_SECONDS);
    Frame frame = run_frame(&size, 4000000, 1, uneven);
    for (int i = 0; i < 30; i++) {
        frame = run_frame(&size, 4000000, 1, uneven);
        assert_true(frame.longest < 2.0 * HD_LAUNCH_SECONDS);
    }
    assert_true(frame.launches < 4.0 * frame.seconds / (HD_LAUNCH_AIM * HD_LAUNCH_SECONDS));
}

TEST(after_a_slow_launch_sizes_rise_by_a_quarter_a_frame) {
    HdLaunchSize size = hd_launch_size_start(100, HD_LAUNCH_SECONDS);
    hd_launch_size_begin_frame(&size);
    hd_launch_size_note(&size, size.limit, 0.16);
    int slow = size.limit;
    assert_int_equal(slow, 100 * 2048 / 4);
    hd_launch_size_note(&size, size.limit, 0.0);
    assert_int_equal(size.limit, slow);
    hd_launch_size_begin_frame(&size); /* after the frame that had it, as large as then */
    hd_launch_size_note(&size, size.limit, 0.0);
    assert_int_equal(size.limit, slow);
    for (double risen = 1.25 * slow; risen < 10.0 * slow; risen *= 1.25) {
        hd_launch_size_begin_frame(&size);
        hd_launch_size_note(&size, size.limit, 0.0);
        hd_launch_size_note(&size, size.limit, 0.0);
        assert_in_range(size.limit, (int)(0.999 * risen), (int)(1.001 * risen));
    }
}

TEST(one_slow_launch_is_forgotten_again) {
    HdLaunchSize size = hd_launch_size_start(100, HD_LAUNCH_SECONDS);
    run_frame(&size, 1000000, 4, cheap);
    hd_launch_size_note(&size, 100000.0, 60.0);
    assert_int_equal(size.limit, 25000);
    Frame frame = {0};
    for (int i = 0; i < 60; i++)
        frame = run_frame(&size, 1000000, 4, cheap);
    assert_int_equal(frame.launches, 1);
}

TEST(small_launches_tell_little) {
    HdLaunchSize size = hd_launch_size_start(100, HD_LAUNCH_SECONDS);
    const HdLaunchSize before = size;
    hd_launch_size_note(&size, before.least / 4.0, 10.0); /* one slow thread */
    assert_int_equal(size.limit, before.limit);
    hd_launch_size_note(&size, before.limit / 4.0, 0.001);
    assert_int_equal(size.limit, before.limit);
    hd_launch_size_note(&size, before.limit / 4.0, 0.1);
    assert_true(size.limit < before.limit / 4);
}

TEST(items_come_in_equal_parts_of_whole_groups) {
    HdLaunchSize size = hd_launch_size_fixed(1000);
    assert_int_equal(hd_launch_size_items(&size, 1000, 1, 1), 1000);
    assert_int_equal(hd_launch_size_items(&size, 1001, 1, 1), 501);
    assert_int_equal(hd_launch_size_items(&size, 1001, 1, 64), 512);
    assert_int_equal(hd_launch_size_items(&size, 1999, 1, 64), 960);
    assert_int_equal(hd_launch_size_items(&size, 100, 16, 8), 56);
    assert_int_equal(hd_launch_size_items(&size, 100, 5000, 8), 8); /* a group at least */
    assert_int_equal(hd_launch_size_items(&size, 3, 5000, 8), 3);
    assert_int_equal(hd_launch_size_items(&size, 1, 1 << 30, 1), 1);
    assert_int_equal(hd_launch_size_items(&size, 2000000000, 4096, 1024), 1024);
}

TEST(fixed_sizes_stay) {
    HdLaunchSize size = hd_launch_size_fixed(77);
    for (int i = 0; i < 5; i++) {
        hd_launch_size_begin_frame(&size);
        hd_launch_size_note(&size, 77.0, i % 2 == 0 ? 5.0 : 0.0);
        assert_int_equal(size.limit, 77);
    }
}

TEST(any_device_has_a_first_size) {
    static const int units[] = {-1, 0, 1, 132, 1 << 30};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        HdLaunchSize size = hd_launch_size_start(units[i], HD_LAUNCH_SECONDS);
        assert_in_range(size.limit, 1 << 14, 1 << 23);
        assert_in_range(size.least, 1 << 10, size.limit / 16);
    }
    assert_int_equal(hd_launch_size_start(132, HD_LAUNCH_SECONDS).limit, 132 * 2048);
}
