/* SPDX-License-Identifier: MIT */
#include "base/text.h"
#include "expect.h"

#include <limits.h>

static void distances_are_edits(void **state) {
    (void)state;
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

static void long_words_are_far(void **state) {
    (void)state;
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

static void the_nearest_is_kept(void **state) {
    (void)state;
    assert_string_equal(nearest("rendr"), "render");
    assert_string_equal(nearest("redner"), "render");
    assert_string_equal(nearest("device"), "devices");
    assert_string_equal(nearest("hel"), "help");
    assert_string_equal(nearest("men"), "man");
    assert_string_equal(nearest("hlep"), "help");
    assert_null(nearest("hxxp"));
}

static void what_is_far_is_nothing(void **state) {
    (void)state;
    assert_null(nearest("xyzzy"));
    assert_null(nearest(""));
    assert_null(nearest("r"));
    assert_null(nearest("reflection"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_edits),
        cmocka_unit_test(long_words_are_far),
        cmocka_unit_test(the_nearest_is_kept),
        cmocka_unit_test(what_is_far_is_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
