/* SPDX-License-Identifier: MIT */
/* Scene files are read as written, and changed by --set. */
#define _XOPEN_SOURCE 700

#include <math.h>

#include "image/picture.h"
#include "input/files.h"
#include "same_scene.h"
#include "scene_text.h"
#include "test_folder.h"

#define WHITE                                                                                      \
    { 1.0, 1.0, 1.0 }
#define PLAIN .colour = WHITE, .mirror_tint = WHITE, .shininess = 64, .index_of_refraction = 1.0

static HdSceneFile file;
static HdError error;
static const HdSceneSource as_it_is;

TEST(test_every_key) {
    const HdMaterial plain = {PLAIN}, dark = {PLAIN, .diffuse = 0.125};
    const HdMaterial glass = {{0.9, 0.8, 0.7},
                              {0.6, 0.5, 0.4},
                              0.01,
                              0.02,
                              0.03,
                              65,
                              0.04,
                              0.05,
                              0.06,
                              0.07,
                              true,
                              1.5,
                              true};
    HdSolid solids[] = {
        {HD_HEXAHEDRON, {1.0, 2.0, 3.0}, 2.0, {10.0, 20.0, 30.0}, glass, 0.0, plain, {0}},
        {HD_ICOSAHEDRON,
         {100.0, 0.0, 0.0},
         1.0,
         {0.0, 0.0, 0.0},
         dark,
         0.05,
         plain,
         {3, 2, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.5}}, 0.1, {6.0, 0.0}, 0.02, 4.0}},
        {HD_TETRAHEDRON,
         {200.0, 0.0, 0.0},
         1.0,
         {0.0, 0.0, 0.0},
         plain,
         0.0,
         plain,
         {1, 1, {WHITE}, 0.0, {0.0, 7.0}, 0.0, 0.0}}};
    HdLight lights[] = {{{4.0, 5.0, 6.0}, {3.0, 1.5, 0.75}, {8.0, 0.0}},
                        {{7.0, 8.0, 9.0}, WHITE, {0.0, 10.0}}};
    HdMeshEntry meshes[] = {
        {(char[]){"model.obj"},
         HD_NORMALS_SMOOTH,
         25.0,
         0.0,
         6.0,
         {.up = HD_UP_Y,
          .position = {11.0, 12.0, 13.0},
          .rotation_degrees = {40.0, 50.0, 60.0},
          .scale = {1.0, 2.0, -3.0},
          .has_material = true,
          .material = dark}},
        {(char[]){"other.obj"}, HD_NORMALS_FLAT, 40.0, 0.25, 0.0, {.scale = {0.5, 0.5, 0.5}}}};
    const HdSceneFile expected = {
        .scene = {.width = 320,
                  .height = 200,
                  .samples_per_side = 2,
                  .sampling = HD_SAMPLING_MULTIJITTER,
                  .depth = 5,
                  .cutoff = 0.01,
                  .exposure = 1.5,
                  .field_of_view_degrees = 75.0,
                  .frame_count = 24,
                  .eye.cylinder = {30.0, 1.0, 0.1, 0.2, 0.3, 2.0, 3.0, 4.0, 0.4, 0.5},
                  .target = {true, {0.5, 0.25, 0.125}, {0}},
                  .background = {0.1, 0.2, 3.0},
                  .environment = {(char[]){"sky.pfm"}, HD_CURVE_LINEAR, 2.0, 70.0, {0}, 0.0},
                  .solid_count = 3,
                  .solids = solids,
                  .light_count = 2,
                  .lights = lights,
                  .floor = {.present = true,
                            .corners = {{-5, 5, -20}, {5, 5, -20}, {5, -5, -20}, {-5, -5, -20}},
                            .material = dark}},
        .mesh_entry_count = 2,
        .mesh_entries = meshes,
        .output = {"out/%04d.png", {{HD_CURVE_LINEAR, 16, true}, 25, true}},
        .texture_path = "floor.png",
        .texture_curve = HD_CURVE_LINEAR};
    expect_scene(&file, rich_text, NULL);
    expect_same_file(&file, &expected);
    hd_scene_file_free(&file);
}

TEST(test_changes) {
    static const HdSceneChange changes[] = {"image.width=1e2",       "solids[1].circumradius=3.5",
                                            "camera.eye=[1,2,3]",    "output.curve=linear",
                                            "image.height=200",      "floor.texture.file=a=b.png",
                                            "output.path=\"7.png\"", "materials.glass.colour[1]=0",
                                            "camera.eye[2]=4",       "image.height=300",
                                            "output.bits=8.0",       "hedron=1.0",
                                            "image.aa=grid",         "solids[2].kind=dodecahedron"};
    assert_int_equal(parse_scene(&file, rich_text, strlen(rich_text), changes, 14, &error), HD_OK);
    assert_int_equal(file.scene.width, 100);
    assert_int_equal(file.scene.height, 300);
    expect_near(file.scene.solids[1].circumradius, 3.5, 0.0);
    expect_near(file.scene.eye.point.y, 2.0, 0.0);
    expect_near(file.scene.eye.point.z, 4.0, 0.0);
    assert_int_equal(file.output.style.picture.curve, HD_CURVE_LINEAR);
    assert_int_equal(file.output.style.picture.bits, 8);
    assert_int_equal(file.scene.sampling, HD_SAMPLING_GRID);
    assert_int_equal(file.scene.solids[2].kind, HD_DODECAHEDRON);
    assert_string_equal(file.texture_path, "a=b.png");
    assert_string_equal(file.output.path, "7.png");
    expect_near(file.scene.solids[0].face.colour.y, 0.0, 0.0);
    hd_scene_file_free(&file);
    expect_scene(&file, least_text, "image.width=77"); /* missing parts are made */
    assert_int_equal(file.scene.width, 77);
    assert_int_equal(file.scene.height, 480);
    hd_scene_file_free(&file);
    expect_scene(&file, rich_text,
                 "materials.glass={\"transmission\": 0.5, \"inner_reflection\": 0.125}");
    const HdMaterial *glass = &file.scene.solids[0].face; /* one of the inner shares alone */
    assert_true(glass->has_inner_side && glass->inner_reflection == 0.125);
    expect_near(glass->inner_transmission, 0.5, 0.0);
    hd_scene_file_free(&file);
}

/* Besides errors that the reader of all files refuses. */
TEST(test_scenes_of_no_byte_and_of_too_many) {
    write_bytes("empty.json", "", 0);
    write_bytes("huge.json", "{", 1);
    assert_int_equal(truncate("huge.json", (off_t)HD_MAX_SCENE_BYTES + 1), 0);
    assert_int_equal(hd_scene_file_read(&file, "empty.json", &as_it_is, &error), HD_BAD_INPUT);
    expect_contains(error.message, "empty.json is empty");
    assert_int_equal(hd_scene_file_read(&file, "huge.json", &as_it_is, &error), HD_BAD_INPUT);
    expect_contains(error.message, "it has 33554433 bytes, expected at most 33554432");
}

/* Expects `said` as the place of both the texture and the mesh. */
static HdStatus read_with_files(const char *path, const char *said) {
    static char changes[2][HD_MAX_PATH + 64];
    const char *const both[] = {changes[0], changes[1]};
    const HdSceneSource source = {.changes = both, .change_count = 2};
    snprintf(changes[0], sizeof changes[0], "floor.texture.file=%s", said);
    snprintf(changes[1], sizeof changes[1], "meshes[0].file=%s", said);
    return hd_scene_file_read(&file, path, &source, &error);
}

TEST(test_files_count_from_the_folder) {
    static const char *const cases[][3] = {
        {"a.json", "b.c", "b.c"},
        {"folder/a.json", "b.c", "folder/b.c"},
        {"./folder//a.json", "b.c", "./folder//b.c"},
        {"folder/a.json", "/b.c", "/b.c"},
        {"folder/a.json", "~", "~"},
        {"folder/a.json", "~b/c.d", "folder/~b/c.d"},
    };
    static char name[HD_MAX_PATH];
    assert_int_equal(mkdir("folder", 0700), 0);
    write_bytes("a.json", rich_text, strlen(rich_text));
    write_bytes("folder/a.json", rich_text, strlen(rich_text));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (read_with_files(cases[i][0], cases[i][1]) != HD_OK)
            fail_msg("%s", error.message);
        assert_string_equal(file.texture_path, cases[i][2]);
        assert_string_equal(file.mesh_entries[0].file, cases[i][2]);
        hd_scene_file_free(&file);
    }
    assert_int_equal(read_with_files("folder/a.json", HD_BUILTIN_TEXTURE), HD_OK);
    assert_string_equal(file.texture_path, HD_BUILTIN_TEXTURE);
    hd_scene_file_free(&file);
    memset(name, 'x', HD_MAX_PATH - 1);
    assert_int_equal(read_with_files("a.json", name), HD_OK);
    hd_scene_file_free(&file);
    assert_int_equal(read_with_files("folder/a.json", name), HD_BAD_INPUT);
    expect_contains(error.message, "floor.texture.file has 4102 bytes with the scene's folder");
    expect_contains(error.message, "meshes[0].file has 4102 bytes with the scene's folder");
}

static HdStatus load_texture(const char *text, const char *change) {
    expect_scene(&file, text, change);
    return hd_scene_file_load_texture(&file, NULL, &error);
}

/* Light above HD_MAX_PANORAMA_LIGHT is clamped; what is no number, or negative, is black. */
TEST(test_environments_keep_bright_light) {
    static const struct {
        float light[6];
        double top;
        uint16_t texels[6];
        const char *notes;
    } cases[] = {
        {{0.5F, 0.0F, 4.0F, 1.0F, -1.0F, 2.0F}, 4.0, {8192, 0, 65535, 16384, 0, 32768}, ""},
        {{1e5F, 8.0F, NAN, 16.0F, 0.0F, 0.0F},
         16.0,
         {65535, 32768, 0, 65535, 0, 0},
         "sky.pfm has infinite or NaN values (1): infinite ones count as 16, NaN as 0\n"
         "sky.pfm: light up to 1e+05 is clamped to 16\n"},
        {{0.0F}, 1.0, {0}, ""}};
    const HdEnvironment *environment = &file.scene.environment;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        HdFrame frame = {.width = 2, .height = 1, .floats = 3, .rgb = (float *)cases[i].light};
        const HdPictureStyle style = {.bits = 32};
        expect_scene(&file, rich_text, NULL);
        assert_int_equal(hd_picture_write(&frame, &style, "sky.pfm", &error), HD_OK);
        HdProblems notes = {.count = 0};
        assert_int_equal(hd_scene_file_load_environment(&file, &notes, &error), HD_OK);
        assert_string_equal(notes.text, cases[i].notes);
        expect_near(environment->top, cases[i].top, 0.0);
        assert_memory_equal(environment->texture.texels, cases[i].texels, sizeof cases[i].texels);
        hd_scene_file_free(&file);
    }
    expect_scene(&file, rich_text, "environment.file=missing.exr");
    assert_int_equal(hd_scene_file_load_environment(&file, NULL, &error), HD_BAD_INPUT);
    expect_contains(error.message, "missing.exr");
    hd_scene_file_free(&file);
}

/* Middle grey on the curve is darker in linear light. */
TEST(test_textures_are_loaded) {
    static const unsigned char grey[12] = {1, 0, 0, 0, 1, 0, 0, 0, 128, 128, 128, 255};
    const HdTexture *texture = &file.scene.floor.texture;
    write_bytes("grey.data", grey, sizeof grey);
    assert_int_equal(load_texture(rich_text, "floor.texture={\"file\": \"grey.data\"}"), HD_OK);
    assert_in_range(texture->texels[0], 14100, 14200);
    hd_scene_file_free(&file);
    assert_int_equal(load_texture(rich_text, "floor.texture.file=grey.data"), HD_OK);
    assert_int_equal(texture->texels[0], 128 * 257);
    hd_scene_file_free(&file);
    assert_int_equal(load_texture(least_text, NULL), HD_OK);
    assert_int_equal(texture->width, 0);
    hd_scene_file_free(&file);
    assert_int_equal(load_texture(rich_text, "floor.texture.file=missing.png"), HD_BAD_INPUT);
    expect_contains(error.message, "missing.png");
    hd_scene_file_free(&file);
}
