/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "system/path.h"
#include "test_folder.h"

static HdError error;
static char out[HD_MAX_PATH];

TEST(home_is_expanded_at_the_start_only) {
    static const char *const cases[][2] = {{"~", "/home/somebody"},
                                           {"~/a/b.png", "/home/somebody/a/b.png"},
                                           {"~other/a", "~other/a"},
                                           {"a/~/b", "a/~/b"},
                                           {"", ""}};
    setenv("HOME", "/home/somebody", 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(hd_path_expand_home(cases[i][0], out, &error), HD_OK);
        assert_string_equal(out, cases[i][1]);
    }
    /* Without the variable it comes from the database. */
    char empty[HD_MAX_PATH];
    unsetenv("HOME");
    assert_int_equal(hd_path_expand_home("~/x", out, &error), HD_OK);
    setenv("HOME", "", 1);
    assert_int_equal(hd_path_expand_home("~/x", empty, &error), HD_OK);
    assert_int_equal(out[0], '/');
    assert_string_equal(out + strlen(out) - 2, "/x");
    assert_string_equal(out, empty);
}

TEST(long_names_are_refused) {
    char path[HD_MAX_PATH + 1];
    setenv("HOME", "/home", 1);
    memset(path, 'a', sizeof path);
    path[HD_MAX_PATH] = '\0';
    assert_int_equal(hd_path_expand_home(path, out, &error), HD_BAD_INPUT);
    assert_int_equal(hd_path_make_parents(path, 0777, &error), HD_BAD_INPUT);
    path[HD_MAX_PATH - 1] = '\0';
    assert_int_equal(hd_path_expand_home(path, out, &error), HD_OK);
    memcpy(path, "~/", 2);
    assert_int_equal(hd_path_expand_home(path, out, &error), HD_BAD_INPUT);
    path[HD_MAX_PATH - 5] = '\0';
    assert_int_equal(hd_path_expand_home(path, out, &error), HD_OK);
    assert_int_equal(strlen(out), HD_MAX_PATH - 1);
    memcpy(path, "%d", 2);
    path[HD_MAX_PATH - 5] = 'a';
    path[HD_MAX_PATH - 1] = '\0';
    assert_int_equal(hd_pattern_format(path, 9, out, &error), HD_OK);
    assert_int_equal(strlen(out), HD_MAX_PATH - 2);
    assert_int_equal(hd_pattern_format(path, 10, out, &error), HD_OK);
    assert_int_equal(hd_pattern_format(path, 100, out, &error), HD_BAD_INPUT);
}

TEST(parents_are_made) {
    char absolute[HD_MAX_PATH];
    assert_int_equal(hd_path_make_parents("one/two//three/file", 0777, &error), HD_OK);
    assert_int_equal(access("one/two/three/.", F_OK), 0);
    assert_int_equal(access("one/two/three/file", F_OK), -1);
    assert_int_equal(hd_path_make_parents("one/two/three/file", 0777, &error), HD_OK);
    snprintf(absolute, sizeof absolute, "%s/four/five/file", test_folder);
    assert_int_equal(hd_path_make_parents(absolute, 0777, &error), HD_OK);
    assert_int_equal(access("four/five/.", F_OK), 0);
    assert_int_equal(hd_path_make_parents("./six/../seven/file", 0777, &error), HD_OK);
    assert_int_equal(access("seven/.", F_OK), 0);
    static const char *const without[] = {"file", "", "/file"};
    for (int i = 0; i < 3; i++)
        assert_int_equal(hd_path_make_parents(without[i], 0777, &error), HD_OK);
    write_bytes("block", "", 0);
    assert_int_equal(hd_path_make_parents("block/deep/file", 0777, &error), HD_FAILED);
    expect_contains(error.message, "folder block for block/deep/file: a file has that name");
}

TEST(wrong_patterns_are_refused) {
    static const struct {
        const char *pattern;
        bool has_number;
    } cases[] = {{"", false},     {"a.png", false}, {"%%d", false},   {"%%%%d", false},
                 {"%", false},    {"%5d", false},   {"%0d", false},   {"%010d", false},
                 {"%-3d", false}, {"%0", false},    {"%s", false},    {"##########", false},
                 {"%n%d", true},  {"%d%", true},    {"%d%d", true},   {"%d-%03d", true},
                 {"%5%d", true},  {"%d%s", true},   {"#%d#%d", true}, {"#/#_#", true},
                 {"#%s", true},   {"#%", true},     {"%0#", true},    {"#/a.png", false},
                 {"%d/%d", true}, {"%#", false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *pattern = cases[i].pattern;
        if (hd_pattern_has_number(pattern) != cases[i].has_number)
            fail_msg("\"%s\" has %s number", pattern, cases[i].has_number ? "no" : "a");
        assert_int_equal(hd_pattern_check(pattern, &error), HD_BAD_INPUT);
        expect_contains(error.message, pattern);
        assert_int_equal(hd_pattern_format(pattern, 1, out, &error), HD_BAD_INPUT);
    }
}

TEST(frames_are_named) {
    static const struct {
        const char *pattern;
        int frame;
        const char *expected;
    } cases[] = {
        {"%d", 0, "0"},
        {"f%03d.png", 7, "f007.png"},
        {"f%03d.png", 12345, "f12345.png"},
        {"%09d", INT32_MAX, "2147483647"},
        {"%09d", 42, "000000042"},
        {"100%%/%d%%d", 3, "100%/3%d"},
        {"##########%d", 7, "##########7"},
        {"out/####.png", 7, "out/0007.png"},
        {"#1/##_%03d%%.png", 7, "#1/##_007%.png"},
        {"f#", 70, "f70"},
        {"a #3/##/b#.exr", 7, "a #3/##/b7.exr"},
        {"#3/take %02d/b.exr", 7, "#3/take 07/b.exr"},
        {"%%#%#3.png", 7, "%7#3.png"},
        {"#########%%", 42, "000000042%"},
        {"\xc3\xa4%d.", 3, "\xc3\xa4\x33."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_true(hd_pattern_has_number(cases[i].pattern));
        assert_int_equal(hd_pattern_check(cases[i].pattern, &error), HD_OK);
        assert_int_equal(hd_pattern_format(cases[i].pattern, cases[i].frame, out, &error), HD_OK);
        assert_string_equal(out, cases[i].expected);
    }
    assert_int_equal(hd_pattern_format("%d", -1, out, &error), HD_BAD_INPUT);
}

TEST(one_file_has_many_names) {
    char absolute[HD_MAX_PATH];
    const struct {
        const char *first, *second;
        bool is_same;
    } cases[] = {{"same/a", "same/hard", true},
                 {"same/a", "same/soft", true},
                 {"same/a", "same/b", false},
                 {"same/a", "same/new", false},
                 {"same/new", "same/here/new", true},
                 {"same/new", "./same//here/../new", false},
                 {"same/new", "same/none/../new", true},
                 {"same/new", absolute, true},
                 {"same/new", "same/newer", false},
                 {"/", "/..", true}};
    assert_int_equal(mkdir("same", 0777), 0);
    write_bytes("same/a", "", 0);
    write_bytes("same/b", "", 0);
    assert_int_equal(link("same/a", "same/hard"), 0);
    assert_int_equal(symlink("a", "same/soft"), 0);
    assert_int_equal(symlink("../same", "same/here"), 0);
    snprintf(absolute, sizeof absolute, "%s/same/new", test_folder);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *a = cases[i].first, *b = cases[i].second;
        if (hd_path_is_same(a, b) != cases[i].is_same || hd_path_is_same(b, a) != cases[i].is_same)
            fail_msg("%s and %s are %s file", a, b, cases[i].is_same ? "not one" : "one");
    }
}
