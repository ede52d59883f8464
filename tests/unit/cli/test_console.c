/* SPDX-License-Identifier: MIT */
#include "cli/console.h"
#include "unit_test.h"

static void check_time(double seconds, const char *expected) {
    char text[32];
    hd_progress_time(seconds, text);
    assert_string_equal(text, expected);
}

TEST(times_have_minutes_and_hours) {
    check_time(0.0, "0:00");
    check_time(0.4, "0:00");
    check_time(0.5, "0:01");
    check_time(9.0, "0:09");
    check_time(59.4, "0:59");
    check_time(59.6, "1:00");
    check_time(76.0, "1:16");
    check_time(3599.0, "59:59");
    check_time(3600.0, "1:00:00");
    check_time(3661.0, "1:01:01");
    check_time(36000.0 * 10.0, "100:00:00");
    check_time(1e300, "99999:00:00");
}

static void check_progress(HdProgress progress, const char *expected) {
    char text[128];
    hd_progress_line(&progress, text);
    assert_string_equal(text, expected);
}

static void check_line(int done, int total, double seconds, const char *expected) {
    check_progress((HdProgress){done, total, 0.0, seconds, 0.0}, expected);
}

TEST(lines_tell_rate_and_time_left) {
    check_line(12, 120, 8.5, "12/120 frames, 1.41 frames/s, 1:17 left");
    check_line(0, 120, 8.5, "0/120 frames");
    check_line(1, 2, 2.0, "1/2 frames, 0.50 frames/s, 0:02 left");
    check_line(1, 10001, 1.0, "1/10001 frames, 1.00 frames/s, 2:46:40 left");
    check_line(1, 2, 0.0, "1/2 frames, 0.00 frames/s, 0:00 left");
}

TEST(the_last_line_tells_the_whole_time) {
    check_line(120, 120, 85.0, "120/120 frames, 1.41 frames/s, 1:25 in all");
    check_line(1, 1, 0.0, "1/1 frames, 0.00 frames/s, 0:00 in all");
}

TEST(parts_of_frames_tell_time_left) {
    check_progress((HdProgress){0, 1, 0.25, 12.0, 2.0}, "0/1 frames, 25 % of the next, 0:30 left");
    check_progress((HdProgress){0, 1, 0.999, 12.0, 2.0}, "0/1 frames, 99 % of the next, 0:00 left");
    check_progress((HdProgress){0, 3, 0.001, 2.0, 2.0}, "0/3 frames, 0 % of the next, 0:00 left");
    check_progress((HdProgress){3, 40, 0.5, 35.0, 0.0},
                   "3/40 frames, 50 % of the next, 0.09 frames/s, 6:05 left");
    check_progress((HdProgress){3, 40, 2.46, 30.0, 0.0},
                   "3/40 frames, 2.5 of the next, 0.10 frames/s, 3:10 left");
}

static void check_bar(int columns, const char *expected) {
    char text[160];
    const HdProgress half = {.done = 1, .total = 2};
    hd_progress_bar(&half, "1/2 frames", columns, text);
    assert_string_equal(text, expected);
}

TEST(the_bar_is_no_wider_than_the_terminal) {
    check_bar(79, "[############............] 1/2 frames");
    check_bar(37, "[############............] 1/2 frames");
    check_bar(36, "1/2 frames");
    check_bar(10, "1/2 frames");
    check_bar(4, "1/2 ");
    check_bar(0, "");
    char text[160];
    const HdProgress none = {.total = 0}; /* all were finished before */
    hd_progress_bar(&none, "0/0 frames", 79, text);
    assert_string_equal(text, "[########################] 0/0 frames");
    const HdProgress part = {.done = 1, .total = 3, .part = 0.5};
    hd_progress_bar(&part, "1/3 frames", 79, text);
    assert_string_equal(text, "[############............] 1/3 frames");
}
