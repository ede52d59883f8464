/* SPDX-License-Identifier: MIT */
#include "base/text.h"
#include "unit_test.h"

#include <limits.h>

TEST(distances_are_edits) {
    assert_int_equal(hd_edit_distance("", ""), 0);
    assert_int_equal(hd_edit_distance("render", "render"), 0);
    assert_int_equal(hd_edit_distance("", "abc"), 3);
    assert_int_equal(hd_edit_distance("abc", ""), 3);
    assert_int_equal(hd_edit_distance("rendr", "render"), 1);
    assert_int_equal(hd_edit_distance("rendder", "render"), 1);
    assert_int_equal(hd_edit_distance("rander", "render"), 1);
    assert_int_equal(hd_edit_distance("kitten", "sitting"), 3);
    assert_int_equal(hd_edit_distance("sitting", "kitten"), 3);
    assert_int_equal(hd_edit_distance("flaw", "lawn"), 2);
}

TEST(long_words_are_far) {
    const char *longest = "0123456789012345678901234567890";
    const char *too_long = "01234567890123456789012345678901";
    assert_int_equal(strlen(longest), 31);
    assert_int_equal(hd_edit_distance(longest, "0"), 30);
    assert_int_equal(hd_edit_distance("0", longest), 30);
    assert_int_equal(hd_edit_distance(too_long, "0"), INT_MAX);
    assert_int_equal(hd_edit_distance("0", too_long), INT_MAX);
}

static const char *nearest(const char *word) {
    static const char *const names[] = {"render", "check", "convert", "devices", "help", "man"};
    HdNearest best = {.word = word};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        hd_nearest_offer(&best, names[i]);
    return best.name;
}

TEST(the_nearest_is_kept) {
    assert_string_equal(nearest("rendr"), "render");
    assert_string_equal(nearest("redner"), "render");
    assert_string_equal(nearest("device"), "devices");
    assert_string_equal(nearest("hel"), "help");
    assert_string_equal(nearest("men"), "man");
    assert_string_equal(nearest("hlep"), "help");
    assert_null(nearest("hxxp"));
}

TEST(what_is_far_is_nothing) {
    assert_null(nearest("xyzzy"));
    assert_null(nearest(""));
    assert_null(nearest("r"));
    assert_null(nearest("reflection"));
}
