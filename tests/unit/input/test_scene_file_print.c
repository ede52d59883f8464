/* SPDX-License-Identifier: MIT */
/* Printed scenes read back equal, and the schema is the committed one. */
#define _XOPEN_SOURCE 700

#include "input/write.h"
#include "same_scene.h"
#include "scene_text.h"

#define SCHEMA "scenes/schema/hedron-scene.schema.json"

static HdSceneFile first, second;
static HdError error;

typedef HdStatus Print(FILE *out, HdError *error);

static HdStatus print_first(FILE *out, HdError *failure) {
    return hd_scene_file_print(out, &first, failure);
}

/* Prints a scene; the caller frees the text. */
static char *printed(Print *print) {
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    if (print(out, &error) != HD_OK)
        fail_msg("%s", error.message);
    assert_int_equal(fclose(out), 0);
    return text;
}

/* Prints `first`, reads that into `second`, compares the two and frees them. The caller frees the
   text. */
static char *expect_round_trip(void) {
    char *text = printed(print_first);
    expect_scene(&second, text, NULL);
    expect_same_file(&first, &second);
    hd_scene_file_free(&first);
    hd_scene_file_free(&second);
    return text;
}

TEST(test_values_that_are_hard_to_print) {
    static const char *const changes[] = {
        "image.width=320", /* unchanged */
        "camera.eye.r0=-0.0",
        "camera.eye.z0=0.1",
        "camera.eye.r_phase=5e-324",
        "camera.eye.z_phase=123456789.12345679",
        "camera.eye={}",
        "background=[-0.0, 0, 1e-300]",
        "materials.plain={\"diffuse\": 0.125, \"inner_reflection\": 0.5}",
        "output.path=\"a\\\"b\\\\c \\u00e9.png\"",
        "materials.glass.inner_reflection=0",
        "materials.glass={\"transmission\": 0.5, \"inner_reflection\": 0}",
        "materials.dark.diffuse=-0.0",
        "lights[0].colour=[0,0,0]",
        "lights[0].colour=[-0.0,0,1]",
        "solids[1].edge_lights.colours=[[1,1,1]]",
        "solids[1].edge_lights.colours=[[1,1,1],[1,1,1]]",
        "floor.texture.curve=srgb",
        "meshes[0].scale=1",
        "meshes[0].scale=[2, 2, 3]",
        "meshes[0].scale=[3, 2, 2]",
        "meshes[0].normals=file",
        "meshes[0].position=[0, -0.0, 0]",
        "meshes[1].material=glass",
        "meshes[1].file=\"a\\\"b \\u00e9.obj\"",
    };
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        expect_scene(&first, rich_text, changes[i]);
        char *text = expect_round_trip();
        /* Equal materials have one name. */
        if (i == 0)
            expect_contains(text, "\n    \"solid_2\": {\n      \"diffuse\": 0.125\n    },\n"
                                  "    \"rim_2\": {}\n  },");
        free(text);
    }
    /* The defaults. */
    expect_scene(&first, least_text, NULL);
    char *text = expect_round_trip();
    assert_string_equal(
        text,
        "{\n  \"hedron\": 1,\n  \"image\": {\n    \"width\": 640,\n    \"height\": 480,\n"
        "    \"samples\": 3,\n    \"depth\": 8,\n    \"cutoff\": 0,\n    \"aa\": \"multijitter\",\n"
        "    \"max_error\": 0,\n    \"exposure\": 1\n  },\n"
        "  \"camera\": {\n    \"field_of_view\": 60,\n    \"frames\": 1,\n"
        "    \"eye\": [30, 0, 0],\n    \"target\": [0, 0, 0]\n  },\n"
        "  \"output\": {\n    \"frames_per_second\": 30,\n    \"curve\": \"srgb\",\n"
        "    \"bits\": 8,\n    \"alpha\": false\n  },\n  \"materials\": {}\n}\n");
    free(text);
}

static uint64_t random_bits(void) {
    static uint64_t bits = 88172645463325252u;
    bits ^= bits << 13;
    bits ^= bits >> 7;
    return bits ^= bits << 17;
}

static double random_light(void) {
    const double share = (double)(random_bits() >> 11) * 0x1p-53;
    return ldexp(share, (int)(random_bits() % 44) - 4);
}

/* The product of colour and intensity must be exact to the bit. */
TEST(test_intensities_of_lights) {
    enum { COUNT = 5000 };
    expect_scene(&first, least_text, NULL);
    first.scene.lights = calloc(COUNT, sizeof *first.scene.lights);
    assert_non_null(first.scene.lights);
    first.scene.light_count = COUNT;
    for (int i = 0; i < COUNT; i++)
        first.scene.lights[i].intensity = hd_vec3(random_light(), random_light(), random_light());
    free(expect_round_trip());
}

TEST(test_paths_that_are_not_utf8) {
    expect_scene(&first, least_text, NULL);
    strcpy(first.output.path, "\xff.png");
    assert_int_equal(hd_scene_file_print(stdout, &first, &error), HD_BAD_INPUT);
    expect_contains(error.message, "the path of the output is \"\\xff.png\", expected UTF-8");
    hd_scene_file_free(&first);
    expect_scene(&first, rich_text, NULL);
    first.mesh_entries[1].file[0] = '\xff';
    assert_int_equal(hd_scene_file_print(stdout, &first, &error), HD_BAD_INPUT);
    expect_contains(error.message, "the path of a mesh is \"\\xffther.obj\", expected UTF-8");
    hd_scene_file_free(&first);
}

TEST(test_a_stream_that_fails) {
    FILE *full = fopen("/dev/full", "w");
    if (full == NULL)
        skip();
    expect_scene(&first, rich_text, NULL);
    assert_int_equal(hd_scene_file_print(full, &first, &error), HD_FAILED);
    expect_contains(error.message, "cannot write the scene: ");
    clearerr(full);
    assert_int_equal(hd_scene_schema_print(full, &error), HD_FAILED);
    expect_contains(error.message, "cannot write the schema: ");
    fclose(full);
    hd_scene_file_free(&first);
}

/* It has every field with its range. */
TEST(test_committed_schema) {
    static char path[4096], committed[1 << 20];
    snprintf(path, sizeof path, "%s/%s", unit_project, SCHEMA);
    FILE *stream = fopen(path, "rb");
    if (stream == NULL)
        fail_msg("cannot open %s", path);
    assert_true(fread(committed, 1, sizeof committed - 1, stream) > 0);
    fclose(stream);
    char *text = printed(hd_scene_schema_print);
    if (strcmp(committed, text) != 0)
        fail_msg("%s differs from the output of hd_scene_schema_print: write it again", SCHEMA);
    free(text);
}
