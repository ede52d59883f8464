/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700
#include "run/darkness.h"

#include "scene_text.h"
#include "test_folder.h"

/* A cube on a floor, lit and in view. */
static const char cube_text[] =
    "{\"hedron\": 1, \"camera\": {\"eye\": [6, -3, 2]}, \"image\": {\"width\": 64, \"height\": 64},"
    " \"materials\": {\"m\": {\"diffuse\": 0.7}, \"none\": {}},"
    " \"solids\": [{\"kind\": \"cube\", \"material\": \"m\"}],"
    " \"lights\": [{\"position\": [4, -5, 6]}],"
    " \"floor\": {\"corners\": [[-7, 7, -2], [7, 7, -2], [7, -7, -2], [-7, -7, -2]],"
    "             \"material\": \"m\"}}";

/* A triangle, whose materials are those of its library. */
static const char mesh_text[] = "{\"hedron\": 1, \"camera\": {\"eye\": [0.2, 0.2, 2]},"
                                " \"lights\": [{\"position\": [0, 0, 3]}],"
                                " \"meshes\": [{\"file\": \"g.obj\"}]}";

/* A glass cube before white. */
static const char glass_text[] =
    "{\"hedron\": 1, \"camera\": {\"eye\": [6, -3, 2]}, \"image\": {\"width\": 64, \"height\": 64},"
    " \"background\": [1, 1, 1], \"materials\": {\"m\": {\"transmission\": 1}},"
    " \"solids\": [{\"kind\": \"cube\", \"material\": \"m\"}]}";

static HdProblems notes;

static const char *notes_on(const char *text, const char *change, int frame) {
    static HdError error;
    HdSceneFile file;
    const HdSceneSource source = {.name = "a.json",
                                  .folder = "",
                                  .loads_files = true,
                                  .changes = &change,
                                  .change_count = change != NULL};
    if (hd_scene_file_parse(&file, text, strlen(text), &source, &error) != HD_OK)
        fail_msg("%s", error.message);
    notes = (HdProblems){.count = 0};
    hd_note_darkness(&file.scene, HD_CURVE_SRGB, frame, &notes);
    hd_scene_file_free(&file);
    return notes.text;
}

#define BLACK        "all that is in view in frame 0 is black: "
#define NEARLY_BLACK "all that is in view in frame 0 is nearly black: "
#define NO_MATERIAL  "no material shows light: all lack ambient, diffuse and specular, or a colour\n"
#define NOTHING                                                                                    \
    " shows no light: its material lacks ambient, diffuse, specular, reflection and "              \
    "transmission\n"
#define NO_LIGHT "none of lights and edge_lights has an intensity and a colour\n"
#define NO_WAY                                                                                     \
    "no light reaches it: lights are behind it, behind what is opaque or the floor, or end "       \
    "before "                                                                                      \
    "it\n"
#define LOOK ": look at camera.eye, camera.target and camera.field_of_view\n"

TEST(what_is_black_has_its_reason) {
    static const struct {
        const char *change, *notes;
    } cases[] = {
        {NULL, ""},
        {"materials.m={}", BLACK NO_MATERIAL},
        {"materials.m={\"diffuse\": 1, \"colour\": [0, 0, 0]}", BLACK NO_MATERIAL},
        {"materials.m={\"ambient\": 0.1}", ""},
        {"materials.m={\"specular\": 0.5}",
         BLACK "materials have only specular, and no highlight is in view: give them diffuse\n"},
        {"materials.m={\"reflection\": 1}",
         BLACK NO_MATERIAL BLACK "mirrors and glass show background, which is black\n"},
        {"solids[0].material=\"none\"", "solids[0]" NOTHING},
        {"floor.material=\"none\"", ""},
        {"materials.none.colour=[0, 0, 0]", ""},
        {"lights=[]", BLACK "the scene has no lights\n"},
        {"lights=[{\"position\": [4, -5, 6], \"intensity\": 0}]", BLACK NO_LIGHT},
        {"lights[0].position=[0, 0, 0]", BLACK "lights[0] is inside solids[0], which is opaque\n"},
        {"lights[0].position=[0, 0, -5]", BLACK NO_WAY},
        {"lights[0].falloff_end=0.1", BLACK NO_WAY},
        {"camera={\"eye\": [0, 0, 0.1], \"target\": [0, 0, 0]}",
         BLACK "camera.eye is inside solids[0], which is opaque\n"},
        {"image.exposure=0.0001",
         NEARLY_BLACK "image.exposure is 0.0001, and with 1.52 the brightest pixel is white\n"},
        {"camera.target=[60, -30, 20]",
         "nothing is in view in frame 0, and background is black" LOOK},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(notes_on(cube_text, cases[i].change, 0), cases[i].notes);
}

/* An empty view is noted in a picture of objects, not at the begin of a film, nor where there are
   no objects. Objects are black whatever is behind them. */
TEST(a_bright_background_hides_nothing) {
    static const char away[] = "camera={\"eye\": [6, -3, 2], \"target\": [60, -30, 20]%s}";
    char text[sizeof cube_text + 64], change[128];
    snprintf(text, sizeof text, "%.*s, \"background\": [1, 1, 1]}", (int)sizeof cube_text - 2,
             cube_text);
    assert_string_equal(notes_on(text, NULL, 0), "");
    assert_string_equal(notes_on(text, "materials.m={}", 0), BLACK NO_MATERIAL);
    assert_string_equal(notes_on(glass_text, NULL, 0), "");
    assert_string_equal(notes_on(glass_text, "image.depth=0", 0),
                        BLACK "image.depth is 0, too small to see through glass or in mirrors\n");
    snprintf(change, sizeof change, away, "");
    assert_string_equal(notes_on(text, change, 0), "nothing is in view in frame 0" LOOK);
    snprintf(change, sizeof change, away, ", \"frames\": 2");
    assert_string_equal(notes_on(text, change, 0), "");
    assert_string_equal(notes_on(least_text, "background=[0, 0, 0.1]", 0), "");
    assert_string_equal(notes_on(least_text, NULL, 0),
                        "nothing is in view in frame 0, and background is black" LOOK);
}

TEST(materials_of_meshes_count) {
    static const struct {
        const char *library, *notes;
    } cases[] = {{"newmtl m\nKd 0 0 0\n", BLACK NO_MATERIAL},
                 {"newmtl m\nKd 1 1 1\n", ""},
                 {"newmtl m\nKd 0 0 0\nKe 0 0 1\n", ""},
                 {"newmtl m\nKd 0 0 0\nKe 0 0 1e-9\n", NEARLY_BLACK NO_WAY}};
    static const char mesh[] = "mtllib g.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    write_bytes("g.obj", mesh, sizeof mesh - 1);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_bytes("g.mtl", cases[i].library, strlen(cases[i].library));
        assert_string_equal(notes_on(mesh_text, NULL, 0), cases[i].notes);
    }
}
