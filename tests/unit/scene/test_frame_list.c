/* SPDX-License-Identifier: MIT */
#include <limits.h>

#include "scene/frame_list.h"
#include "unit_test.h"

TEST(frames_are_listed_once_and_in_order) {
    static const struct {
        const char *text;
        int frame_count, count, frames[5];
    } rows[] = {{NULL, 4, 4, {0, 1, 2, 3}},
                {"0", 1, 1, {0}},
                {"007-7", 10, 1, {7}},
                {"9,2-4,0", 10, 5, {0, 2, 3, 4, 9}},
                {"5-6,2-5,2-3,6", 10, 5, {2, 3, 4, 5, 6}},
                {"0-9:4", 10, 3, {0, 4, 8}},
                {"2-9:2147483647,3", 10, 2, {2, 3}},
                {"1-8:4,0-4:2,5", 10, 5, {0, 1, 2, 4, 5}},
                {"2147483646,0", INT_MAX, 2, {0, INT_MAX - 1}}}; /* at no cost */
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        HdError error = {0};
        HdFrameList list;
        assert_int_equal(hd_frame_list_parse(&list, rows[i].text, rows[i].frame_count, &error),
                         HD_OK);
        assert_int_equal(list.count, rows[i].count);
        assert_memory_equal(list.frames, rows[i].frames, (size_t)list.count * sizeof(int));
        hd_frame_list_free(&list);
        assert_null(list.frames);
    }
}

TEST(frames_are_written_as_they_are_read) {
    static const int numbers[] = {0, 1, 2, 7, 8, 10};
    static const bool marks[] = {true, true, true, false, true, true};
    const HdFrameList list = {.count = 6, .frames = (int *)numbers};
    static const int stepped[] = {0, 3, 6, 9, 10, 11, 20, 22, 30};
    const HdFrameList stepped_list = {.count = 9, .frames = (int *)stepped};
    static int many[100];
    static const bool none[100];
    const HdFrameList long_list = {.count = 100, .frames = many};
    char text[HD_FRAMES_TEXT];
    hd_frame_list_write(&list, marks, true, text);
    assert_string_equal(text, "0-2,8,10");
    hd_frame_list_write(&list, marks, false, text);
    assert_string_equal(text, "7");
    hd_frame_list_write(&stepped_list, none, false, text);
    assert_string_equal(text, "0-9:3,10-11,20,22,30");
    for (int i = 0; i < 100; i++)
        many[i] = 1000000 + i * i;
    hd_frame_list_write(&long_list, none, false, text);
    assert_string_equal(text, "1000000-1000001,1000004,1000009,1000016,1000025,1000036,...");
}

static void expect_refused(const char *text, int frame_count, const char *part,
                           const char *other_part) {
    HdError error = {0};
    HdFrameList list;
    assert_int_equal(hd_frame_list_parse(&list, text, frame_count, &error), HD_BAD_INPUT);
    assert_int_equal(list.count, 0);
    assert_null(list.frames);
    expect_contains(error.message, part);
    expect_contains(error.message, other_part);
}

TEST(other_texts_are_refused) {
    static const char *const empty[] = {"", "1,", ",1", "1,,2"};
    static const char *const wrong[] = {
        "-1",  "1-",  "1-2-3", "+1",     "1.5",    " 1",      "0x1",
        "1-b", "1:2", "1-2:",  "1-2:-1", "1-2:1x", "1-2:1:1", "1-2:1-3"};
    for (size_t i = 0; i < sizeof empty / sizeof *empty; i++)
        expect_refused(empty[i], 10, "empty item", "0-9");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        expect_refused(wrong[i], 10, wrong[i], "neither a frame nor a range");
    expect_refused("1,2,x-y,4", 10, "\"x-y\"", "0-9");
    expect_refused("0,7-3", 10, "\"7-3\"", "descending");
    expect_refused("1,3-7:0", 10, "\"3-7:0\"", "a step of 0");
    expect_refused("10", 10, "\"10\"", "0-9");
    expect_refused("3-12", 10, "\"3-12\"", "outside");
    expect_refused("1", 1, "\"1\"", "the scene has one frame, 0");
    expect_refused("2147483647", INT_MAX, "\"2147483647\"", "0-2147483646");
    expect_refused("18446744073709551616", 10, "\"18446744073709551616\"", "outside");
    expect_refused("99999999999999999999999-0", 10, "99999999999999999999999-0", "outside");
}
