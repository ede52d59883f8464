/* SPDX-License-Identifier: MIT */
/* Sizes of launches, with devices of simulated speed. */
#include "device/launch_plan.h"

#include "unit_test.h"

/* Seconds of a launch of `count` pieces of a frame's work, from number `first` on. */
typedef double Cost(double first, double count);

typedef struct Frame {
    int launches;
    double longest, seconds;
} Frame;

/* Returns the last frame. */
static Frame run_frames(int frames, HdLaunchSize *size, int items, int work, Cost *cost) {
    Frame frame = {0};
    for (; frames > 0; frames--) {
        frame = (Frame){0};
        hd_launch_size_begin_frame(size);
        for (int first = 0, count; first < items; first += count) {
            count = hd_launch_size_items(size, items - first, work, 4);
            assert_in_range(count, 1, items - first);
            const double seconds = cost((double)first * work, (double)count * work);
            hd_launch_size_note(size, (double)count * work, seconds);
            frame.longest = fmax(frame.longest, seconds);
            frame.seconds += seconds;
            frame.launches++;
        }
    }
    return frame;
}

static double cheap(double first, double count) {
    (void)first;
    return 1e-9 * count;
}

static double costly(double first, double count) {
    (void)first;
    return 2e-6 * count;
}

/* Like a sky above a city of glass, twice. */
static double uneven(double first, double count) {
    double seconds = 0.0;
    for (int i = 0; i < 4; i++) {
        const double from = fmax(first, 1e6 * i), to = fmin(first + count, 1e6 * (i + 1));
        seconds += (i % 2 == 0 ? 1e-9 : 3e-7) * fmax(to - from, 0.0);
    }
    return seconds;
}

TEST(frames_are_cut_for_the_limit_only) {
    HdLaunchSize size = hd_launch_size_start(100, HD_LAUNCH_SECONDS);
    assert_in_range(run_frames(1, &size, 1000000, 4, cheap).launches, 2, 6);
    assert_int_equal(run_frames(4, &size, 1000000, 4, cheap).launches, 1);
    size = hd_launch_size_start(10, HD_LAUNCH_SECONDS);
    assert_true(run_frames(1, &size, 1000000, 1, costly).longest < HD_LAUNCH_SECONDS);
    const Frame frame = run_frames(1, &size, 1000000, 1, costly);
    assert_true(frame.longest < HD_LAUNCH_SECONDS);
    assert_true(frame.launches < 1.3 * frame.seconds / (HD_LAUNCH_AIM * HD_LAUNCH_SECONDS) + 1.0);
}

/* ---- a few pixels whose threads take long, whatever runs beside them ---- */

enum { PIXELS = 640 * 480, SAMPLES = 256 };

static double tail, each; /* seconds, of those and of a sample */

/* Those of one tenth of the rows have such pixels. */
static double has_tail(double first, double count) {
    const double deep = PIXELS / 2.0 * SAMPLES, no_longer = deep + PIXELS / 10.0 * SAMPLES;
    return each * count + (first < no_longer && first + count > deep ? tail : 0.0);
}

static Frame run_tail_frames(HdLaunchSize *size, int count) {
    return run_frames(count, size, PIXELS, SAMPLES, has_tail);
}

/* Cutting does not pay there: it soon costs less than the frame, and never more than three
   times. */
TEST(slow_threads_are_not_cut_for) {
    static const int units[] = {5, 132};
    static const double seconds_of_sample[] = {1e-8, 1.0 / 3e9};
    for (int device = 0; device < 2; device++)
        for (tail = 0.02; tail < 0.5; tail *= 1.5) {
            HdLaunchSize size = hd_launch_size_start(units[device], HD_LAUNCH_SECONDS);
            each = seconds_of_sample[device];
            const double whole = (double)PIXELS * SAMPLES * each + tail;
            for (int i = 0; i < 40; i++)
                assert_true(run_tail_frames(&size, 1).seconds < (i < 39 ? 4.0 : 2.0) * whole);
        }
}

/* After they disappear, launches are cut as before. Launches of a device that may take ten times as
   long are not cut for them. */
TEST(slow_threads_are_forgotten) {
    HdLaunchSize size = hd_launch_size_start(5, HD_LAUNCH_SECONDS);
    each = 1e-8;
    tail = 0.3;
    assert_true(run_tail_frames(&size, 20).longest > 0.3);
    tail = 0.0;
    assert_true(run_tail_frames(&size, 40).longest < HD_LAUNCH_SECONDS);
    size = hd_launch_size_start(132, HD_LAUNCH_SECONDS_FREE);
    each = 4e-10;
    tail = 0.06;
    assert_int_equal(run_tail_frames(&size, 12).launches, 1);
}

/* After the first frame, which cannot know the part below the sky. */
TEST(costly_parts_are_remembered) {
    HdLaunchSize size = hd_launch_size_start(10, HD_LAUNCH_SECONDS);
    Frame frame = run_frames(1, &size, 4000000, 1, uneven);
    for (int i = 0; i < 30; i++) {
        frame = run_frames(1, &size, 4000000, 1, uneven);
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
    size = hd_launch_size_fixed(77);
    hd_launch_size_begin_frame(&size);
    hd_launch_size_note(&size, 77.0, 5.0);
    hd_launch_size_note(&size, 77.0, 0.0);
    assert_int_equal(size.limit, 77);
}

TEST(small_launches_are_weak_evidence) {
    HdLaunchSize size = hd_launch_size_start(100, HD_LAUNCH_SECONDS);
    const HdLaunchSize before = size;
    hd_launch_size_note(&size, before.least / 4.0, 10.0); /* one slow thread */
    assert_int_equal(size.limit, before.limit);
    hd_launch_size_note(&size, before.limit / 4.0, 0.001);
    assert_int_equal(size.limit, before.limit);
    hd_launch_size_note(&size, before.limit / 4.0, 0.1);
    assert_true(size.limit < before.limit / 4);
    size = before;
    hd_launch_size_note(&size, before.limit, 0.0);
    assert_int_equal(size.limit, 2 * before.limit);
}

TEST(items_come_in_equal_parts_of_whole_groups) {
    static const struct {
        int left, work, grain, expected;
    } cases[] = {
        {1000, 1, 1, 1000}, {1001, 1, 1, 501},  {1001, 1, 64, 512},
        {1999, 1, 64, 960}, {100, 16, 8, 56},   {100, 5000, 8, 8}, /* a group at least */
        {3, 5000, 8, 3},    {1, 1 << 30, 1, 1}, {2000000000, 4096, 1024, 1024},
    };
    const HdLaunchSize size = hd_launch_size_fixed(1000);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(hd_launch_size_items(&size, cases[i].left, cases[i].work, cases[i].grain),
                         cases[i].expected);
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
