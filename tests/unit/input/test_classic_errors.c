/* SPDX-License-Identifier: MIT */
/* Classic inputs that are wrong: each is refused, with a message that says where and why. */
#include <ctype.h>

#include "classic_text.h"

static HdSceneFile input;
static HdError error;

static void expect_bytes_rejected(const char *text, size_t size, const char *message) {
    assert_int_equal(parse_bytes(&input, text, size, 4, &error), HD_BAD_INPUT);
    assert_int_equal(error.status, HD_BAD_INPUT);
    expect_contains(error.message, message);
    assert_null(strchr(error.message, '\n'));
    expect_empty(&input);
}

static void expect_token_rejected(int index, const char *replacement, const char *message) {
    char *text = with_token(index, replacement);
    expect_bytes_rejected(text, strlen(text), message);
    free(text);
}

/* A number cut in two may still be one, but nothing is read behind the end. */
TEST(test_every_truncation) {
    size_t length;
    for (size_t size = token_at(SAMPLES, &length, NULL) + 1; size-- > 0;) {
        const bool is_whole = size == 0 || isspace((unsigned char)official[size]) ||
                              isspace((unsigned char)official[size - 1]);
        expect_bytes_rejected(official, size,
                              is_whole ? " is missing, expected " : "standard input:");
    }
    assert_int_equal(hd_classic_parse(&input, NULL, 0, "standard input", 4, &error), HD_BAD_INPUT);
}

TEST(test_the_missing_field_is_named) {
    static const struct {
        int token;
        const char *message;
    } cases[] = {
        {FRAMES, "standard input:1: number of frames is missing, expected a whole number"},
        {OUTPUT, "standard input:1: output path is missing, expected a path"},
        {VIEW, "standard input:3: field of view is missing, expected a number"},
        {EYE_R_AMPLITUDE, "standard input:4: eye: r amplitude is missing"},
        {TARGET_Z_PHASE, "standard input:5: target: z phase is missing"},
        {SOLID_2 + 4, "standard input:7: solid 2: colour's green is missing"},
        {FLOOR + 5, "standard input:9: floor: corner 2 z is missing"},
        {TEXTURE, "standard input:9: floor: texture path is missing, expected a path"},
        {LIGHT_COUNT + 2, "standard input:11: light 1: position y is missing"},
        {SAMPLES, "standard input:13: square root of the number of rays per pixel is missing"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        size_t length, end = 0;
        if (cases[i].token > 0)
            end = token_at(cases[i].token - 1, &length, NULL) + length;
        expect_bytes_rejected(official, end, cases[i].message);
    }
}

TEST(test_a_word_in_place_of_every_number) {
    for (int i = 0; i < TOKENS; i++) {
        size_t length;
        int line;
        char start[64];
        if (i == OUTPUT || i == TEXTURE)
            continue;
        token_at(i, &length, &line);
        snprintf(start, sizeof start, "standard input:%d: ", line);
        expect_token_rejected(i, "abc", start);
        /* What does not begin as such an input is somebody else's, and not quoted. */
        expect_token_rejected(i, "abc",
                              i == FRAMES ? " is '...', expected a" : " is 'abc', expected a");
    }
}

TEST(test_what_is_no_number) {
    static const char *const wrong[] = {
        "nan",   "NaN",  "inf",  "-inf", "infinity", "0x10",  "0x1p3",
        "1.5.2", "1,5",  "--1",  "+-1",  "1e",       "1e+",   ".",
        "-",     "+.e1", "1.0f", "1d5",  "e5",       "1_000", "\xef\xbb\xbf.5",
        "nan(1)"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        expect_token_rejected(VIEW, wrong[i], "standard input:3: field of view is '");
        expect_token_rejected(FRAMES, wrong[i], "standard input:1: number of frames is '");
    }
}

TEST(test_wrong_values) {
    static const struct {
        int token;
        const char *text, *message;
    } cases[] = {
        /* numbers */
        {VIEW, "abc", ":3: field of view is 'abc', expected a number"},
        {SOLID_2 + 7, "abc", ":7: solid 2: reflection is 'abc', expected a number"},
        {VIEW, "1e999", ":3: field of view is '1e999', expected a number within the range"},
        {FRAMES, "16.0",
         ":1: number of frames is '16.0', expected a whole number from 1 to 10000000"},
        {FRAMES, "1e3", ":1: number of frames is '1e3', expected a whole number"},
        {VIEW, "\x1b[31m\x07", ":3: field of view is '\\u001b[31m\\u0007', expected a number"},
        /* counts */
        {FRAMES, "0", ":1: number of frames is '0', expected a whole number from 1"},
        {FRAMES, "10000001", ":1: number of frames is '10000001'"},
        {FRAMES, "99999999999999999999", ":1: number of frames is '9999"},
        {FRAMES, "4294967297", ":1: number of frames is '4294967297'"},
        {WIDTH, "0", ":3: width is '0', expected a whole number from 1 to 65535"},
        {WIDTH, "65536", ":3: width is '65536', expected a whole number from 1 to 65535"},
        {WIDTH + 1, "-480", ":3: height is '-480'"},
        {WIDTH + 1, "65536", ":3: height is '65536'"},
        {SOLID_1 + 9, "-1", ":6: solid 1: number of lights per edge is '-1'"},
        {SOLID_1 + 9, "16667",
         ":6: solid 1: number of lights per edge is '16667', expected a whole "
         "number from 0 to 16666"},
        {LIGHT_COUNT, "5", ":10: number of lights is '5', expected a whole number from 0 to 4"},
        {LIGHT_COUNT, "-1", ":10: number of lights is '-1'"},
        {DEPTH, "-1", ":13: recursion depth is '-1', expected a whole number from 0 to 1000"},
        {DEPTH, "1001", ":13: recursion depth is '1001'"},
        {SAMPLES, "0", ":13: square root of the number of rays per pixel is '0'"},
        {SAMPLES, "65", ":13: square root of the number of rays per pixel is '65'"},
        /* shares, and what the scene refuses */
        {SOLID_1 + 3, "1.5", ":6: solid 1: colour's red is 1.5, expected a number from 0 to 1"},
        {SOLID_1 + 7, "1.1", ":6: solid 1: reflection is 1.1, expected a number from 0 to 1"},
        {SOLID_2 + 8, "-0.1", ":7: solid 2: transparency is -0.1"},
        {TEXTURE + 1, "2", ":9: floor: tint's red is 2, expected a number from 0 to 1"},
        {TEXTURE + 4, "-0.5", ":9: floor: reflection is -0.5"},
        {SOLID_2 + 8, "0.5", ": solid 2: reflection + transmission is 1.3, expected at most 1"},
        {SOLID_1 + 6, "0", ": solid 1: radius is 0"},
        {SOLID_1 + 6, "-1", ": solid 1: radius is -1"},
        {VIEW, "180", ": field of view is 180"},
        {FLOOR + 2, "4", ": floor: its diagonals"},
        {LIGHT_COUNT + 4, "-1", ": light 1: intensity's red is -1"},
        /* paths; what patterns are is tested with them */
        {OUTPUT, "img.data", ":2: output path: "},
        {OUTPUT, "%d/%d.data", ":2: output path: "},
        {OUTPUT, "%n%d", ":2: output path: "},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char message[256];
        snprintf(message, sizeof message, "standard input%s", cases[i].message);
        expect_token_rejected(cases[i].token, cases[i].text, message);
    }
}

TEST(test_long_tokens) {
    static char token[HD_MAX_PATH + 1];
    memset(token, 'x', HD_MAX_PATH);
    expect_token_rejected(TEXTURE, token,
                          "standard input:9: floor: texture path has 4096 characters, expected at "
                          "most 4095");
    token[HD_MAX_PATH - 1] = '\0';
    expect_token_accepted(&input, TEXTURE, token);
    assert_string_equal(input.texture_path, token);
    hd_scene_file_free(&input);
    expect_token_rejected(VIEW, token, "xxx...', expected a number");
    memset(token, '9', HD_MAX_PATH);
    expect_token_rejected(VIEW, token, "field of view has 4096 characters");
    /* 20 two-byte letters fill the 40 bytes shown; one byte more must not cut a letter in two. */
    strcpy(token, "a");
    for (int i = 0; i < 21; i++)
        strcat(token, "\xc3\xa4");
    expect_token_rejected(VIEW, token, "\xc3\xa4\xc3\xa4...'");
}

TEST(test_wrong_texts) {
    static const char scene[] = "\xef\xbb\xbf \n{\"hedron\": 1}";
    char text[sizeof official + 16];
    expect_bytes_rejected(scene, strlen(scene),
                          "standard input: this looks like a scene file, which "
                          "'hedron render FILE' renders");
    expect_bytes_rejected("10\0", 3, "standard input:1: number of frames holds a zero byte");
    snprintf(text, sizeof text, "%s\n 17 18", official);
    expect_bytes_rejected(text, strlen(text),
                          "standard input:15: what follows the last value is '17', expected the "
                          "end of the input");
}

TEST(test_no_such_variant) {
    const int wrong[4] = {0, 11, -1, 2147483647};
    for (int i = 0; i < 4; i++) {
        assert_null(hd_classic_variant_kinds(wrong[i]));
        assert_int_equal(parse_bytes(&input, official, strlen(official), wrong[i], &error),
                         HD_BAD_INPUT);
        expect_contains(error.message, "expected 1 to 10");
    }
}
