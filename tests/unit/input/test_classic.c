/* SPDX-License-Identifier: MIT */
/* The official example of the classic input: read unchanged, with a part changed, and printed.
   Errors are refused, with a message that says where and why. */
#define _XOPEN_SOURCE 700

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>

#include "input/classic.h"
#include "same_scene.h"

static const char official[] =
    "1024\n"
    "out/img_%d.data\n"
    "640 480 120\n"
    "7.0 3.0 0.0      2.0 1.0          2.0 6.0 1.0    0.0 0.0\n"
    "2.0 0.0 0.0      0.5 0.1          1.0 4.0 1.0    0.0 0.0\n"
    "2.0 0.0 0.0      1.0 0.0 0.0      1.0    0.9     0.1       10\n"
    "0.0 2.0 0.0      0.0 1.0 0.0      0.75   0.8     0.2       5\n"
    "0.0 0.0 0.0      0.0 0.7 0.7      0.5    0.7     0.3       2\n"
    "-5.0 -5.0 -1.0 -5.0 5.0 -1.0      5.0 5.0 -1.0   5.0 -5.0 -1.0   ~/floor.data   "
    "0.0 1.0 0.0   0.5\n"
    "2\n"
    "-10.0 0.0 10.0             1.0 1.0 1.0\n"
    "1.0 0.0 10.0               0.0 0.0 1.0\n"
    "10 16\n";

/* Positions in the list of tokens. */
enum {
    FRAMES = 0,
    OUTPUT = 1,
    WIDTH = 2,
    VIEW = 4,
    EYE_R_AMPLITUDE = 8,
    TARGET_Z_PHASE = 24,
    SOLID_1 = 25,
    SOLID_2 = SOLID_1 + 10,
    FLOOR = SOLID_1 + 30,
    TEXTURE = FLOOR + 12,
    LIGHT_COUNT = TEXTURE + 5,
    DEPTH = LIGHT_COUNT + 13,
    SAMPLES = DEPTH + 1
};

static HdSceneFile input, again;
static HdError error;

/* Returns the token's begin and, by `length`, its length. */
static size_t token_at(int index, size_t *length) {
    static const char spaces[] = " \n";
    size_t start = 0;
    for (int i = 0; i < index; i++) {
        start += strcspn(official + start, spaces);
        start += strspn(official + start, spaces);
    }
    *length = strcspn(official + start, spaces);
    return start;
}

/* Parses a copy with no zero byte behind it, so that a memory checker detects a byte read too
   many. */
static HdStatus parse_bytes(const char *text, size_t size, int variant) {
    char *copy = malloc(size > 0 ? size : 1);
    assert_non_null(copy);
    memcpy(copy, text, size);
    const HdStatus status = hd_classic_parse(&input, copy, size, "standard input", variant, &error);
    free(copy);
    return status;
}

static void expect_parsed(const char *text, int variant) {
    if (parse_bytes(text, strlen(text), variant) != HD_OK)
        fail_msg("%s", error.message);
}

/* Returns the official text with one token replaced; the caller frees it. */
static char *with_token(int index, const char *replacement) {
    size_t length;
    const size_t start = token_at(index, &length), size = sizeof official + strlen(replacement);
    char *text = malloc(size);
    assert_non_null(text);
    snprintf(text, size, "%.*s%s%s", (int)start, official, replacement, official + start + length);
    return text;
}

static void expect_token_accepted(int index, const char *replacement) {
    char *text = with_token(index, replacement);
    expect_parsed(text, 4);
    free(text);
}

static void expect_bytes_rejected(const char *text, size_t size, const char *message) {
    assert_int_equal(parse_bytes(text, size, 4), HD_BAD_INPUT);
    assert_int_equal(error.status, HD_BAD_INPUT);
    expect_contains(error.message, message);
    assert_null(strchr(error.message, '\n'));
    assert_null(input.scene.solids);
    assert_null(input.scene.lights);
    assert_int_equal(input.scene.solid_count, 0);
    assert_int_equal(input.output.path[0], '\0');
}

static void expect_token_rejected(int index, const char *replacement, const char *message) {
    char *text = with_token(index, replacement);
    expect_bytes_rejected(text, strlen(text), message);
    free(text);
}

#define WHITE                                                                                      \
    { 1.0, 1.0, 1.0 }
#define SURFACE .mirror_tint = WHITE, .diffuse = 0.5, .shininess = 64, .index_of_refraction = 1.0

/* With so many lights on each of so many edges. */
static HdSolid classic_solid(HdSolidKind kind, HdVec3 centre, HdVec3 colour, double radius,
                             double reflection, double transparency, int per_edge, int edges) {
    return (HdSolid){
        .kind = kind,
        .centre = centre,
        .circumradius = radius,
        .face = {SURFACE, .colour = colour, .specular = transparency, .reflection = reflection,
                 .transmission = transparency},
        .rim_width = 0.04 * radius,
        .rim = {SURFACE, .colour = {0.03, 0.03, 0.03}, .specular = 0.2},
        .lights = {
            per_edge, 1, {WHITE}, 0.7 / (per_edge * edges), {radius, 0.0}, 0.02 * radius, 4.0}};
}

TEST(test_official_example) {
    HdSolid solids[] = {classic_solid(HD_TETRAHEDRON, hd_vec3(2.0, 0.0, 0.0),
                                      hd_vec3(1.0, 0.0, 0.0), 1.0, 0.9, 0.1, 10, 6),
                        classic_solid(HD_OCTAHEDRON, hd_vec3(0.0, 2.0, 0.0), hd_vec3(0.0, 1.0, 0.0),
                                      0.75, 0.8, 0.2, 5, 12),
                        classic_solid(HD_DODECAHEDRON, hd_vec3(0.0, 0.0, 0.0),
                                      hd_vec3(0.0, 0.7, 0.7), 0.5, 0.7, 0.3, 2, 30)};
    HdLight lights[] = {{{-10.0, 0.0, 10.0}, WHITE, {0.0, 0.0}},
                        {{1.0, 0.0, 10.0}, {0.0, 0.0, 1.0}, {0.0, 0.0}}};
    const HdSceneFile expected = {
        .scene = {.frame_count = 1024,
                  .width = 640,
                  .height = 480,
                  .field_of_view_degrees = 120.0,
                  .eye.cylinder = {7.0, 3.0, 0.0, 2.0, 1.0, 2.0, 6.0, 1.0, 0.0, 0.0},
                  .target.cylinder = {2.0, 0.0, 0.0, 0.5, 0.1, 1.0, 4.0, 1.0, 0.0, 0.0},
                  .depth = 10,
                  .samples_per_side = 16,
                  .exposure = 1.0,
                  .solid_count = 3,
                  .solids = solids,
                  .light_count = 2,
                  .lights = lights,
                  .floor = {.present = true,
                            .corners = {{-5, -5, -1}, {-5, 5, -1}, {5, 5, -1}, {5, -5, -1}},
                            .material = {SURFACE, .colour = {0.0, 1.0, 0.0}, .specular = 0.5,
                                         .reflection = 0.5}}},
        .output = {"out/img_%d.data", {{HD_CURVE_LINEAR, 8, false}, 30, false}},
        .texture_path = "~/floor.data",
        .texture_curve = HD_CURVE_LINEAR};
    expect_parsed(official, 4);
    expect_same_file(&input, &expected);
    assert_int_equal(input.scene.floor.texture.width, 0);
    hd_scene_file_free(&input);
    assert_null(input.scene.solids);
}

TEST(test_valid_numbers) {
    static const char *const cases[] = {"90", "+90.", "9E1", ".9e+2", "900.0e-1", "00090"};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        expect_token_accepted(VIEW, cases[i]);
        expect_near(input.scene.field_of_view_degrees, 90.0, 0.0);
        hd_scene_file_free(&input);
    }
    expect_token_accepted(VIEW, "1e-320");
    hd_scene_file_free(&input);
    expect_token_accepted(FRAMES, "+0012");
    assert_int_equal(input.scene.frame_count, 12);
    hd_scene_file_free(&input);
    expect_token_accepted(SOLID_1 + 9, "0");
    expect_near(input.scene.solids[0].lights.intensity, 0.0, 0.0);
    hd_scene_file_free(&input);
}

TEST(test_variants) {
    static const char *const names[10] = {"TGO", "TGD", "TGI", "TOD", "TOI",
                                          "TDI", "GOD", "GOI", "GDI", "ODI"};
    for (int variant = 1; variant <= 10; variant++) {
        expect_parsed(official, variant);
        for (int i = 0; i < 3; i++) {
            const int kind = (int)(strchr("TGODI", names[variant - 1][i]) - "TGODI");
            assert_int_equal(input.scene.solids[i].kind, kind);
        }
        hd_scene_file_free(&input);
    }
    for (int wrong = 0; wrong <= 11; wrong += 11) {
        assert_int_equal(parse_bytes(official, strlen(official), wrong), HD_BAD_INPUT);
        expect_contains(error.message, "expected 1 to 10");
    }
}

/* Prints into `text`. */
static HdStatus print(char *text, size_t size) {
    memset(text, 0, size);
    FILE *stream = fmemopen(text, size, "w");
    assert_non_null(stream);
    const HdStatus status = hd_classic_print(stream, &input, &error);
    fclose(stream);
    return status;
}

/* Numbers need all their digits, and no more. */
TEST(test_printed_text_is_read_back) {
    char text[4096];
    expect_parsed(official, 4);
    input.scene.eye.cylinder =
        (HdCylinderPath){1.0 / 3.0, 0.1 + 0.2, -2.0 / 7.0, 1e-300, 123456789.123456789,
                         4.9e-324,  1e11 / 3,  -0.0,       1e-7,   -1.0};
    input.scene.solids[1].centre = hd_vec3(0.1, -1e-17, 1e11 + 0.1);
    input.scene.lights[1].intensity = hd_vec3(nextafter(1.0, 2.0), 2.0 / 3.0, 1e5);
    if (print(text, sizeof text) != HD_OK)
        fail_msg("%s", error.message);
    expect_contains(text, "1024\nout/img_%d.data\n640 480 120\n");
    expect_contains(text, "\n2 0 0   0.5 0.1   1 4 1   0 0\n2 0 0   1 0 0   1 0.9 0.1   10\n");
    again = input;
    expect_parsed(text, 4);
    expect_same_file(&input, &again);
    hd_scene_file_free(&input);
    hd_scene_file_free(&again);
}

static void expect_not_printed(const char *message) {
    char text[4096];
    assert_int_equal(print(text, sizeof text), HD_BAD_INPUT);
    expect_contains(error.message, message);
    assert_string_equal(text, "");
}

TEST(test_unprintable_scenes) {
    expect_parsed(official, 4);
    input.scene.solid_count = 2;
    expect_not_printed("the scene has 2 solids, expected 3");
    input.scene.solid_count = 3;
    input.scene.floor.present = false;
    expect_not_printed("the scene has no floor");
    input.scene.floor.present = true;
    input.scene.light_count = 5;
    expect_not_printed("the scene has 5 lights, expected at most 4");
    input.scene.light_count = 2;
    strcpy(input.texture_path, "my floor.png");
    expect_not_printed("texture path is 'my floor.png'");
    input.texture_path[0] = '\0';
    expect_not_printed("texture path is ''");
    strcpy(input.output.path, "a\tb%d");
    expect_not_printed("output path is ");
    FILE *full = fopen("/dev/full", "w");
    if (full == NULL)
        skip();
    strcpy(input.output.path, "%d");
    strcpy(input.texture_path, "a");
    assert_int_equal(hd_classic_print(full, &input, &error), HD_FAILED);
    expect_contains(error.message, "cannot write the configuration");
    fclose(full);
    hd_scene_file_free(&input);
}

/* A number cut in two may still be one, but nothing is read behind the end. */
TEST(test_every_truncation) {
    size_t length;
    for (size_t size = token_at(SAMPLES, &length) + 1; size-- > 0;) {
        const bool is_whole = size == 0 || isspace((unsigned char)official[size]) ||
                              isspace((unsigned char)official[size - 1]);
        expect_bytes_rejected(official, size,
                              is_whole ? " is missing, expected " : "standard input:");
    }
    assert_int_equal(hd_classic_parse(&input, NULL, 0, "standard input", 4, &error), HD_BAD_INPUT);
}

TEST(test_invalid_numbers) {
    static const char *const wrong[] = {
        "nan", "-inf", "infinity", "0x10", "1.5.2", "1,5", "--1", "+-1",   "1e",
        "1e+", ".",    "-",        "+.e1", "1.0f",  "1d5", "e5",  "1_000", "\xef\xbb\xbf.5"};
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
        {EYE_R_AMPLITUDE, "abc", ":4: eye: r amplitude is 'abc', expected a number"},
        {TARGET_Z_PHASE, "abc", ":5: target: z phase is 'abc', expected a number"},
        {FLOOR + 5, "abc", ":9: floor: corner 2 z is 'abc', expected a number"},
        {LIGHT_COUNT + 2, "abc", ":11: light 1: position y is 'abc', expected a number"},
        /* Text that does not begin like such an input belongs to others, and is not quoted. */
        {FRAMES, "abc", ":1: number of frames is '...', expected a whole number"},
        {VIEW, "1e999", ":3: field of view is '1e999', expected a number within the range"},
        {FRAMES, "16.0",
         ":1: number of frames is '16.0', expected a whole number from 1 to 10000000"},
        {VIEW, "\x1b[31m\x07", ":3: field of view is '\\u001b[31m\\u0007', expected a number"},
        /* counts */
        {FRAMES, "0", ":1: number of frames is '0', expected a whole number from 1"},
        {FRAMES, "10000001", ":1: number of frames is '10000001'"},
        {FRAMES, "4294967297", ":1: number of frames is '4294967297'"},
        {WIDTH, "0", ":3: width is '0', expected a whole number from 1 to 65535"},
        {WIDTH, "65536", ":3: width is '65536', expected a whole number from 1 to 65535"},
        {WIDTH + 1, "65536", ":3: height is '65536'"},
        {SOLID_1 + 9, "16667",
         ":6: solid 1: number of lights per edge is '16667', expected a whole "
         "number from 0 to 16666"},
        {LIGHT_COUNT, "5", ":10: number of lights is '5', expected a whole number from 0 to 4"},
        {DEPTH, "-1", ":13: recursion depth is '-1', expected a whole number from 0 to 1000"},
        {DEPTH, "1001", ":13: recursion depth is '1001'"},
        {SAMPLES, "0", ":13: square root of the number of rays per pixel is '0'"},
        {SAMPLES, "65", ":13: square root of the number of rays per pixel is '65'"},
        /* shares, and values that the scene refuses */
        {SOLID_1 + 3, "1.5", ":6: solid 1: colour's red is 1.5, expected a number from 0 to 1"},
        {SOLID_2 + 8, "-0.1", ":7: solid 2: transparency is -0.1"},
        {TEXTURE + 1, "2", ":9: floor: tint's red is 2, expected a number from 0 to 1"},
        {SOLID_2 + 8, "0.5", ": solid 2: reflection + transmission is 1.3, expected at most 1"},
        {SOLID_1 + 6, "-1", ": solid 1: radius is -1"},
        {VIEW, "180", ": field of view is 180"},
        {FLOOR + 2, "4", ": floor: its diagonals"},
        {LIGHT_COUNT + 4, "-1", ": light 1: intensity's red is -1"},
        /* paths; patterns have tests of their own */
        {OUTPUT, "img.data", ":2: output path: "},
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
    expect_token_accepted(TEXTURE, token);
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
                          "standard input:15: the text after the last value is '17', expected the "
                          "end of the input");
}
