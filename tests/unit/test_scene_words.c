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

static void expect_meant(const char *object, const char *word, const char *meant) {
    char path[64], change[80], message[256];
    snprintf(path, sizeof path, "%s%s%s", object, object[0] != '\0' ? "." : "", word);
    snprintf(change, sizeof change, "%s=1", path);
    snprintf(message, sizeof message,
             "a.json: --set %s: %s is an unknown key; did you mean \"%s\"?", change, path, meant);
    assert_string_equal(expect_refused(rich_text, change, ""), message);
}

static void test_synonyms_of_keys(void **state) {
    (void)state;
    static const char *const words[][3] = {
        {"camera", "fov", "field_of_view"},
        {"camera", "position", "eye"},
        {"solids[0]", "position", "centre"},
        {"solids[0]", "center", "centre"},
        {"solids[0]", "radius", "circumradius"},
        {"solids[1].edge_lights", "count", "per_edge"},
        {"solids[1].edge_lights", "lights", "per_edge"},
        {"solids[1].edge_lights", "radius", "disc_radius"},
        {"materials.glass", "color", "colour"},
        {"materials.glass", "Color", "colour"},
        {"materials.glass", "ior", "index_of_refraction"},
        {"materials.glass", "transparency", "transmission"},
        {"materials.glass", "opacity", "transmission"},
        {"materials.glass", "emission", "ambient"},
        {"materials.glass", "Diffuse", "diffuse"},
        {"lights[0]", "color", "colour"},
        {"output", "fps", "frames_per_second"},
        {"output", "gamma", "curve"},
        {"floor.texture", "gamma", "curve"},
        {"image", "widht", "width"},
        {"", "field_of_view", "camera.field_of_view"},
        {"", "fov", "camera.field_of_view"},
        {"", "width", "image.width"},
    };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        expect_meant(words[i][0], words[i][1], words[i][2]);
    expect_refused(rich_text, "lights[0].radius=1",
                   "lights[0].radius is an unknown key, expected \"position\", ");
}

static void test_synonyms_of_kinds(void **state) {
    (void)state;
    expect_refused(rich_text, "solids[0].kind=hexahedron",
                   "solids[0].kind is a string, \"hexahedron\"; did you mean \"cube\"?");
    expect_refused(rich_text, "solids[0].kind=Cube", "\"Cube\"; did you mean \"cube\"?");
    expect_refused(rich_text, "solids[0].kind=icosaedron", "; did you mean \"icosahedron\"?");
    expect_refused(rich_text, "output.curve=sRGB", "\"sRGB\"; did you mean \"srgb\"?");
    expect_refused(rich_text, "solids[0].kind=ball", "\"ball\", expected \"tetrahedron\", ");
}

static void test_paths_of_changes(void **state) {
    (void)state;
    static const char dotted[] = "{\"hedron\": 1, \"camera\": {\"eye\": [9, 0, 0]},\n"
                                 " \"materials\": {\"my.glass\": {}, \"a[0]=b\": {}}}";
    expect_refused(rich_text, "solids.0.centre=[1,2,3]",
                   "solids is an array of 3 elements; write solids[0]");
    expect_refused(rich_text, "solids[1].edge_lights.colours.1=[1,2,3]",
                   "write solids[1].edge_lights.colours[1]");
    expect_refused(
        rich_text, "materials.glas.diffuse=1",
        "a.json: --set materials.glas.diffuse=1: materials.glas is missing; did you mean "
        "\"glass\"?");
    expect_refused(dotted, "materials.\"my.glass\".diffuse=-1",
                   "diffuse=-1: materials[\"my.glass\"].diffuse is -1, expected");
    expect_refused(dotted, "materials.\"a[0]=b\".diffuse=-1",
                   "materials[\"a[0]=b\"].diffuse is -1");
    expect_refused(dotted, "materials.\"my.glass.diffuse=1", "the path is not understood");
    expect_refused(dotted, "materials.\"\".diffuse=1", "the path is not understood");
    expect_scene(&file, dotted, "materials.\"my.glass\".diffuse=0.5");
    hd_scene_file_free(&file);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_output_paths),       cmocka_unit_test(test_numbers_by_value),
        cmocka_unit_test(test_control_characters), cmocka_unit_test(test_synonyms_of_keys),
        cmocka_unit_test(test_synonyms_of_kinds),  cmocka_unit_test(test_paths_of_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
