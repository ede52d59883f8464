/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "system/path.h"
#include "test_folder.h"

static HdError error;
static char out[HD_MAX_PATH];

TEST(home_is_expanded_at_the_start_only) {
    static const char *const cases[][2] = {{"~", "/home/somebody"},
                                           {"~/", "/home/somebody/"},
                                           {"~/a/b.png", "/home/somebody/a/b.png"},
                                           {"~other/a", "~other/a"},
                                           {"a/~/b", "a/~/b"},
                                           {"/a", "/a"},
                                           {"", ""}};
    setenv("HOME", "/home/somebody", 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(hd_path_expand_home(cases[i][0], out, &error), HD_OK);
        assert_string_equal(out, cases[i][1]);
    }
}

TEST(home_comes_from_the_database_without_the_variable) {
    char unset[HD_MAX_PATH], empty[HD_MAX_PATH];
    unsetenv("HOME");
    assert_int_equal(hd_path_expand_home("~/x", unset, &error), HD_OK);
    setenv("HOME", "", 1);
    assert_int_equal(hd_path_expand_home("~/x", empty, &error), HD_OK);
    assert_int_equal(unset[0], '/');
    assert_string_equal(unset + strlen(unset) - 2, "/x");
    assert_string_equal(unset, empty);
}

TEST(long_names_are_refused) {
    char path[HD_MAX_PATH + 1];
    setenv("HOME", "/home", 1);
    memset(path, 'a', sizeof path);
    path[HD_MAX_PATH] = '\0';
    assert_int_equal(hd_path_expand_home(path, out, &error), HD_BAD_INPUT);
    assert_int_equal(hd_path_make_parents(path, &error), HD_BAD_INPUT);
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

static bool is_folder(const char *path) {
    struct stat found;
    return stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

TEST(parents_are_made) {
    char absolute[HD_MAX_PATH];
    assert_int_equal(hd_path_make_parents("one/two//three/file", &error), HD_OK);
    assert_true(is_folder("one/two/three"));
    assert_int_equal(access("one/two/three/file", F_OK), -1);
    assert_int_equal(hd_path_make_parents("one/two/three/file", &error), HD_OK);
    snprintf(absolute, sizeof absolute, "%s/four/five/file", test_folder);
    assert_int_equal(hd_path_make_parents(absolute, &error), HD_OK);
    assert_true(is_folder("four/five"));
    assert_int_equal(hd_path_make_parents("./six/../seven/file", &error), HD_OK);
    assert_true(is_folder("seven"));
    assert_int_equal(hd_path_make_parents("file", &error), HD_OK);
    assert_int_equal(hd_path_make_parents("", &error), HD_OK);
    assert_int_equal(hd_path_make_parents("/file", &error), HD_OK);
}

TEST(files_in_the_way_are_named) {
    write_bytes("block", "", 0);
    assert_int_equal(hd_path_make_parents("block/file", &error), HD_FAILED);
    expect_contains(error.message, "folder block for block/file: a file has that name");
    assert_int_equal(hd_path_make_parents("block/deep/file", &error), HD_FAILED);
    expect_contains(error.message, "folder block for block/deep/file: a file has that name");
}

TEST(numbers_are_found) {
    const char *const with[] = {"%%%d", "%x%d", "%d%d", "%5%d", "##########%d"};
    const char *const without[] = {"",     "a.png", "%",  "%%d",  "%%%%d", "%5d",       "%0d",
                                   "%00d", "%010d", "%i", "%-3d", "%0",    "##########"};
    for (size_t i = 0; i < sizeof with / sizeof *with; i++)
        assert_true(hd_pattern_has_number(with[i]));
    for (size_t i = 0; i < sizeof without / sizeof *without; i++)
        assert_false(hd_pattern_has_number(without[i]));
}

TEST(wrong_patterns_are_refused) {
    const char *const wrong[] = {"",     "a.png", "%%d",     "%d%d",  "%d-%03d",   "%s",
                                 "%d%s", "%d%",   "%n%d",    "%5d",   "%0d",       "%010d",
                                 "%ld",  "%-3d",  "%d 50%x", "%d%d#", "#%d#%d",    "#/#",
                                 "##-#", "#%s",   "#%",      "%0#",   "##########"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(hd_pattern_check(wrong[i], &error), HD_BAD_INPUT);
        expect_contains(error.message, wrong[i]);
        assert_int_equal(hd_pattern_format(wrong[i], 1, out, &error), HD_BAD_INPUT);
    }
}

TEST(frames_are_named) {
    static const struct {
        const char *pattern;
        int frame;
        const char *expected;
    } cases[] = {
        {"%d", 0, "0"},
        {"out/%d.data", 123, "out/123.data"},
        {"f%03d.png", 7, "f007.png"},
        {"f%03d.png", 12345, "f12345.png"},
        {"%01d", 5, "5"},
        {"%09d", INT32_MAX, "2147483647"},
        {"%09d", 42, "000000042"},
        {"100%%/%d%%d", 3, "100%/3%d"},
        {"out/####.png", 7, "out/0007.png"},
        {"#1/##_%03d%%.png", 7, "#1/##_007%.png"},
        {"#", 70, "70"},
        {"f###", 12345, "f12345"},
        {"#########%%", 42, "000000042%"},
        {"take ##/a.data", 5, "take 05/a.data"},
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

static void expect_same(const char *first, const char *second, bool expected) {
    if (hd_path_is_same(first, second) != expected || hd_path_is_same(second, first) != expected)
        fail_msg("%s and %s are %s file", first, second, expected ? "not one" : "one");
}

TEST(one_file_has_many_names) {
    char absolute[HD_MAX_PATH];
    assert_int_equal(mkdir("same", 0777), 0);
    write_bytes("same/a", "", 0);
    write_bytes("same/b", "", 0);
    assert_int_equal(link("same/a", "same/hard"), 0);
    assert_int_equal(symlink("a", "same/soft"), 0);
    assert_int_equal(symlink("../same", "same/here"), 0);
    snprintf(absolute, sizeof absolute, "%s/same/new", test_folder);
    expect_same("same/a", "same/a", true);
    expect_same("same/a", "same/hard", true);
    expect_same("same/a", "same/soft", true);
    expect_same("same/a", "same/b", false);
    expect_same("same/a", "same/new", false);
    expect_same("same/new", "same/here/new", true);
    expect_same("same/new", "./same//here/../new", false);
    expect_same("same/new", "same/none/../new", true);
    expect_same("same/new", absolute, true);
    expect_same("same/new", "same/newer", false);
    expect_same("same/x", "same/y", false);
    expect_same("same/-", "same/+", false);
    expect_same("/", "/..", true);
}
