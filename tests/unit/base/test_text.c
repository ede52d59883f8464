/* SPDX-License-Identifier: MIT */
#include "base/text.h"

#include <stdlib.h>

#include "base/error.h"
#include "unit_test.h"

TEST(test_controls_and_what_is_not_utf8_are_escaped) {
    static const char *const rows[][2] = {
        {"a\x1b[31m\a\n\t\x7f~", "a\\u001b[31m\\u0007\\u000a\\u0009\\u007f~"},
        {"\xc2\x80\xc2\x9f\xc2\xa0", "\\u0080\\u009f\xc2\xa0"},
        {"-\xe2\x80\xae-\xe2\x80\xa8\xe2\x81\xa6\xe2\x81\xa9", "-\\u202e-\\u2028\\u2066\\u2069"},
        {"\xe2\x80\xa7\xe2\x80\xaf\xe2\x81\xa5\xe2\x81\xaa",
         "\xe2\x80\xa7\xe2\x80\xaf\xe2\x81\xa5\xe2\x81\xaa"},
        {"\x9b[2J", "\\x9b[2J"}, /* an escape sequence if bytes have 8 bits */
        {"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80", "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80"},
        {"\xc3", "\\xc3"},
        {"\xe2\x82", "\\xe2\\x82"},
        {"\xc0\x9b\xc1\xbf", "\\xc0\\x9b\\xc1\\xbf"},
        {"\xe0\x82\x9b", "\\xe0\\x82\\x9b"}, /* U+009B with a byte too many */
        {"\xed\xa0\x80", "\\xed\\xa0\\x80"},
        {"\xf4\x90\x80\x80\xff", "\\xf4\\x90\\x80\\x80\\xff"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        for (int k = 0; k < 2; k++) { /* escaped text stays unchanged */
            char out[80];
            assert_int_equal(hd_escape(rows[i][k], out, sizeof out), strlen(rows[i][k]));
            assert_string_equal(out, rows[i][1]);
        }
}

TEST(test_cut) {
    char out[8];
    assert_int_equal(hd_escape("ab\x1b-", out, 8), 2);
    assert_string_equal(out, "ab");
    assert_int_equal(hd_escape("abcdef\xc3\xa9", out, 8), 6);
    assert_string_equal(out, "abcdef");
    assert_int_equal(hd_escape("abcde\xc3\xa9", out, 8), 7);
    assert_string_equal(out, "abcde\xc3\xa9");
}

TEST(test_errors_and_problems) {
    static HdError error;
    HdProblems problems = {.count = 0};
    hd_fail(&error, HD_BAD_INPUT, "%s: line\n\ttwo", "a\x1b]0;b\a");
    assert_string_equal(error.message, "a\\u001b]0;b\\u0007: line\n\ttwo");
    assert_int_equal(error.status, HD_BAD_INPUT);
    hd_error_prefix(&error, "\x1b");
    assert_string_equal(error.message, "\\u001b: a\\u001b]0;b\\u0007: line\n\ttwo");
    hd_problem(&problems, "%s is wrong", "a\nhedron: all is well\x1b");
    hd_problems_status(&problems, "b", &error);
    assert_string_equal(error.message, "b: a\\u000ahedron: all is well\\u001b is wrong");
    static char longest[sizeof error.message + 10];
    memset(longest, '\x1b', sizeof longest - 1);
    hd_fail(&error, HD_BAD_INPUT, "%s", longest);
    assert_true(strlen(error.message) > sizeof error.message - 8);
    assert_null(strchr(error.message, '\x1b'));
}

TEST(test_distances_are_edits) {
    static const struct {
        const char *word, *name;
        int distance; /* negative: not near */
    } rows[] = {{"render", "render", 0},
                {"rendr", "render", 1},
                {"redner", "render", 1},
                {"siting", "kitting", 2},
                {"kitten", "sitting", -1},
                {"0123456789012345678901234567890", "0123456789012345678901234567890", 0},
                {"01234567890123456789012345678901", "01234567890123456789012345678901", -1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        HdNearest best = {.word = rows[i].word};
        hd_nearest_offer(&best, rows[i].name);
        assert_int_equal(best.name != NULL ? best.distance : -1, rows[i].distance);
    }
}

TEST(test_the_nearest_is_kept) {
    static const char *const names[] = {"render", "check", "devices", "help", "man"};
    static const char *const rows[][2] = {
        {"redner", "render"}, {"device", "devices"}, {"men", "man"}, {"hxxp", ""}, {"r", ""}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        HdNearest best = {.word = rows[i][0]};
        for (size_t k = 0; k < sizeof names / sizeof *names; k++)
            hd_nearest_offer(&best, names[k]);
        assert_string_equal(best.name != NULL ? best.name : "", rows[i][1]);
    }
}

TEST(test_numbers_read_back) {
    static const struct {
        double value;
        const char *exact, *brief;
    } numbers[] = {{0.1, "0.1", "0.1"},
                   {0.07, "0.07", "0.07"}, /* 16 digits would be one too many */
                   {1e12, "1000000000000", "1e12"},
                   {1e-12, "1e-12", "1e-12"},
                   {-1e6, "-1000000", "-1e6"},
                   {0.1 + 0.2, "0.30000000000000004", "0.30000000000000004"},
                   {-0.0, "-0.0", "-0"},
                   {1e300, "1e+300", "1e300"}};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        char text[HD_NUMBER_SIZE];
        hd_exact_number(numbers[i].value, text);
        assert_string_equal(text, numbers[i].exact);
        assert_true(strtod(text, NULL) == numbers[i].value);
        hd_short_number(numbers[i].value, text);
        assert_string_equal(text, numbers[i].brief);
        assert_true(strtod(text, NULL) == numbers[i].value);
    }
}
