/* SPDX-License-Identifier: MIT */
/* A name identifies its frame exactly if the frame has that name. */
#include <string.h>

#include "output/outputs.h"
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

TEST(other_names_belong_to_no_frame) {
    static const char *const others[] = {
        "",       "a.png",   "a7.pn",  "a7.pngs",         "b7.png",
        "a8.png", "a07.png", "a:.png", "a4294967303.png", "a18446744073709551623.png"};
    find("a%d.png");
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (place(others[i]) >= 0)
            fail_msg("%s is taken for frame %d", others[i], numbers[place(others[i])]);
    find("a%03d.png");
    assert_int_equal(place("a7.png"), -1);
    assert_int_equal(place("a0007.png"), -1);
    assert_int_equal(place("a007.png"), 1);
    assert_int_equal(place("a12345.png"), 5);
    find("/x/9%%%d9.png");
    assert_string_equal(names.folder, "/x/");
    assert_int_equal(place("9%109.png"), 2);
    assert_int_equal(place("9%99999999.png"), 6);
}

TEST(numbered_folders_are_distinguished_from_files) {
    find("a/take %d of 9/x.png");
    assert_string_equal(names.folder, "a/");
    assert_string_equal(names.rest, "/x.png");
    assert_int_equal(place("take 10 of 9"), 2);
    assert_int_equal(place("take 10 of 9/x.png"), -1);
    find("a/film.mp4");
    assert_string_equal(names.folder, "a/");
    assert_string_equal(names.rest, "");
    assert_int_equal(place("film.mp4"), 0);
    assert_true(place("film.mp40") == -1 && place("0film.mp4") == -1);
}

TEST(truncated_names_are_matched_by_their_begin) {
    find("abc%04d.long.png");
    static const struct {
        const char *begin;
        int place;
    } rows[] = {{"abc0007.long.png", 1},
                {"abc0007.lo", 1},
                {"abc0007", 1},
                {"abc0007.la", -1},
                {"abc0008.lo", -1},
                {"abc0x", -1},
                {"ac", -1},
                {"abc000", 0},
                {"ab", 0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_int_equal(hd_frame_names_place(&names, rows[i].begin, strlen(rows[i].begin), true),
                         rows[i].place);
}
