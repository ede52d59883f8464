/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include <ctype.h>

#include "classic_text.h"
#include "same_scene.h"

static HdSceneFile input, again;
static HdError error;

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
        .output = {"out/img_%d.data", {{HD_CURVE_LINEAR, 8}, 30}},
        .texture_path = "~/floor.data",
        .texture_curve = HD_CURVE_LINEAR};
    expect_parsed(&input, official, 4);
    expect_same_file(&input, &expected);
    assert_int_equal(input.scene.floor.texture.width, 0);
    hd_scene_file_free(&input);
    expect_empty(&input);
}

TEST(test_no_light_and_no_edge_light) {
    size_t length;
    char text[sizeof official + 16];
    expect_token_accepted(&input, SOLID_1 + 9, "0");
    expect_near(input.scene.solids[0].lights.intensity, 0.0, 0.0);
    hd_scene_file_free(&input);
    snprintf(text, sizeof text, "%.*s0 3 2", (int)token_at(LIGHT_COUNT, &length, NULL), official);
    expect_parsed(&input, text, 4);
    assert_int_equal(input.scene.light_count, 0);
    assert_int_equal(input.scene.depth, 3);
    assert_int_equal(input.scene.samples_per_side, 2);
    hd_scene_file_free(&input);
}

TEST(test_any_white_space_separates) {
    static const char spaces[] = " \t\n\v\f\r";
    char text[sizeof official + 5];
    snprintf(text, sizeof text, "%s \t\r\n", official);
    for (size_t i = 0, next = 0; text[i] != '\0'; i++)
        if (isspace((unsigned char)text[i]))
            text[i] = spaces[next++ % (sizeof spaces - 1)];
    expect_parsed(&input, text, 4);
    expect_parsed(&again, official, 4);
    expect_same_file(&input, &again);
    hd_scene_file_free(&input);
    hd_scene_file_free(&again);
}

TEST(test_what_is_a_number) {
    static const struct {
        const char *text;
        double value;
    } cases[] = {{"90", 90.0},       {"+90.", 90.0},  {"9E1", 90.0},     {".9e+2", 90.0},
                 {"900.0e-1", 90.0}, {"00090", 90.0}, {"1e-320", 1e-320}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        expect_token_accepted(&input, VIEW, cases[i].text);
        expect_near(input.scene.field_of_view_degrees, cases[i].value, 0.0);
        hd_scene_file_free(&input);
    }
    expect_token_accepted(&input, FRAMES, "+0012");
    assert_int_equal(input.scene.frame_count, 12);
    hd_scene_file_free(&input);
}

TEST(test_variants) {
    static const char *const names[10] = {"TGO", "TGD", "TGI", "TOD", "TOI",
                                          "TDI", "GOD", "GOI", "GDI", "ODI"};
    static const char letters[] = "TGODI";
    static const int edges[5] = {6, 12, 12, 30, 30};
    static const int per_edge[3] = {10, 5, 2};
    for (int variant = 1; variant <= 10; variant++) {
        expect_parsed(&input, official, variant);
        for (int i = 0; i < 3; i++) {
            const int kind = (int)(strchr(letters, names[variant - 1][i]) - letters);
            const HdSolid *solid = &input.scene.solids[i];
            assert_int_equal(hd_classic_variant_kinds(variant)[i], kind);
            assert_int_equal(solid->kind, kind);
            expect_near(solid->lights.intensity, 0.7 / (edges[kind] * per_edge[i]), 0.0);
        }
        hd_scene_file_free(&input);
    }
}

/* Into `text`. */
static HdStatus print(char *text, size_t size) {
    memset(text, 0, size);
    FILE *stream = fmemopen(text, size, "w");
    assert_non_null(stream);
    const HdStatus status = hd_classic_print(stream, &input, &error);
    fclose(stream);
    return status;
}

static void expect_round_trip(void) {
    char text[4096];
    if (print(text, sizeof text) != HD_OK)
        fail_msg("%s", error.message);
    expect_parsed(&again, text, 4);
    expect_same_file(&input, &again);
    hd_scene_file_free(&again);
}

TEST(test_round_trip) {
    expect_parsed(&input, official, 4);
    expect_round_trip();
    /* Numbers that need all their digits. */
    input.scene.eye.cylinder =
        (HdCylinderPath){1.0 / 3.0, 0.1 + 0.2, -2.0 / 7.0, 1e-300, 123456789.123456789,
                         4.9e-324,  1e11 / 3,  -0.0,       1e-7,   -1.0};
    input.scene.solids[1].centre = hd_vec3(0.1, -1e-17, 1e11 + 0.1);
    input.scene.lights[1].intensity = hd_vec3(nextafter(1.0, 2.0), 2.0 / 3.0, 1e5);
    expect_round_trip();
    hd_scene_file_free(&input);
}

TEST(test_printed_text_is_short_and_in_lines) {
    char text[4096];
    expect_parsed(&input, official, 4);
    input.scene.eye.cylinder.z_phase = 0.1 + 0.2;
    assert_int_equal(print(text, sizeof text), HD_OK);
    assert_string_equal(text, "1024\nout/img_%d.data\n640 480 120\n"
                              "7 3 0   2 1   2 6 1   0 0.30000000000000004\n"
                              "2 0 0   0.5 0.1   1 4 1   0 0\n"
                              "2 0 0   1 0 0   1 0.9 0.1   10\n"
                              "0 2 0   0 1 0   0.75 0.8 0.2   5\n"
                              "0 0 0   0 0.7 0.7   0.5 0.7 0.3   2\n"
                              "-5 -5 -1   -5 5 -1   5 5 -1   5 -5 -1   ~/floor.data   0 1 0   0.5\n"
                              "2\n-10 0 10   1 1 1\n1 0 10   0 0 1\n10 16\n");
    hd_scene_file_free(&input);
}

static void expect_not_printed(const char *message) {
    char text[4096];
    assert_int_equal(print(text, sizeof text), HD_BAD_INPUT);
    expect_contains(error.message, message);
    assert_string_equal(text, "");
}

TEST(test_what_the_format_cannot_hold) {
    expect_parsed(&input, official, 4);
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
    hd_scene_file_free(&input);
}

TEST(test_a_full_disk) {
    FILE *full = fopen("/dev/full", "w");
    if (full == NULL)
        skip();
    expect_parsed(&input, official, 4);
    assert_int_equal(hd_classic_print(full, &input, &error), HD_FAILED);
    expect_contains(error.message, "cannot write the configuration");
    fclose(full);
    hd_scene_file_free(&input);
}
