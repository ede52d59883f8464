/* SPDX-License-Identifier: MIT */
/* Classic inputs that are wrong: each is refused, with a message that says where and why. */
#include "classic_text.h"

static void expect_rejected(const char *text, const char *message) {
    static HdError error;
    static HdSceneFile input;
    const HdStatus status = parse_bytes(&input, text, strlen(text), 4, &error);
    assert_int_equal(status, HD_BAD_INPUT);
    assert_int_equal(error.status, HD_BAD_INPUT);
    expect_contains(error.message, message);
    assert_null(strchr(error.message, '\n'));
    expect_empty(&input);
}

static void expect_token_rejected(int index, const char *replacement, const char *message) {
    char *text = with_token(index, replacement);
    expect_rejected(text, message);
    free(text);
}

TEST(test_every_truncation) {
    static HdError error;
    static HdSceneFile input;
    const Tokens tokens = official_tokens();
    assert_int_equal(tokens.count, TOKENS);
    for (int i = 0; i < tokens.count; i++) {
        const size_t size = i == 0 ? 0 : tokens.end[i - 1];
        assert_int_equal(parse_bytes(&input, official, size, 4, &error), HD_BAD_INPUT);
        expect_contains(error.message, " is missing, expected ");
        expect_empty(&input);
        assert_int_equal(parse_bytes(&input, official, tokens.start[i], 4, &error), HD_BAD_INPUT);
        expect_contains(error.message, " is missing, expected ");
    }
}

/* A number cut in two may still be one; nothing may be read behind the end. */
TEST(test_every_byte_as_the_last) {
    static HdError error;
    static HdSceneFile input;
    for (size_t size = 0; size < sizeof official; size++) {
        const HdStatus status = parse_bytes(&input, official, size, 4, &error);
        assert_true(status == HD_OK || status == HD_BAD_INPUT);
        hd_scene_file_free(&input);
    }
}

TEST(test_the_missing_field_is_named) {
    static HdError error;
    static HdSceneFile input;
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
    const Tokens tokens = official_tokens();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const int before = cases[i].token - 1;
        const size_t size = before < 0 ? 0 : tokens.end[before];
        assert_int_equal(parse_bytes(&input, official, size, 4, &error), HD_BAD_INPUT);
        expect_contains(error.message, cases[i].message);
    }
    assert_int_equal(hd_classic_parse(&input, NULL, 0, "standard input", 4, &error), HD_BAD_INPUT);
}

TEST(test_a_word_in_place_of_every_number) {
    const Tokens tokens = official_tokens();
    for (int i = 0; i < tokens.count; i++) {
        char start[64];
        if (i == OUTPUT || i == TEXTURE)
            continue;
        snprintf(start, sizeof start, "standard input:%d: ", tokens.line[i]);
        expect_token_rejected(i, "abc", start);
        /* What does not begin as such an input is somebody else's, and not quoted. */
        expect_token_rejected(i, "abc",
                              i == FRAMES ? " is '...', expected a" : " is 'abc', expected a");
    }
    expect_token_rejected(VIEW, "abc",
                          "standard input:3: field of view is 'abc', expected a number");
    expect_token_rejected(SOLID_2 + 7, "abc",
                          "standard input:7: solid 2: reflection is 'abc', expected a number");
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
    expect_token_rejected(VIEW, "1e999", "is '1e999', expected a number within the range");
    expect_token_rejected(FRAMES, "16.0", "is '16.0', expected a whole number from 1 to 10000000");
    expect_token_rejected(FRAMES, "1e3", "is '1e3', expected a whole number");
}

TEST(test_counts_out_of_range) {
    expect_token_rejected(FRAMES, "0", "number of frames is '0', expected a whole number from 1");
    expect_token_rejected(FRAMES, "10000001", "number of frames is '10000001'");
    expect_token_rejected(FRAMES, "99999999999999999999", "number of frames is '9999");
    expect_token_rejected(FRAMES, "4294967297", "number of frames is '4294967297'");
    expect_token_rejected(WIDTH, "65536", "width is '65536', expected a whole number from 1 to");
    expect_token_rejected(WIDTH + 1, "-480", "height is '-480'");
    expect_token_rejected(SOLID_1 + 9, "-1",
                          "standard input:6: solid 1: number of lights per edge is '-1'");
    expect_token_rejected(LIGHT_COUNT, "5",
                          "standard input:10: number of lights is '5', expected a whole number "
                          "from 0 to 4");
    expect_token_rejected(LIGHT_COUNT, "-1", "number of lights is '-1'");
    expect_token_rejected(DEPTH, "1001", "recursion depth is '1001'");
    expect_token_rejected(SAMPLES, "0", "square root of the number of rays per pixel is '0'");
    expect_token_rejected(SAMPLES, "65", "square root of the number of rays per pixel is '65'");
}

TEST(test_values_that_the_scene_refuses) {
    expect_token_rejected(SOLID_1 + 3, "1.5",
                          "standard input:6: solid 1: colour's red is 1.5, expected a number from "
                          "0 to 1");
    expect_token_rejected(SOLID_2 + 8, "-0.1", "standard input:7: solid 2: transparency is -0.1");
    expect_token_rejected(SOLID_2 + 8, "0.5",
                          "standard input: solid 2: reflection + transmission is 1.3, expected at "
                          "most 1");
    expect_token_rejected(SOLID_1 + 6, "0", "standard input: solid 1: radius is 0");
    expect_token_rejected(SOLID_1 + 6, "-1", "standard input: solid 1: radius is -1");
    expect_token_rejected(VIEW, "180", "standard input: field of view is 180");
    expect_token_rejected(FLOOR + 2, "4", "standard input: floor: its diagonals");
    expect_token_rejected(LIGHT_COUNT + 4, "-1", "standard input: light 1: intensity's red is -1");
}

TEST(test_output_path) {
    static HdSceneFile input;
    expect_token_rejected(OUTPUT, "img.data", "standard input:2: output path: ");
    expect_token_rejected(OUTPUT, "%d/%d.data", "standard input:2: output path: ");
    expect_token_rejected(OUTPUT, "%s%d.data", "standard input:2: output path: ");
    expect_token_rejected(OUTPUT, "%n%d", "standard input:2: output path: ");
    expect_token_accepted(&input, OUTPUT, "~/frames/%d");
    assert_string_equal(input.output.path, "~/frames/%d");
    hd_scene_file_free(&input);
}

TEST(test_long_tokens) {
    static HdSceneFile input;
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
}

TEST(test_strange_bytes) {
    static HdError error;
    static HdSceneFile input;
    char text[sizeof official];
    memcpy(text, official, sizeof text);
    text[2] = '\0';
    assert_int_equal(parse_bytes(&input, text, sizeof text - 1, 4, &error), HD_BAD_INPUT);
    expect_contains(error.message, "standard input:1: number of frames holds a zero byte");
    expect_token_rejected(VIEW, "\x1b[31m\x07",
                          "field of view is '\\u001b[31m\\u0007', expected a number");
    /* 20 two-byte letters fill the 40 bytes shown; one byte more must not cut a letter in two. */
    expect_token_rejected(VIEW,
                          "a\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4"
                          "\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4"
                          "\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4\xc3\xa4",
                          "\xc3\xa4\xc3\xa4...'");
    for (int byte = 1; byte < 256; byte++) {
        memcpy(text, official, sizeof text);
        text[40] = (char)byte;
        parse_bytes(&input, text, sizeof text - 1, 4, &error);
        hd_scene_file_free(&input);
    }
}

TEST(test_leftovers) {
    char text[sizeof official + 16];
    snprintf(text, sizeof text, "%s\n 17 18", official);
    expect_rejected(text, "standard input:15: what follows the last value is '17', expected the "
                          "end of the input");
    static HdSceneFile input;
    snprintf(text, sizeof text, "%s\n \t\r\n ", official);
    expect_parsed(&input, text, 4);
    hd_scene_file_free(&input);
}

TEST(test_no_such_variant) {
    static HdError error;
    static HdSceneFile input;
    const int wrong[4] = {0, 11, -1, 2147483647};
    for (int i = 0; i < 4; i++) {
        assert_null(hd_classic_variant_kinds(wrong[i]));
        assert_int_equal(parse_bytes(&input, official, strlen(official), wrong[i], &error),
                         HD_BAD_INPUT);
        expect_contains(error.message, "expected 1 to 10");
        expect_empty(&input);
    }
}
