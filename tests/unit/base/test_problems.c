/* SPDX-License-Identifier: MIT */
#include "base/error.h"

#include <stdio.h>

#include "unit_test.h"

static HdError error;

TEST(test_one_is_one_line_and_several_are_a_list) {
    char printed[128] = "";
    HdProblems problems = {.count = 0};
    assert_int_equal(hd_problems_status(&problems, "a.json", &error), HD_OK);
    hd_problem(&problems, "depth is %d, expected 0 to 1000", -1);
    assert_int_equal(hd_problems_status(&problems, "a.json", &error), HD_BAD_INPUT);
    assert_string_equal(error.message, "a.json: depth is -1, expected 0 to 1000");
    hd_problem(&problems, "%s", "out/%d.png");
    assert_int_equal(hd_problems_status(&problems, "%d", &error), HD_BAD_INPUT);
    assert_false(hd_problems_are_full(&problems));
    assert_string_equal(error.message,
                        "%d: 2 problems\n  depth is -1, expected 0 to 1000\n  out/%d.png");
    FILE *out = tmpfile();
    assert_non_null(out);
    hd_problems_print(&problems, out, "hedron", ": ");
    rewind(out);
    printed[fread(printed, 1, sizeof printed - 1, out)] = '\0';
    fclose(out);
    assert_string_equal(printed, "hedron: depth is -1, expected 0 to 1000\nhedron: out/%d.png\n");
}

/* Many, or a few that are long. */
TEST(test_more_than_fits) {
    static char text[8192];
    memset(text, 'x', sizeof text - 1);
    for (int k = 0; k < 2; k++) {
        HdProblems problems = {.count = 0};
        const int count = k == 0 ? 5000 : 20;
        for (int i = 0; i < count; i++)
            hd_problem(&problems, "problem %d%s", i, k == 0 ? "" : text);
        assert_int_equal(problems.count, count);
        assert_true(problems.used <= sizeof problems.text);
        assert_true(k == 1 || hd_problems_are_full(&problems));
        assert_int_equal(hd_problems_status(&problems, "a.json", &error), HD_BAD_INPUT);
        expect_contains(error.message, k == 0 ? "a.json: 5000 problems\n  problem 0\n  problem 1\n"
                                              : "a.json: 20 problems\n  problem 0xxxxx");
        expect_contains(error.message, "\n  and more of them");
        assert_null(strstr(error.message, "problem 4999"));
    }
}
