/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include <limits.h>

#include "expect.h"
#include "scene/frame_list.h"

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

static void null_means_all(void **state) {
    (void)state;
    check(NULL, 4, (const int[]){0, 1, 2, 3}, 4);
    check(NULL, 1, (const int[]){0}, 1);
}

static void single_frames_and_ranges(void **state) {
    (void)state;
    check("0", 1, (const int[]){0}, 1);
    check("3-3", 4, (const int[]){3}, 1);
    check("0-2,9", 10, (const int[]){0, 1, 2, 9}, 4);
    check("007", 10, (const int[]){7}, 1);
}

static void order_and_overlaps_do_not_matter(void **state) {
    (void)state;
    check("9,2-4,0", 10, (const int[]){0, 2, 3, 4, 9}, 5);
    check("2-6,3,4-5", 10, (const int[]){2, 3, 4, 5, 6}, 5);
    check("5-6,2-5,2-3,6", 10, (const int[]){2, 3, 4, 5, 6}, 5);
    check("1,1,1", 2, (const int[]){1}, 1);
    check("0-1,2-3", 4, (const int[]){0, 1, 2, 3}, 4);
}

static void large_sequences_cost_nothing(void **state) {
    (void)state;
    check("2147483646,0", INT_MAX, (const int[]){0, INT_MAX - 1}, 2);
}

static void empty_items_are_refused(void **state) {
    (void)state;
    const char *const texts[] = {"", ",", "1,", ",1", "1,,2"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check_refused(texts[i], 10, "empty item", "0-9");
}

static void other_texts_are_refused(void **state) {
    (void)state;
    const char *const texts[] = {"-1", "1-", "-",   "1--2", "1-2-3", "+1",  "a",       "1.5",
                                 "1 ", " 1", "0x1", "1-b",  "%d",    "1;2", "\xc3\xa4"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        check_refused(texts[i], 10, texts[i], "neither a frame nor a range");
    check_refused("1,2,x-y,4", 10, "\"x-y\"", "0-9");
}

static void descending_ranges_are_refused(void **state) {
    (void)state;
    check_refused("0,7-3", 10, "\"7-3\"", "descending");
}

static void frames_outside_are_refused(void **state) {
    (void)state;
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

static void empty_sequences_are_refused(void **state) {
    (void)state;
    check_refused(NULL, 0, "0 frames", "at least 1");
    check_refused("0", -1, "-1 frames", "at least 1");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(null_means_all),
        cmocka_unit_test(single_frames_and_ranges),
        cmocka_unit_test(order_and_overlaps_do_not_matter),
        cmocka_unit_test(large_sequences_cost_nothing),
        cmocka_unit_test(empty_items_are_refused),
        cmocka_unit_test(other_texts_are_refused),
        cmocka_unit_test(descending_ranges_are_refused),
        cmocka_unit_test(frames_outside_are_refused),
        cmocka_unit_test(empty_sequences_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
