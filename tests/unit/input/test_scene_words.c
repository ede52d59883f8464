/* SPDX-License-Identifier: MIT */
/* What messages about scene files say to people who are used to other words. */
#include "input/classic.h"
#include "scene_text.h"

static HdSceneFile file;

TEST(test_output_paths) {
    static const char *const wrong[] = {"film.avi", "x.jpg", "none", "film.mp4.old", ".png/x"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        char change[64], message[256];
        snprintf(change, sizeof change, "output.path=%s", wrong[i]);
        snprintf(message, sizeof message,
                 "a.json: --set %s: output.path is \"%s\", expected the name of a film (.mp4, .mkv "
                 "or .gif) or of a picture (.png, .exr, .pfm or .data)",
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

TEST(test_numbers_by_value) {
    expect_scene(&file, rich_text, "output.bits=16.0");
    assert_int_equal(file.output.style.picture.bits, 16);
    hd_scene_file_free(&file);
    expect_scene(&file, rich_text, "hedron=1.0");
    hd_scene_file_free(&file);
    expect_refused(rich_text, "output.bits=16.5", "output.bits is 16.5, expected 8, 16 or 32");
    expect_refused(rich_text, "solids[0].kind=\"cub\"", "solids[0].kind is a string, \"cub\"");
    expect_refused(rich_text, "image.width=12345678901234567890",
                   "image.width is 1.2345678901234567e19, expected an integer from 1 to 65535");
    expect_refused(rich_text, "image.width=1e999",
                   "--set image.width=1e999: the value is too large, expected a number that a "
                   "double can hold");
}

TEST(test_control_characters) {
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

TEST(test_synonyms_of_keys) {
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

TEST(test_synonyms_of_kinds) {
    expect_refused(rich_text, "solids[0].kind=hexahedron",
                   "solids[0].kind is a string, \"hexahedron\"; did you mean \"cube\"?");
    expect_refused(rich_text, "solids[0].kind=Cube", "\"Cube\"; did you mean \"cube\"?");
    expect_refused(rich_text, "solids[0].kind=icosaedron", "; did you mean \"icosahedron\"?");
    expect_refused(rich_text, "output.curve=sRGB", "\"sRGB\"; did you mean \"srgb\"?");
    expect_refused(rich_text, "solids[0].kind=ball", "\"ball\", expected \"tetrahedron\", ");
}

TEST(test_paths_of_changes) {
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

TEST(test_hints_for_json) {
    expect_refused("{\"hedron\": 1,\n }", NULL, "; JSON has no comma before '}'");
    expect_refused("{\"solids\": [1, ]}", NULL, "; JSON has no comma before ']'");
    expect_refused("{\"hedron\": 1 // one\n}", NULL, "a.json:1:14: ");
    expect_refused("{\"hedron\": 1 // one\n}", NULL, "; JSON has no comments");
    expect_refused("# a scene\n{}", NULL, "; JSON has no comments");
    expect_refused("{'hedron': 1}", NULL, "; use double quotes");
    const char *const numbers[] = {"NaN", "Infinity", "-Infinity", "+1", ".5", "1.", "0x10", "inf"};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        char text[64];
        snprintf(text, sizeof text, "{\"hedron\": %s}", numbers[i]);
        expect_refused(text, NULL,
                       "; a number in JSON looks like 0.5, -2 or 1e3, and none is NaN or infinite");
    }
    expect_refused("{\"hedron\": True}", NULL, "; JSON says true, false or null");
    assert_null(strchr(expect_refused("{\"hedron\": nana}", NULL, "near 'nana'"), ';'));
    assert_null(strchr(expect_refused("{\"hedron\": }", NULL, "a.json:1:12: "), ';'));
    char marked[sizeof least_text + 3];
    snprintf(marked, sizeof marked, "\xef\xbb\xbf%s", least_text);
    expect_scene(&file, marked, NULL);
    hd_scene_file_free(&file);
    assert_string_equal(expect_refused(" 10\nout/%d.data 640 480", NULL, ""),
                        "a.json: this looks like a classic input, which 'hedron convert FILE -o "
                        "scene.json' makes a scene of");
}

TEST(test_scene_as_classic_input) {
    static HdError error;
    static HdSceneFile input;
    static const char text[] = "\xef\xbb\xbf \n{\"hedron\": 1}";
    assert_int_equal(hd_classic_parse(&input, text, strlen(text), "a.in", 4, &error), HD_BAD_INPUT);
    assert_string_equal(error.message, "a.in: this looks like a scene file, which 'hedron render "
                                       "FILE' renders");
}

TEST(test_textures) {
    static HdError error;
    static const HdSceneChange changes[] = {"floor.texture.file=no such.png", "image.width=0"};
    const HdSceneSource source = {
        .name = "a.json", .folder = "", .changes = changes, .change_count = 2, .loads_files = true};
    assert_int_equal(hd_scene_file_parse(&file, rich_text, strlen(rich_text), &source, &error),
                     HD_BAD_INPUT);
    expect_contains(error.message, "a.json: 4 problems\n");
    expect_contains(error.message, "\n  --set image.width=0: image.width is 0, expected");
    expect_contains(error.message,
                    "\n  floor.texture.file: cannot read the texture no such.png: No such file");
    expect_refused(rich_text, "floor.texture.file=builtin:wood",
                   "floor.texture.file is \"builtin:wood\", which is unknown, expected "
                   "\"builtin:floor\" or a file");
}

TEST(test_too_many_edge_lights) {
    assert_string_equal(
        expect_refused(rich_text, "solids[1].edge_lights.per_edge=3334", ""),
        "a.json: solids[1]: edge_lights.per_edge is 3334, which makes 100020 lights "
        "on its 30 edges, expected at most 100000 lights in the scene");
    assert_string_equal(
        expect_refused(rich_text, "solids[2].edge_lights.per_edge=16666", ""),
        "a.json: number of lights, those on the edges included, is 100088, expected "
        "at most 100000");
}

/* The notes on a scene that is fine, a line for each. */
static const char *notes_on(const char *text, HdSceneChange change) {
    static HdError error;
    static HdProblems notes;
    notes = (HdProblems){.count = 0};
    const HdSceneSource source = {.name = "a.json",
                                  .folder = "",
                                  .changes = &change,
                                  .change_count = change != NULL,
                                  .notes = &notes};
    if (hd_scene_file_parse(&file, text, strlen(text), &source, &error) != HD_OK)
        fail_msg("%s", error.message);
    hd_scene_file_free(&file);
    return notes.text;
}

static const char quiet_text[] =
    "{\"hedron\": 1, \"camera\": {\"eye\": [9, 0, 1]}, \"materials\": {\"m\": {}},\n"
    " \"solids\": [{\"kind\": \"cube\", \"circumradius\": 1.7320508075688772, \"material\": "
    "\"m\",\n"
    "   \"edge_lights\": {\"per_edge\": 4, \"disc_radius\": 0.24, \"disc_radiance\": 1}}],\n"
    " \"floor\": {\"corners\": [[-5, 5, -1.25], [5, 5, -1.25], [5, -5, -1.25], [-5, -5, "
    "-1.25]],\n"
    "   \"material\": \"m\"}}";

TEST(test_notes_on_contacts) {
    assert_string_equal(notes_on(quiet_text, "solids[0].centre=[0, 0, -0.25]"),
                        "solids[0] touches the floor: it is drawn smaller by a millionth or so, "
                        "lest rounding decide which is in front\n");
    assert_string_equal(notes_on(quiet_text, "solids[0].centre=[0, 0, -1]"),
                        "solids[0] overlaps the floor: each has all of its faces there\n");
    assert_string_equal(notes_on(quiet_text, "lights=[{\"position\": [0.5, 1, 0]}]"),
                        "solids[0] touches lights[0]: it is drawn smaller by a millionth or so, "
                        "lest rounding decide which is in front\n");
}

TEST(test_notes) {
    static const char black[] = "every picture is black: there is no light, no ambient material, "
                                "no disc of an edge light, and the background is black\n";
    assert_string_equal(notes_on(quiet_text, NULL), "");
    assert_string_equal(notes_on(least_text, NULL), black);
    assert_string_equal(notes_on(least_text, "background=[0,0,0.1]"), "");
    assert_string_equal(notes_on(least_text, "lights=[{\"position\": [1,2,3]}]"), "");
    assert_string_equal(notes_on(least_text, "lights=[{\"position\": [1,2,3], \"intensity\": 0}]"),
                        black);
    assert_string_equal(notes_on(quiet_text, "materials.my n={}"),
                        "materials[\"my n\"] is used nowhere\n");
    assert_string_equal(notes_on(quiet_text, "camera.field_of_view=1.2"),
                        "camera.field_of_view is 1.2, which are degrees, not radians\n");
    assert_string_equal(notes_on(quiet_text, "camera.field_of_view=5"), "");
    assert_string_equal(notes_on(quiet_text, "camera.eye=[9,0,-1.5]"),
                        "camera.eye is below the floor in frame 0\n");
    assert_string_equal(notes_on(quiet_text, "solids[0].edge_lights.disc_radius=0.26"),
                        "solids[0].edge_lights overlap: their discs are 0.52 wide, and from light "
                        "to light it is 0.5\n");
    assert_string_equal(notes_on(quiet_text, "solids[0].edge_lights.intensity=1"), "");
    expect_contains(notes_on(quiet_text, "solids[0].edge_lights.disc_radiance=0"), black);
    expect_contains(notes_on(quiet_text, "solids[0].edge_lights.disc_radiance=0"),
                    "solids[0].edge_lights neither light nor show: they lack an intensity, and a "
                    "disc_radius with a disc_radiance\n");
    assert_string_equal(notes_on(quiet_text, "solids[0].edge_lights.per_edge=0"), black);
    assert_null(strstr(notes_on(quiet_text, "materials.m.ambient=1"), "black"));
}
