/* SPDX-License-Identifier: MIT */
/* Wrong scene files: each is refused, with a message that says what and where, also in the terms of
   other programs. */
#include "scene_text.h"

static HdSceneFile file;
static HdError error;

#define SMALL "{\"hedron\": 1, \"camera\": {\"eye\": [9, 0, 0]}"

/* ---- one value of the rich scene ---- */

/* Expects the message "a.json: --set CHANGE: ", then the formatted text, and perhaps more. */
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
static void
expect_change_refused(HdSceneChange change, const char *format, ...) {
    char message[1024];
    va_list arguments;
    const size_t used = (size_t)snprintf(message, sizeof message, "a.json: --set %s: ", change);
    va_start(arguments, format);
    vsnprintf(message + used, sizeof message - used, format, arguments);
    va_end(arguments);
    const char *got = expect_refused(rich_text, change, message);
    assert_ptr_equal(strstr(got, message), got);
    assert_null(strchr(got, '\n'));
}

/* A field of numbers: both ends of its range, and values just outside. */
static const struct Range {
    const char *path, *low, *high, *below, *above, *expected;
} ranges[] = {
    {"image.width", "1", "65535", "0", "65536", "an integer from 1 to 65535"},
    {"image.cutoff", "0", "0.999999", "-1e-9", "1", "a number of at least 0 and below 1"},
    {"image.exposure", "1e-300", "1e6", "0", "1000001", "a number above 0 and at most 1e6"},
    {"camera.field_of_view", "1e-6", "179", "0", "179.001", "a number above 0 and at most 179"},
    {"camera.target[2]", "-1e12", "1e12", "-1.1e12", "1.1e12", "a number from -1e12 to 1e12"},
    {"materials.glass.inner_reflection", "0", "0.93", "-1e-9", "1.01", "a number from 0 to 1"},
    {"solids[1].edge_lights.per_edge", "0", "3332", "-1", "100001", "an integer from 0 to 100000"},
    {"solids[1].edge_lights.colours[1][2]", "0", "1", "-1e-9", "1.001", "a number from 0 to 1"},
    {"meshes[0].scale[1]", "1e-12", "1e12", "0", "2e12",
     "a number from 1e-12 to 1e12, or its negative"},
    {"meshes[0].scale[2]", "-1e12", "-1e-12", "-2e12", "-1e-13",
     "a number from 1e-12 to 1e12, or its negative"},
    {"meshes[0].size", "1e-12", "1e12", "0", "2e12", "a number from 1e-12 to 1e12"},
    {"lights[0].intensity", "0", "1e12", "-1e-300", "1.1e12", "a number from 0 to 1e12"},
    {"output.frames_per_second", "1", "240", "0", "241",
     "an integer or \"n000/1001\", n from 1 to 240"},
    {"output.frames_per_second", "1000/1001", "240000/1001", "23.976", "-24",
     "an integer or \"n000/1001\", n from 1 to 240"},
    {"floor.corners[0][2]", "-20", "-20", "-1.1e12", "1.1e12", "a number from -1e12 to 1e12"},
};

static void expect_value_refused(const struct Range *range, const char *value, const char *is) {
    char change[128];
    snprintf(change, sizeof change, "%s=%s", range->path, value);
    expect_change_refused(change, "%s is %s, expected %s", range->path, is, range->expected);
}

TEST(test_numbers) {
    static const char *const wrong[][2] = {{"blue", "a string, \"blue\""},
                                           {"null", "null"},
                                           {"true", "true"},
                                           {"[1]", "an array of 1 element"},
                                           {"{}", "an object"},
                                           {"1e300", "1e300"},
                                           /* No JSON, so strings: there are no such numbers. */
                                           {"NaN", "a string, \"NaN\""},
                                           {"-Infinity", "a string, \"-Infinity\""}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const struct Range *range = &ranges[i];
        const char *const ends[] = {range->low, range->high};
        for (int k = 0; k < 2; k++) {
            char change[128];
            snprintf(change, sizeof change, "%s=%s", range->path, ends[k]);
            expect_scene(&file, rich_text, change);
            hd_scene_file_free(&file);
        }
        expect_value_refused(range, range->below, range->below);
        expect_value_refused(range, range->above, range->above);
        for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
            expect_value_refused(range, wrong[k][0], wrong[k][1]);
        if (strncmp(range->expected, "an integer", 10) == 0)
            expect_value_refused(range, "1.5", "1.5");
    }
}

/* The message after the change and its path, or, if that is at fault, its part. */
static const struct {
    const char *path, *value, *rest;
} wrong[] = {
    /* types, and values that are no choice */
    {"hedron", "2", "is 2, expected 1"},
    {"camera.eye", "3",
     "is 3, expected three numbers, [x, y, z], or an object with the path on a cylinder"},
    {"camera.target", "[1, 2]",
     "is an array of 2 elements, expected three numbers, each a number from -1e12 to 1e12"},
    {"solids[0].centre", "7", "is 7, expected three numbers, each a number from -1e12 to 1e12"},
    {"meshes[0].scale", "2e12", "is 2e12, expected a number from 1e-12 to 1e12, or its negative"},
    {"meshes[0].scale", "[1,1]",
     "is an array of 2 elements, expected one number or three, each a number from 1e-12 to 1e12, "
     "or its negative"},
    {"solids[0].kind", "7",
     "is 7, expected \"tetrahedron\", \"cube\", \"octahedron\", \"dodecahedron\" or "
     "\"icosahedron\""},
    {"output.curve", "gamma", "is a string, \"gamma\", expected \"srgb\" or \"linear\""},
    {"output.bits", "10", "is 10, expected 8, 16 or 32"},
    {"materials.glass.lit_from_behind", "1", "is 1, expected true or false"},
    {"solids[0].material", "steel",
     "is a string, \"steel\", expected the name of one of the materials: \"glass\""},
    {"meshes[0].file", "5", "is 5, expected a string that is not empty"},
    {"output.path", "", "is a string, \"\", expected a string that is not empty"},
    {"image", "[]", "is an array of 0 elements, expected an object"},
    {"lights", "{}", "is an object, expected an array of objects"},
    {"floor.corners", "3", "is 3, expected an array of vectors"},
    {"materials", "3", "is 3, expected an object with a material for each name"},
    {"image.width", "12345678901234567890", "is 1.2345678901234567e19, expected an integer from"},
    /* numbers of elements; keys that are missing or surplus */
    {"solids[1].edge_lights.colours", "[]", "has 0 elements, expected 1 to 30 elements"},
    {"floor.corners", "[[0,0,0],[1,0,0],[1,1,0]]", "has 3 elements, expected 4 elements"},
    {"floor.texture.x", "1", "is an unknown key, expected \"file\" or \"curve\""},
    {"lights[0].falloff_end", "3",
     "is given together with \"falloff_distance\", expected only one"},
    {"meshes", "[{}]", "[0].file is missing, expected a string that is not empty"},
    {"image", "{\"$comment\": 1}", "[\"$comment\"] is 1, expected a string"},
    /* a default that replaces a wrong value causes no further error */
    {"solids[1].circumradius", "-1", "is -1, expected a number from 1e-12 to 1e12"},
    {"solids[1].centre", "[1,2,\"3\"]", "[2] is a string, \"3\", expected a number from -1e12"},
    {"floor.corners", "[[0,0,0],[0,0,0],[0,0,0],[0,0,null]]", "[3][2] is null, expected a number"},
    /* names of files */
    {"output.path", "film.avi",
     "is \"film.avi\", expected the name of a film (.mp4, .mov, .webm, .mkv or .gif) or of a "
     "picture (.png, "
     ".exr, .pfm or .data)"},
    {"output.path", "%d_%d.png", "cannot be used: the pattern \"%d_%d.png\" has 2 frame numbers"},
    {"output.path", "#/%5.png", "cannot be used: the pattern \"#/%5.png\" has \"%5.p\""},
    {"output.path", "%d.mp4", "is \"%d.mp4\", expected a film without a number"},
    {"output.frames_per_second", "24001/1001", "is a string, \"24001/1001\", expected an integer"},
    {"output.frames_per_second", "241000/1001", "is a string, \"241000/1001\", expected an int"},
    {"output.frames_per_second", "024000/1001", "is a string, \"024000/1001\", expected an int"},
    {"output.frames_per_second", "24000/1001.", "is a string, \"24000/1001.\", expected an int"},
    {"output.path", "\"a\\n.png\"",
     "is a string, \"a\\u000a.png\", expected a name without control characters"},
    {"output.path", "\"a\\u009b.png\"", "is a string, \"a\\u009b.png\", expected a name without "},
    {"meshes[0].file", "\"a\\u001b.obj\"", "is a string, \"a\\u001b.obj\", expected a name "},
    {"solids[0].material", "\"a\\u0085\"", "is a string, \"a\\u0085\", expected the name of one "},
    {"floor.texture.file", "builtin:wood",
     "is \"builtin:wood\", which is unknown, expected \"builtin:floor\" or a file"},
    /* words that stand for others */
    {"solids[0].kind", "hexahedron", "is a string, \"hexahedron\"; did you mean \"cube\"?"},
    {"solids[0].kind", "icosaedron", "is a string, \"icosaedron\"; did you mean \"icosahedron\"?"},
    {"solids[0].material", "glas", "is a string, \"glas\"; did you mean \"glass\"?"},
};

TEST(test_wrong_values) {
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const char *path = wrong[i].path, *rest = wrong[i].rest;
        char change[128];
        snprintf(change, sizeof change, "%s=%s", path, wrong[i].value);
        expect_change_refused(change, "%s%s%s", path, strchr(".[", rest[0]) != NULL ? "" : " ",
                              rest);
    }
}

TEST(test_changes_that_cannot_be_made) {
    static const char *const changes[][2] = {
        {"camera.target.r0=3", "camera.target is an array of 3 elements, expected an object"},
        {"solids[3].kind=cube",
         "solids is an array of 3 elements, expected an array with an element 3"},
        {"image[0]=1", "image is an object, expected an array with an element 0"},
        {"solids.kind=1", "solids is an array of 3 elements, expected an object"},
        {"materials.glas.diffuse=1", "materials.glas is missing; did you mean \"glass\"?"},
        {"materials.steel.diffuse=1", "materials.steel is missing, expected one of \"glass\""},
        {"solids.0.centre=[1,2,3]", "solids is an array of 3 elements; write solids[0]"},
        {"solids[1].edge_lights.colours.1=[1,2,3]",
         "solids[1].edge_lights.colours is an array of 2 "
         "elements; write solids[1].edge_lights.colours[1]"},
        {"image.width=1e999", "the value is too large, expected a number that a double can hold"},
        {"", "there is no sign =, expected PATH=VALUE"},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++)
        expect_change_refused(changes[i][0], "%s", changes[i][1]);
}

TEST(test_unknown_changes) {
    char changes[] = "=3 .image=3 image.=3 image..width=3 solids[]=3 solids[x]=3 solids[0=3 "
                     "solids[01]=3 solids[0]x=3 solids[9999999999]=3 [0]=3 solids[0].=3 "
                     "materials.\"my.glass.diffuse=1 materials.\"\".diffuse=1";
    for (char *change = strtok(changes, " "); change != NULL; change = strtok(NULL, " "))
        expect_change_refused(change, "the path is not understood, expected one such as ");
}

TEST(test_keys_with_other_names) {
    /* Pairs of an object's message and the right word. */
    static const char *const words[][2] = {
        {"camera.", "fov field_of_view position eye look_at target"},
        {"solids[0].", "position centre center centre radius circumradius type kind"},
        {"solids[1].edge_lights.", "count per_edge lights per_edge radius disc_radius"},
        {"materials.glass.",
         "Color colour ior index_of_refraction transparency transmission opacity "
         "transmission emission ambient Diffuse diffuse"},
        {"lights[0].", "color colour"},
        {"meshes[0].", "centre position path file smooth normals angle crease"},
        {"output.", "fps frames_per_second file path"},
        {"floor.texture.", "gamma curve path file"},
        {"image.", "widht width"},
        {"", "meshs meshes objects meshes fov camera.field_of_view width image.width"},
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char said[64], meant[64], change[128];
        int used;
        for (const char *at = words[i][1]; sscanf(at, "%63s %63s%n", said, meant, &used) == 2;
             at += used) {
            snprintf(change, sizeof change, "%s%s=1", words[i][0], said);
            expect_change_refused(change, "%s%s is an unknown key; did you mean \"%s\"?",
                                  words[i][0], said, meant);
        }
    }
}

/* ---- whole texts, and relations between values ---- */

static const struct {
    const char *text;
    HdSceneChange change;
    const char *message; /* from its begin on, after "a.json" */
} refused[] = {
    {"", NULL, " is empty, expected a scene in JSON"},
    {"{\"hedron\": 1,\n \"hedron\": 1}", NULL, ":2:9: duplicate object key"},
    {"{\"hedron\": NaN}", NULL, ":1:14: invalid token near 'NaN'; a number in JSON looks like "},
    {"{\"hedron\": nana}", NULL, ":1:15: invalid token near 'nana'"},
    {"{\"hedron\": 1 // one\n}", NULL, ":1:14: '}' expected near '/'; JSON has no comments"},
    {"{\"hedron\": -1e999}", NULL, ":1:17: real number overflow"},
    {"{\"hedron\": 99999999999999999999}", NULL, ": 2 problems\n  hedron is 1e20, expected 1\n"},
    {"{\"output\": {\"path\": \"\xff\"}}", NULL, ":1:21: unable to decode byte 0xff"},
    {"{\"output\": {\"path\": \"a\\u0000b\"}}", NULL,
     ":1:30: a string has the character \\u0000, expected text without it"},
    {"[]", NULL, ": the scene is an array of 0 elements, expected an object"},
    {"[]", "image.width=3",
     ": 2 problems\n  --set image.width=3: the scene is an array of 0 elements, expected an "
     "object\n"},
    {" 10\nout/%d.data 640 480", NULL,
     ": this looks like a classic input, which 'hedron convert "
     "FILE -o scene.json' converts to a scene"},
    {least_text, "floor.material=a",
     ": --set floor.material=a: floor is missing, expected it in "
     "the scene"},
    {SMALL ", \"a\\u001b.b\": 0}", NULL, ": [\"a\\u001b.b\"] is an unknown key"},
    {rich_text, "output.path=\xff", ": --set output.path=\\xff: the value is not UTF-8"},
    {rich_text,
     "solids[1]={\"kind\": \"cube\", \"circumradius\": -1, \"material\": \"dark\", \"rim\": "
     "{\"width\": 50, \"material\": \"dark\"}}",
     ": --set solids[1]={"},
    /* messages spell a key in their own way, and name the change all the same */
    {SMALL ", \"materials\": {\"blue glass\": {}}}", "materials.blue glass.reflection=2",
     ": --set materials.blue glass.reflection=2: materials[\"blue glass\"].reflection is 2, "
     "expected a number from 0 to 1"},
    {SMALL ", \"materials\": {\"a[0]=b\": {}}}", "materials.\"a[0]=b\".diffuse=-1",
     ": --set materials.\"a[0]=b\".diffuse=-1: materials[\"a[0]=b\"].diffuse is -1"},
    /* the sum of a material's shares is reported once, however many use it */
    {SMALL ", \"materials\": {\"m\": {\"reflection\": 0.5}}, \"solids\": [\n"
           "{\"kind\": \"cube\", \"material\": \"m\"}, {\"kind\": \"cube\", \"material\": \"m\"}]}",
     "materials.m.transmission=0.75",
     ": materials.m: reflection + transmission is 1.25, expected at most 1"},
    {SMALL ", \"materials\": {\"blue glass\": {\"reflection\": 0.5}}}",
     "materials.blue glass.inner_transmission=0.75",
     ": materials[\"blue glass\"]: inner reflection + transmission is 1.25, expected at most 1"},
    {rich_text, "solids[1].edge_lights.per_edge=3334",
     ": solids[1]: edge_lights.per_edge is 3334, which makes 100020 lights on its 30 edges, "
     "expected at most 100000 lights in the scene"},
    {rich_text, "solids[2].edge_lights.per_edge=16666",
     ": number of lights, those on the edges included, is 100088, expected at most 100000"},
    /* several problems */
    {"{}", NULL,
     ": 2 problems\n  hedron is missing, expected 1\n  camera is missing, expected an object"},
    {rich_text, "solids[0]={}",
     ": 2 problems\n  --set solids[0]={}: solids[0].kind is missing, expected \"tetrahedron\", "
     "\"cube\", \"octahedron\", \"dodecahedron\" or \"icosahedron\"\n"
     "  --set solids[0]={}: solids[0].material is missing, expected the name of one of the"},
    {"{\"hedron\": 1, \"image\": {\"width\": 0, \"depth\": []}, \"camera\": {\"frames\": 1.5},\n"
     " \"colour\": 3, \"materials\": {\"my glass\": {\"reflection\": 2}},\n"
     " \"solids\": [{\"kind\": \"cube\", \"material\": 1}, {\"kind\": \"cube\", \"material\": \"my "
     "glass\"}]}",
     NULL,
     ": 7 problems\n  image.width is 0, expected an integer from 1 to 65535\n"
     "  image.depth is an array of 0 elements, expected an integer from 0 to 1000\n"
     "  camera.frames is 1.5, expected an integer from 1 to 10000000\n"
     "  camera.eye is missing, expected three numbers, [x, y, z], or an object with the path "
     "on a cylinder\n"
     "  materials[\"my glass\"].reflection is 2, expected a number from 0 to 1\n"
     "  solids[0].material is 1, expected the name of one of the materials\n"
     "  colour is an unknown key, expected \"$schema\", \"hedron\", "},
};

TEST(test_wrong_texts) {
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        const char *got = expect_refused(refused[i].text, refused[i].change, refused[i].message);
        if (strncmp(got, "a.json", 6) != 0 || strstr(got + 6, refused[i].message) != got + 6)
            fail_msg("'%s', expected 'a.json%s'", got, refused[i].message);
        if (strchr(got, '\n') != NULL && strchr(refused[i].message, '\n') == NULL)
            fail_msg("'%s' has more than one line", got);
    }
}

TEST(test_outputs) {
    static const char *const cases[][2] = {
        {"film.gif", "output.path: film.gif cannot be linear, because GIF files cannot "},
        {"one.png", "output.path is \"one.png\", which names one picture, but camera.frames is 24, "
                    "expected #### in the name, or a film"},
        {"a/####.pfm", NULL},
        {"f.mkv", NULL},
        {"\xc2\xa0\xc3\xa9%d.png", NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        HdProblems notes = {.count = 0};
        char change[64];
        const HdSceneChange changes[] = {change};
        const HdSceneSource source = {
            .name = "a.json", .folder = "", .changes = changes, .change_count = 1, .notes = &notes};
        snprintf(change, sizeof change, "output.path=%s", cases[i][0]);
        expect_scene(&file, rich_text, change);
        assert_string_equal(file.output.path, cases[i][0]);
        hd_scene_file_free(&file);
        const HdStatus status =
            hd_scene_file_parse(&file, rich_text, strlen(rich_text), &source, &error);
        assert_int_equal(status, cases[i][1] != NULL ? HD_BAD_INPUT : HD_OK);
        if (cases[i][1] != NULL)
            expect_contains(error.message, cases[i][1]);
        hd_scene_file_free(&file);
    }
}

/* Errors of the whole and of files are reported along with the rest. */
TEST(test_problems_of_all_kinds) {
    static const HdSceneChange changes[] = {"materials.glass.transmission=0.99", "image.width=0",
                                            "floor.texture.file=no such.png"};
    const HdSceneSource source = {
        .name = "a.json", .folder = "", .changes = changes, .change_count = 3, .loads_files = true};
    assert_int_equal(hd_scene_file_parse(&file, rich_text, strlen(rich_text), &source, &error),
                     HD_BAD_INPUT);
    expect_contains(error.message, "a.json: 6 problems\n");
    expect_contains(error.message, "\n  materials.glass: reflection + transmission is 1.03");
    expect_contains(error.message, "\n  --set image.width=0: image.width is 0, expected");
    expect_contains(error.message,
                    "\n  floor.texture.file: cannot read the texture no such.png: No such file");
    expect_contains(error.message,
                    "\n  environment.file: cannot read the environment sky.pfm: No such");
    expect_contains(error.message, "\n  meshes[0].file: cannot read the mesh model.obj: No such");
}

TEST(test_zero_bytes_and_a_byte_order_mark) {
    static const char text[] = "{\n  \"hedron\": 1,\0}";
    char marked[sizeof least_text + 3];
    assert_int_equal(parse_scene(&file, text, sizeof text - 1, NULL, 0, &error), HD_BAD_INPUT);
    assert_string_equal(error.message, "a.json:2:15: there is a zero byte, expected JSON text");
    snprintf(marked, sizeof marked, "\xef\xbb\xbf%s", least_text);
    expect_scene(&file, marked, NULL);
    hd_scene_file_free(&file);
}

/* Returns `head`, so many times the element, which may have a number in it, with commas, and
   `tail`. */
static char *repeat(const char *head, const char *element, int count, const char *tail) {
    const size_t size = strlen(head) + (size_t)count * (strlen(element) + 8) + strlen(tail) + 1;
    char *text = malloc(size);
    assert_non_null(text);
    size_t used = (size_t)snprintf(text, size, "%s", head);
    for (int i = 0; i < count; i++) {
        const char *number = strchr(element, '#');
        used += (size_t)snprintf(text + used, size - used, "%s%.*s", i > 0 ? "," : "",
                                 (int)(number != NULL ? number - element : 100), element);
        if (number != NULL)
            used += (size_t)snprintf(text + used, size - used, "%d%s", i, number + 1);
    }
    snprintf(text + used, size - used, "%s", tail);
    return text;
}

TEST(test_too_many_elements) {
    static const struct {
        const char *head, *element, *tail;
        int most, count;
        const char *message;
    } cases[] = {
        {SMALL ", \"solids\": [", "{}", "]}", 0, 257,
         "solids has 257 elements, expected at most 256 elements"},
        {SMALL ", \"materials\": {", "\"m#\": {}", "}}", 1024, 1025,
         "materials has 1025 materials, expected at most 1024"},
        {SMALL ", \"materials\": {\"m\": {}}, \"solids\": [{\"kind\": \"icosahedron\", "
               "\"material\": \"m\", \"edge_lights\": {\"per_edge\": 1, \"colours\": [",
         "[0,0,0]", "]}}]}", 30, 31,
         "solids[0].edge_lights.colours has 31 elements, expected 1 to 30 elements"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = repeat(cases[i].head, cases[i].element, cases[i].count, cases[i].tail);
        expect_contains(expect_refused(text, NULL, "a.json: "), cases[i].message);
        free(text);
        if (cases[i].most == 0)
            continue;
        text = repeat(cases[i].head, cases[i].element, cases[i].most, cases[i].tail);
        expect_scene(&file, text, NULL);
        hd_scene_file_free(&file);
        free(text);
    }
}

/* ---- valid but unusual settings ---- */

/* Returns the notes on a scene, a line for each. */
static const char *notes_on(const char *text, HdSceneChange change) {
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

#define SMALLER                                                                                    \
    ": it is drawn smaller by a millionth or so, so that rounding does not decide which is in "    \
    "front\n"

#define CAMERA_PATH(frames, phi, r)                                                                \
    "camera={\"frames\": " frames ", \"eye\": {\"r0\": 9, \"z0\": 1, \"r_amplitude\": 1, "         \
    "\"phi_frequency\": " phi ", \"r_frequency\": " r "}}"
#define JUMPS ", so the film jumps from its end to its beginning; "

TEST(test_notes) {
    static const struct {
        const char *text;
        HdSceneChange change;
        const char *notes;
    } cases[] = {
        {least_text, NULL, ""},
        {quiet_text, NULL, ""},
        {quiet_text, "materials.my n={}", "materials[\"my n\"] is used nowhere\n"},
        {quiet_text, "camera.field_of_view=1.2",
         "camera.field_of_view is 1.2, which are degrees, not radians\n"},
        {quiet_text, "camera.eye=[9,0,-1.5]", "camera.eye is below the floor in frame 0\n"},
        {quiet_text, "solids[0].edge_lights.intensity=1", ""},
        {quiet_text, "solids[0].edge_lights.disc_radius=0.26",
         "solids[0].edge_lights overlap: their discs are 0.52 wide, and from light to light it is "
         "0.5\n"},
        {quiet_text, "solids[0].edge_lights.disc_radiance=0",
         "solids[0].edge_lights neither light nor show: they lack an intensity, and a "
         "disc_radius with a disc_radiance\n"},
        {quiet_text, "solids[0].centre=[0, 0, -0.25]", "solids[0] touches the floor" SMALLER},
        {quiet_text, "solids[0].centre=[0, 0, -1]",
         "solids[0] overlaps the floor: each has all of its faces there\n"},
        {quiet_text, "lights=[{\"position\": [0.5, 1, 0]}]", "solids[0] touches lights[0]" SMALLER},
        {quiet_text, "camera.eye={\"r0\": 9, \"z0\": 1, \"phi0\": -45}",
         "camera.eye.phi0 is -45, which are radians, not degrees: -45 degrees are -0.7854\n"},
        {quiet_text, "camera.target={\"r0\": 1, \"z_phase\": 90}",
         "camera.target.z_phase is 90, which are radians, not degrees: 90 degrees are 1.571\n"},
        {quiet_text, CAMERA_PATH("9", "1", "2.25"),
         "camera.eye.r_frequency is 2.25" JUMPS "2 or 3 makes it a loop\n"},
        {quiet_text, CAMERA_PATH("9", "-1.25", "1"),
         "camera.eye.phi_frequency is -1.25" JUMPS "-2 or -1 makes it a loop\n"},
        /* one frame; whole numbers; a shift that nobody sees; a view that only passes by */
        {quiet_text, CAMERA_PATH("1", "1.5", "1"), ""},
        {quiet_text, CAMERA_PATH("9", "1", "-2"), ""},
        {quiet_text, CAMERA_PATH("9", "1.0001", "1"), ""},
        {quiet_text, CAMERA_PATH("9", "0.25", "0.5"), ""},
        {quiet_text, "output={\"path\": \"f.mp4\", \"bits\": 16}",
         "output.bits is 16, but output.path is a film, which has 8 bits a channel\n"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_string_equal(notes_on(cases[i].text, cases[i].change), cases[i].notes);
}
