/* SPDX-License-Identifier: MIT */
/* A name tells its frame exactly where the frame has that name. */
#include <string.h>

#include "output/frame_names.h"
#include "unit_test.h"

static HdError error;
static int numbers[] = {0, 7, 10, 99, 100, 12345, 9999999};
static const HdFrameList frames = {.frames = numbers, .count = 7};
static HdFrameNames names;

static void find(const char *name) {
    const HdOutputStyle style = {.picture = {.bits = 8}};
    HdOutputPlan plan;
    assert_int_equal(hd_outputs_settle(&plan, &name, 1, &style, frames.count, &error), HD_OK);
    assert_int_equal(hd_frame_names_find(&names, &plan.list[0], &frames, &error), HD_OK);
}

static int place(const char *entry) {
    return hd_frame_names_place(&names, entry, strlen(entry), false);
}

static int cut_place(const char *begin) {
    return hd_frame_names_place(&names, begin, strlen(begin), true);
}

TEST(each_frame_is_known_by_its_name) {
    static const char *const patterns[] = {"a/%d.png",   "a/%04d.png",   "a/#.png", "a/##.png",
                                           "a/9%d9.png", "a/0%03d0.png", "%d.png",  "a/%%%d%%.png",
                                           "/x/1%d.png", "a/%09d1.png"};
    for (size_t i = 0; i < sizeof patterns / sizeof patterns[0]; i++) {
        find(patterns[i]);
        for (int k = 0; k < frames.count; k++) {
            char path[HD_MAX_PATH];
            assert_int_equal(hd_pattern_format(patterns[i], numbers[k], path, &error), HD_OK);
            const size_t folder = strlen(names.folder);
            assert_memory_equal(path, names.folder, folder);
            assert_int_equal(place(path + folder), k);
        }
    }
}

TEST(other_names_are_nobodys) {
    static const char *const others[] = {
        "",        "a.png",   "a7.pn",  "a7.pngs", "b7.png",          "a8.png",
        "a07.png", "a1-.png", "a:.png", "a00.png", "a4294967303.png", "a18446744073709551623.png"};
    find("a%d.png");
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (place(others[i]) >= 0)
            fail_msg("%s is taken for frame %d", others[i], numbers[place(others[i])]);
    find("a%03d.png");
    assert_int_equal(place("a7.png"), -1);
    assert_int_equal(place("a0007.png"), -1);
    assert_int_equal(place("a007.png"), 1);
    assert_int_equal(place("a12345.png"), 5);
}

TEST(numbered_folders_are_told_from_files) {
    find("a/take %d of 9/x.png");
    assert_string_equal(names.folder, "a/");
    assert_string_equal(names.rest, "/x.png");
    assert_int_equal(place("take 10 of 9"), 2);
    assert_int_equal(place("take 10 of 9/x.png"), -1);
    find("a/film.mp4");
    assert_string_equal(names.folder, "a/");
    assert_string_equal(names.rest, "");
    assert_int_equal(place("film.mp4"), 0);
    assert_int_equal(place("film.mp40"), -1);
    assert_int_equal(place("0film.mp4"), -1);
}

TEST(names_that_are_cut_are_known_by_their_begin) {
    find("abc%04d.long.png");
    assert_int_equal(cut_place("abc0007.long.png"), 1);
    assert_int_equal(cut_place("abc0007.lo"), 1);
    assert_int_equal(cut_place("abc0007"), 1);
    assert_int_equal(cut_place("abc0007.la"), -1);
    assert_int_equal(cut_place("abc0008.lo"), -1);
    assert_true(cut_place("abc00") >= 0);
    assert_int_equal(cut_place("abc0x"), -1);
    assert_true(cut_place("ab") >= 0);
    assert_int_equal(cut_place("ac"), -1);
}
