/* SPDX-License-Identifier: MIT */
#include "classic_text.h"

static void expect_vector(HdVec3 actual, double x, double y, double z) {
    expect_near(actual.x, x, 0.0);
    expect_near(actual.y, y, 0.0);
    expect_near(actual.z, z, 0.0);
}

static void expect_path(const HdCylinderPath *actual, const double expected[10]) {
    const double values[10] = {
        actual->r0,          actual->z0,          actual->phi0,        actual->r_amplitude,
        actual->z_amplitude, actual->r_frequency, actual->z_frequency, actual->phi_frequency,
        actual->r_phase,     actual->z_phase};
    for (int i = 0; i < 10; i++)
        expect_near(values[i], expected[i], 0.0);
}

TEST(test_official_camera_and_picture) {
    static HdSceneFile input;
    const double eye[10] = {7.0, 3.0, 0.0, 2.0, 1.0, 2.0, 6.0, 1.0, 0.0, 0.0};
    const double target[10] = {2.0, 0.0, 0.0, 0.5, 0.1, 1.0, 4.0, 1.0, 0.0, 0.0};
    expect_parsed(&input, official, 4);
    const HdScene *scene = &input.scene;
    assert_int_equal(scene->frame_count, 1024);
    assert_string_equal(input.output.path, "out/img_%d.data");
    assert_int_equal(scene->width, 640);
    assert_int_equal(scene->height, 480);
    expect_near(scene->field_of_view_degrees, 120.0, 0.0);
    expect_path(&scene->eye.cylinder, eye);
    expect_path(&scene->target.cylinder, target);
    assert_int_equal(scene->depth, 10);
    assert_int_equal(scene->samples_per_side, 16);
    expect_near(scene->exposure, 1.0, 0.0);
    expect_near(scene->cutoff, 0.0, 0.0);
    expect_vector(scene->background, 0.0, 0.0, 0.0);
    hd_scene_file_free(&input);
    expect_empty(&input);
}

TEST(test_official_solids) {
    static HdSceneFile input;
    expect_parsed(&input, official, 4);
    assert_int_equal(input.scene.solid_count, 3);
    const HdSolid *solids = input.scene.solids;
    assert_int_equal(solids[0].kind, HD_TETRAHEDRON);
    expect_vector(solids[0].centre, 2.0, 0.0, 0.0);
    expect_vector(solids[0].face.colour, 1.0, 0.0, 0.0);
    expect_near(solids[0].circumradius, 1.0, 0.0);
    expect_near(solids[0].face.reflection, 0.9, 0.0);
    expect_near(solids[0].face.transmission, 0.1, 0.0);
    assert_int_equal(solids[0].lights.per_edge, 10);
    assert_int_equal(solids[1].kind, HD_OCTAHEDRON);
    expect_vector(solids[1].centre, 0.0, 2.0, 0.0);
    expect_vector(solids[1].face.colour, 0.0, 1.0, 0.0);
    expect_near(solids[1].circumradius, 0.75, 0.0);
    expect_near(solids[1].face.reflection, 0.8, 0.0);
    expect_near(solids[1].face.transmission, 0.2, 0.0);
    assert_int_equal(solids[1].lights.per_edge, 5);
    assert_int_equal(solids[2].kind, HD_DODECAHEDRON);
    expect_vector(solids[2].centre, 0.0, 0.0, 0.0);
    expect_vector(solids[2].face.colour, 0.0, 0.7, 0.7);
    expect_near(solids[2].circumradius, 0.5, 0.0);
    expect_near(solids[2].face.reflection, 0.7, 0.0);
    expect_near(solids[2].face.transmission, 0.3, 0.0);
    assert_int_equal(solids[2].lights.per_edge, 2);
    hd_scene_file_free(&input);
}

TEST(test_official_floor_and_lights) {
    static HdSceneFile input;
    expect_parsed(&input, official, 4);
    const HdFloor *floor = &input.scene.floor;
    assert_true(floor->present);
    expect_vector(floor->corners[0], -5.0, -5.0, -1.0);
    expect_vector(floor->corners[1], -5.0, 5.0, -1.0);
    expect_vector(floor->corners[2], 5.0, 5.0, -1.0);
    expect_vector(floor->corners[3], 5.0, -5.0, -1.0);
    assert_string_equal(input.texture_path, "~/floor.data");
    assert_int_equal(floor->texture.width, 0);
    assert_null(floor->texture.texels);
    expect_vector(floor->material.colour, 0.0, 1.0, 0.0);
    expect_near(floor->material.reflection, 0.5, 0.0);
    assert_int_equal(input.scene.light_count, 2);
    expect_vector(input.scene.lights[0].position, -10.0, 0.0, 10.0);
    expect_vector(input.scene.lights[0].intensity, 1.0, 1.0, 1.0);
    expect_vector(input.scene.lights[1].position, 1.0, 0.0, 10.0);
    expect_vector(input.scene.lights[1].intensity, 0.0, 0.0, 1.0);
    expect_near(input.scene.lights[1].falloff.distance, 0.0, 0.0);
    hd_scene_file_free(&input);
}

TEST(test_what_the_input_lacks) {
    static HdSceneFile input;
    expect_parsed(&input, official, 4);
    for (int i = 0; i < 3; i++) {
        const HdSolid *solid = &input.scene.solids[i];
        const double r = solid->circumradius;
        expect_near(solid->face.ambient, 0.0, 0.0);
        expect_near(solid->face.diffuse, 0.5, 0.0);
        expect_near(solid->face.specular, solid->face.transmission, 0.0);
        assert_int_equal(solid->face.shininess, 64);
        expect_vector(solid->face.mirror_tint, 1.0, 1.0, 1.0);
        expect_near(solid->rim_width, 0.04 * r, 0.0);
        expect_vector(solid->rim.colour, 0.03, 0.03, 0.03);
        expect_vector(solid->rim.mirror_tint, 1.0, 1.0, 1.0);
        expect_near(solid->rim.ambient, 0.0, 0.0);
        expect_near(solid->rim.diffuse, 0.5, 0.0);
        expect_near(solid->rim.specular, 0.2, 0.0);
        assert_int_equal(solid->rim.shininess, 64);
        expect_near(solid->rim.reflection, 0.0, 0.0);
        expect_near(solid->rim.transmission, 0.0, 0.0);
        /* Each of the three has 60 lights. */
        expect_near(solid->lights.intensity, 0.7 / 60, 0.0);
        assert_int_equal(solid->lights.colour_count, 1);
        expect_vector(solid->lights.colours[0], 1.0, 1.0, 1.0);
        expect_near(solid->lights.falloff.distance, r, 0.0);
        expect_near(solid->lights.disc_radius, 0.02 * r, 0.0);
        expect_near(solid->lights.disc_radiance, 4.0, 0.0);
    }
    const HdMaterial *floor = &input.scene.floor.material;
    expect_near(floor->diffuse, 0.5, 0.0);
    expect_near(floor->specular, 0.5, 0.0);
    expect_near(floor->ambient, 0.0, 0.0);
    expect_near(floor->transmission, 0.0, 0.0);
    assert_int_equal(floor->shininess, 64);
    expect_vector(floor->mirror_tint, 1.0, 1.0, 1.0);
    hd_scene_file_free(&input);
}

TEST(test_no_light_and_no_edge_light) {
    static HdSceneFile input;
    expect_token_accepted(&input, SOLID_1 + 9, "0");
    expect_near(input.scene.solids[0].lights.intensity, 0.0, 0.0);
    hd_scene_file_free(&input);

    const Tokens tokens = official_tokens();
    char text[sizeof official + 16];
    snprintf(text, sizeof text, "%.*s0 3 2", (int)tokens.start[LIGHT_COUNT], official);
    expect_parsed(&input, text, 4);
    assert_int_equal(input.scene.light_count, 0);
    assert_int_equal(input.scene.depth, 3);
    assert_int_equal(input.scene.samples_per_side, 2);
    hd_scene_file_free(&input);
}

TEST(test_any_white_space_separates) {
    static HdSceneFile input;
    static const char spaces[] = " \t\n\v\f\r";
    char text[sizeof official];
    memcpy(text, official, sizeof text);
    for (size_t i = 0, next = 0; text[i] != '\0'; i++)
        if (isspace((unsigned char)text[i]))
            text[i] = spaces[next++ % (sizeof spaces - 1)];
    expect_parsed(&input, text, 4);
    assert_int_equal(input.scene.samples_per_side, 16);
    hd_scene_file_free(&input);
}

TEST(test_what_is_a_number) {
    static const struct {
        const char *text;
        double value;
    } cases[] = {{"90", 90.0},       {"+90.", 90.0},  {"9E1", 90.0},     {".9e+2", 90.0},
                 {"900.0e-1", 90.0}, {"00090", 90.0}, {"1e-320", 1e-320}};
    static HdSceneFile input;
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
        static HdSceneFile input;
        const HdSolidKind *kinds = hd_classic_variant_kinds(variant);
        expect_parsed(&input, official, variant);
        for (int i = 0; i < 3; i++) {
            const int kind = (int)(strchr(letters, names[variant - 1][i]) - letters);
            const HdSolid *solid = &input.scene.solids[i];
            assert_int_equal(kinds[i], kind);
            assert_int_equal(solid->kind, kind);
            expect_near(solid->lights.intensity, 0.7 / (edges[kind] * per_edge[i]), 0.0);
        }
        hd_scene_file_free(&input);
    }
}

/* The text that hd_classic_print writes; the caller frees it. */
static char *printed(const HdSceneFile *input) {
    static HdError error;
    FILE *file = tmpfile();
    assert_non_null(file);
    if (hd_classic_print(file, input, &error) != HD_OK)
        fail_msg("%s", error.message);
    const long size = ftell(file);
    assert_true(size > 0);
    char *text = calloc(1, (size_t)size + 1);
    assert_non_null(text);
    rewind(file);
    assert_int_equal(fread(text, 1, (size_t)size, file), size);
    fclose(file);
    return text;
}

static void expect_same_solid(const HdSolid *a, const HdSolid *b) {
    assert_int_equal(a->kind, b->kind);
    assert_memory_equal(&a->centre, &b->centre, sizeof a->centre);
    assert_memory_equal(&a->face.colour, &b->face.colour, sizeof a->face.colour);
    expect_near(a->circumradius, b->circumradius, 0.0);
    expect_near(a->face.reflection, b->face.reflection, 0.0);
    expect_near(a->face.transmission, b->face.transmission, 0.0);
    assert_int_equal(a->lights.per_edge, b->lights.per_edge);
}

static void expect_same(const HdSceneFile *a, const HdSceneFile *b) {
    assert_string_equal(a->output.path, b->output.path);
    assert_string_equal(a->texture_path, b->texture_path);
    assert_int_equal(a->scene.frame_count, b->scene.frame_count);
    assert_int_equal(a->scene.width, b->scene.width);
    assert_int_equal(a->scene.height, b->scene.height);
    expect_near(a->scene.field_of_view_degrees, b->scene.field_of_view_degrees, 0.0);
    assert_memory_equal(&a->scene.eye.cylinder, &b->scene.eye.cylinder,
                        sizeof a->scene.eye.cylinder);
    assert_memory_equal(&a->scene.target.cylinder, &b->scene.target.cylinder,
                        sizeof a->scene.target.cylinder);
    for (int i = 0; i < 3; i++)
        expect_same_solid(&a->scene.solids[i], &b->scene.solids[i]);
    assert_memory_equal(a->scene.floor.corners, b->scene.floor.corners,
                        sizeof a->scene.floor.corners);
    assert_memory_equal(&a->scene.floor.material.colour, &b->scene.floor.material.colour,
                        sizeof a->scene.floor.material.colour);
    expect_near(a->scene.floor.material.reflection, b->scene.floor.material.reflection, 0.0);
    assert_int_equal(a->scene.light_count, b->scene.light_count);
    for (int i = 0; i < a->scene.light_count; i++)
        assert_memory_equal(&a->scene.lights[i], &b->scene.lights[i], sizeof(HdLight));
    assert_int_equal(a->scene.depth, b->scene.depth);
    assert_int_equal(a->scene.samples_per_side, b->scene.samples_per_side);
}

static void expect_round_trip(const HdSceneFile *input) {
    static HdSceneFile again;
    char *text = printed(input);
    expect_parsed(&again, text, 4);
    expect_same(input, &again);
    hd_scene_file_free(&again);
    free(text);
}

TEST(test_round_trip) {
    static HdSceneFile input;
    expect_parsed(&input, official, 4);
    expect_round_trip(&input);
    /* Numbers that need all their digits. */
    input.scene.eye.cylinder =
        (HdCylinderPath){1.0 / 3.0, 0.1 + 0.2, -2.0 / 7.0, 1e-300, 123456789.123456789,
                         4.9e-324,  1e11 / 3,  -0.0,       1e-7,   -1.0};
    input.scene.solids[1].centre = hd_vec3(0.1, -1e-17, 1e11 + 0.1);
    input.scene.lights[1].intensity = hd_vec3(nextafter(1.0, 2.0), 2.0 / 3.0, 1e5);
    expect_round_trip(&input);
    hd_scene_file_free(&input);
}

TEST(test_printed_text_is_short_and_in_lines) {
    static HdSceneFile input;
    expect_parsed(&input, official, 4);
    input.scene.eye.cylinder.z_phase = 0.1 + 0.2;
    char *text = printed(&input);
    expect_contains(text, "1024\nout/img_%d.data\n640 480 120\n");
    expect_contains(text, "7 3 0   2 1   2 6 1   0 0.30000000000000004\n");
    expect_contains(text, "2 0 0   1 0 0   1 0.9 0.1   10\n");
    expect_contains(text, "   ~/floor.data   0 1 0   0.5\n2\n-10 0 10   1 1 1\n");
    expect_contains(text, "\n10 16\n");
    free(text);
    hd_scene_file_free(&input);
}

static void expect_not_printed(const HdSceneFile *input, const char *message) {
    static HdError error;
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_int_equal(hd_classic_print(file, input, &error), HD_BAD_INPUT);
    expect_contains(error.message, message);
    assert_int_equal(ftell(file), 0);
    fclose(file);
}

TEST(test_what_the_format_cannot_hold) {
    static HdSceneFile input;
    expect_parsed(&input, official, 4);
    input.scene.solid_count = 2;
    expect_not_printed(&input, "the scene has 2 solids, expected 3");
    input.scene.solid_count = 3;
    input.scene.floor.present = false;
    expect_not_printed(&input, "the scene has no floor");
    input.scene.floor.present = true;
    input.scene.light_count = 5;
    expect_not_printed(&input, "the scene has 5 lights, expected at most 4");
    input.scene.light_count = 2;
    strcpy(input.texture_path, "my floor.png");
    expect_not_printed(&input, "texture path is 'my floor.png'");
    input.texture_path[0] = '\0';
    expect_not_printed(&input, "texture path is ''");
    strcpy(input.output.path, "a\tb%d");
    expect_not_printed(&input, "output path is ");
    hd_scene_file_free(&input);
}

TEST(test_a_full_disk) {
    static HdError error;
    static HdSceneFile input;
    FILE *full = fopen("/dev/full", "w");
    if (full == NULL)
        skip();
    expect_parsed(&input, official, 4);
    assert_int_equal(hd_classic_print(full, &input, &error), HD_FAILED);
    expect_contains(error.message, "cannot write the configuration");
    fclose(full);
    hd_scene_file_free(&input);
}
