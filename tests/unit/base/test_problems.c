/* SPDX-License-Identifier: MIT */
#include "base/problems.h"

#include <stdio.h>

#include "unit_test.h"

static HdProblems problems;
static HdError error;

static int clear(void **state) {
    (void)state;
    problems = (HdProblems){.count = 0};
    return 0;
}

TEST(test_one_is_one_line_and_several_are_a_list) {
    assert_int_equal(hd_problems_status(&problems, "a.json", &error), HD_OK);
    hd_problem(&problems, "depth is %d, expected 0 to 1000", -1);
    assert_int_equal(hd_problems_status(&problems, "a.json", &error), HD_BAD_INPUT);
    assert_string_equal(error.message, "a.json: depth is -1, expected 0 to 1000");
    hd_problem(&problems, "second");
    hd_problem(&problems, "third");
    assert_int_equal(hd_problems_status(&problems, "a.json", &error), HD_BAD_INPUT);
    assert_false(hd_problems_are_full(&problems));
    assert_string_equal(error.message,
                        "a.json: 3 problems\n  depth is -1, expected 0 to 1000\n  second\n  third");
}

TEST(test_percent_signs_stay) {
    hd_problem(&problems, "%s", "out/%d.png");
    hd_problem(&problems, "%s", "%s%s%n");
    assert_int_equal(hd_problems_status(&problems, "%d", &error), HD_BAD_INPUT);
    assert_string_equal(error.message, "%d: 2 problems\n  out/%d.png\n  %s%s%n");
}

TEST(test_more_than_there_is_room_for) {
    for (int i = 0; i < 5000; i++)
        hd_problem(&problems, "problem %d", i);
    assert_int_equal(problems.count, 5000);
    assert_true(problems.used <= sizeof problems.text && hd_problems_are_full(&problems));
    assert_int_equal(hd_problems_status(&problems, "a.json", &error), HD_BAD_INPUT);
    expect_contains(error.message, "a.json: 5000 problems\n  problem 0\n  problem 1\n");
    expect_contains(error.message, "\n  and more of them");
    assert_null(strstr(error.message, "problem 4999"));
}

TEST(test_a_line_that_is_too_long_is_cut) {
    static char text[8192];
    memset(text, 'x', sizeof text - 1);
    for (int i = 0; i < 20; i++)
        hd_problem(&problems, "%s", text);
    assert_true(problems.used <= sizeof problems.text);
    hd_problems_status(&problems, "a.json", &error);
    expect_contains(error.message, "a.json: 20 problems\n  xxxxx");
    expect_contains(error.message, "\n  and more of them");
}

TEST(test_each_is_printed_in_a_line) {
    char text[128] = "";
    FILE *out = tmpfile();
    assert_non_null(out);
    hd_problem(&problems, "first");
    hd_problem(&problems, "second");
    hd_problems_print(&problems, out, "hedron", ": ");
    rewind(out);
    text[fread(text, 1, sizeof text - 1, out)] = '\0';
    fclose(out);
    assert_string_equal(text, "hedron: first\nhedron: second\n");
}

EACH(clear, NULL)
