/* SPDX-License-Identifier: MIT */
/* What messages about scene files say to people who are used to other words. */
#include "scene_text.h"

static HdSceneFile file;

static void test_output_paths(void **state) {
    (void)state;
    static const char *const wrong[] = {"film.avi", "x.jpg", "none", "film.mp4.old", ".png/x"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char change[64], message[256];
        snprintf(change, sizeof change, "output.path=%s", wrong[i]);
        snprintf(message, sizeof message,
                 "a.json: --set %s: output.path is \"%s\", expected the name of a film (.mp4, .mkv "
                 "or .gif) or of a picture (.png, .pfm or .data)",
                 change, wrong[i]);
        assert_string_equal(expect_refused(rich_text, change, ""), message);
    }
    expect_refused(rich_text, "output.path=%d_%d.png",
                   "output.path cannot be used: the pattern \"%d_%d.png\" has 2 frame numbers");
    expect_refused(rich_text, "output.path=%s.png", "output.path cannot be used: the pattern");
    expect_refused(rich_text, "output.path=#.mp4",
                   "output.path is \"#.mp4\", expected a film without a number");
    static const char *const right[] = {"a.PNG", "a/####.pfm", "%04d.data", "f.mkv", "100%.gif"};
    for (size_t i = 0; i < sizeof right / sizeof right[0]; i++) {
        char change[64];
        snprintf(change, sizeof change, "output.path=%s", right[i]);
        expect_scene(&file, rich_text, change);
        assert_string_equal(file.output.path, right[i]);
        hd_scene_file_free(&file);
    }
}

static void test_numbers_by_value(void **state) {
    (void)state;
    expect_scene(&file, rich_text, "output.bits=16.0");
    assert_int_equal(file.output.style.picture.bits, 16);
    hd_scene_file_free(&file);
    expect_scene(&file, rich_text, "hedron=1.0");
    hd_scene_file_free(&file);
    expect_refused(rich_text, "output.bits=16.5", "output.bits is 16.5, expected 8 or 16");
    expect_refused(rich_text, "solids[0].kind=\"cub\"", "solids[0].kind is a string, \"cub\"");
    expect_refused(rich_text, "image.width=12345678901234567890",
                   "image.width is 1.2345678901234567e19, expected an integer from 1 to 65535");
    expect_refused(rich_text, "image.width=1e999",
                   "--set image.width=1e999: the value is too large, expected a number that a "
                   "double can hold");
}

static void test_control_characters(void **state) {
    (void)state;
    expect_refused(rich_text, "floor.texture.file=\"a\\u001b[2J.png\"",
                   "floor.texture.file is a string, \"a\\u001b[2J.png\", expected a name without "
                   "control characters");
    expect_refused(rich_text, "output.path=\"a\\n.png\"", "is a string, \"a\\u000a.png\"");
    expect_refused(rich_text, "output.path=\"a\\u007f.png\"", "is a string, \"a\\u007f.png\"");
    expect_refused(rich_text, "output.path=\"a\\u009b.png\"", "is a string, \"a\\u009b.png\"");
    expect_refused(rich_text, "solids[0].material=\"a\\u0085\"", "is a string, \"a\\u0085\"");
    expect_scene(&file, rich_text, "output.path=\"\\u00a0\\u00e9.png\"");
    assert_string_equal(file.output.path, "\xc2\xa0\xc3\xa9.png");
    hd_scene_file_free(&file);
    static const char text[] = "{\"a\x1b\": 1}";
    const char *message = expect_refused(text, NULL, "a.json:1:");
    assert_null(strchr(message, '\x1b'));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_output_paths),
        cmocka_unit_test(test_numbers_by_value),
        cmocka_unit_test(test_control_characters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
