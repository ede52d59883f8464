/* SPDX-License-Identifier: MIT */
#include "cli/console.h"
#include "unit_test.h"

TEST(lines_have_rate_and_time_left) {
    static const struct {
        HdProgress progress;
        const char *text;
    } cases[] = {
        {{12, 120, 0.0, 8.5, 0.0}, "12/120 frames, 1.41 frames/s, 1:17 left"},
        {{0, 120, 0.0, 8.5, 0.0}, "0/120 frames"},
        {{1, 10001, 0.0, 1.0, 0.0}, "1/10001 frames, 1.00 frames/s, 2:46:40 left"},
        {{1, 2, 0.0, 0.0, 0.0}, "1/2 frames, 0.00 frames/s, 0:00 left"},
        /* the last line has the total time */
        {{120, 120, 0.0, 85.0, 0.0}, "120/120 frames, 1.41 frames/s, 1:25 in all"},
        {{1, 1, 0.0, 59.6, 0.0}, "1/1 frames, 0.02 frames/s, 1:00 in all"},
        {{1, 1, 0.0, 3599.4, 0.0}, "1/1 frames, 0.00 frames/s, 59:59 in all"},
        {{1, 1, 0.0, 1e300, 0.0}, "1/1 frames, 0.00 frames/s, 99999:00:00 in all"},
        /* preparing is reported separately, and is not in the rate */
        {{12, 120, 0.0, 12.0, 4.0}, "12/120 frames, 1.50 frames/s, 1:12 left"},
        {{120, 120, 0.0, 64.0, 4.0},
         "120/120 frames, 2.00 frames/s, 1:04 in all, 4.0 s of it to prepare"},
        {{1, 1, 0.0, 1.05, 0.05}, "1/1 frames, 1.00 frames/s, 0:01 in all"},
        /* parts of frames */
        {{0, 1, 0.25, 12.0, 2.0}, "0/1 frames, 25 % of the next, 0:30 left"},
        {{0, 3, 0.001, 2.0, 2.0}, "0/3 frames, 0 % of the next, 0:00 left"},
        {{3, 40, 2.46, 30.0, 0.0}, "3/40 frames, 2.5 of the next, 0.10 frames/s, 3:10 left"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[128];
        hd_progress_line(&cases[i].progress, text);
        assert_string_equal(text, cases[i].text);
    }
}

TEST(the_bar_is_no_wider_than_the_terminal) {
    static const struct {
        HdProgress progress;
        int columns;
        const char *bar;
    } cases[] = {
        {{.done = 1, .total = 2}, 37, "[############............] 1/2 frames"},
        {{.done = 1, .total = 2}, 36, "1/2 frames"},
        {{.done = 1, .total = 2}, 4, "1/2 "},
        {{.done = 1, .total = 2}, 0, ""},
        {{.total = 0}, 79, "[########################] 1/2 frames"}, /* all were finished */
        {{.done = 1, .total = 3, .part = 0.5}, 79, "[############............] 1/2 frames"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[160];
        hd_progress_bar(&cases[i].progress, "1/2 frames", cases[i].columns, text);
        assert_string_equal(text, cases[i].bar);
    }
}
