/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include <limits.h>

#include "scene/frame_list.h"
#include "unit_test.h"

static void check(const char *text, int frame_count, const int *expected, int count) {
    HdError error = {0};
    HdFrameList list;
    assert_int_equal(hd_frame_list_parse(&list, text, frame_count, &error), HD_OK);
    assert_int_equal(list.count, count);
    for (int i = 0; i < count; i++)
        assert_int_equal(list.frames[i], expected[i]);
    hd_frame_list_free(&list);
    assert_int_equal(list.count, 0);
    assert_null(list.frames);
}

static void check_refused(const char *text, int frame_count, const char *part,
                          const char *other_part) {
    HdError error = {0};
    HdFrameList list;
    assert_int_equal(hd_frame_list_parse(&list, text, frame_count, &error), HD_BAD_INPUT);
    assert_int_equal(error.status, HD_BAD_INPUT);
    assert_int_equal(list.count, 0);
    assert_null(list.frames);
    expect_contains(error.message, part);
    expect_contains(error.message, other_part);
}

TEST(null_means_all) {
    check(NULL, 4, (const int[]){0, 1, 2, 3}, 4);
    check(NULL, 1, (const int[]){0}, 1);
}

TEST(single_frames_and_ranges) {
    check("0", 1, (const int[]){0}, 1);
    check("3-3", 4, (const int[]){3}, 1);
    check("0-2,9", 10, (const int[]){0, 1, 2, 9}, 4);
    check("007", 10, (const int[]){7}, 1);
}

TEST(order_and_overlaps_do_not_matter) {
    check("9,2-4,0", 10, (const int[]){0, 2, 3, 4, 9}, 5);
    check("2-6,3,4-5", 10, (const int[]){2, 3, 4, 5, 6}, 5);
    check("5-6,2-5,2-3,6", 10, (const int[]){2, 3, 4, 5, 6}, 5);
    check("1,1,1", 2, (const int[]){1}, 1);
    check("0-1,2-3", 4, (const int[]){0, 1, 2, 3}, 4);
}

TEST(large_sequences_cost_nothing) {
    check("2147483646,0", INT_MAX, (const int[]){0, INT_MAX - 1}, 2);
}

TEST(empty_items_are_refused) {
    const char *const texts[] = {"", ",", "1,", ",1", "1,,2"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check_refused(texts[i], 10, "empty item", "0-9");
}

TEST(other_texts_are_refused) {
    const char *const texts[] = {"-1", "1-", "-",   "1--2", "1-2-3", "+1",  "a",       "1.5",
                                 "1 ", " 1", "0x1", "1-b",  "%d",    "1;2", "\xc3\xa4"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check_refused(texts[i], 10, texts[i], "neither a frame nor a range");
    check_refused("1,2,x-y,4", 10, "\"x-y\"", "0-9");
}

TEST(descending_ranges_are_refused) {
    check_refused("0,7-3", 10, "\"7-3\"", "descending");
}

TEST(frames_outside_are_refused) {
    check_refused("10", 10, "\"10\"", "0-9");
    check_refused("0-10", 10, "\"0-10\"", "outside");
    check_refused("3-12", 10, "\"3-12\"", "outside");
    check_refused("1", 1, "\"1\"", "the scene has one frame, 0");
    check_refused("2147483647", INT_MAX, "\"2147483647\"", "0-2147483646");
    check_refused("2147483648", INT_MAX, "\"2147483648\"", "outside");
    check_refused("4294967296", 10, "\"4294967296\"", "outside");
    check_refused("18446744073709551616", 10, "\"18446744073709551616\"", "outside");
    check_refused("99999999999999999999999-0", 10, "99999999999999999999999-0", "outside");
}

TEST(empty_sequences_are_refused) {
    check_refused(NULL, 0, "0 frames", "at least 1");
    check_refused("0", -1, "-1 frames", "at least 1");
}
