/* SPDX-License-Identifier: MIT */
/* What is written reads back as the same scene, and the schema says what the table of fields says.
   The first argument is the folder of the sources. */
#define _XOPEN_SOURCE 700

#include <jansson.h>

#include "classic_text.h"
#include "input/schema.h"
#include "input/write.h"
#include "scene_text.h"

#define SCHEMA "scenes/schema/hedron-scene.schema.json"

static HdSceneFile first, second;

/* Bit by bit: 0 and -0 differ. */
#define expect_same_bits(a, b) assert_memory_equal(&(a), &(b), sizeof(a))

static void expect_same_material(const HdMaterial *a, const HdMaterial *b) {
    expect_same_bits(a->colour, b->colour);
    expect_same_bits(a->mirror_tint, b->mirror_tint);
    expect_same_bits(a->ambient, b->ambient);
    expect_same_bits(a->diffuse, b->diffuse);
    expect_same_bits(a->specular, b->specular);
    assert_int_equal(a->shininess, b->shininess);
    expect_same_bits(a->reflection, b->reflection);
    expect_same_bits(a->transmission, b->transmission);
    assert_int_equal(a->has_inner_side, b->has_inner_side);
    if (a->has_inner_side) {
        expect_same_bits(a->inner_reflection, b->inner_reflection);
        expect_same_bits(a->inner_transmission, b->inner_transmission);
    }
    expect_same_bits(a->index_of_refraction, b->index_of_refraction);
    assert_int_equal(a->lit_from_behind, b->lit_from_behind);
}

static void expect_same_edge_lights(const HdEdgeLights *a, const HdEdgeLights *b) {
    assert_int_equal(a->per_edge, b->per_edge);
    assert_int_equal(a->colour_count, b->colour_count);
    for (int i = 0; i < a->colour_count; i++)
        expect_same_bits(a->colours[i], b->colours[i]);
    expect_same_bits(a->intensity, b->intensity);
    expect_same_bits(a->falloff, b->falloff);
    expect_same_bits(a->disc_radius, b->disc_radius);
    expect_same_bits(a->disc_radiance, b->disc_radiance);
}

static void expect_same_solid(const HdSolid *a, const HdSolid *b) {
    assert_int_equal(a->kind, b->kind);
    expect_same_bits(a->centre, b->centre);
    expect_same_bits(a->circumradius, b->circumradius);
    expect_same_bits(a->rotation_degrees, b->rotation_degrees);
    expect_same_material(&a->face, &b->face);
    expect_same_bits(a->rim_width, b->rim_width);
    if (a->rim_width > 0.0)
        expect_same_material(&a->rim, &b->rim);
    expect_same_edge_lights(&a->lights, &b->lights);
}

static void expect_same_path(const HdPath *a, const HdPath *b) {
    assert_int_equal(a->is_fixed, b->is_fixed);
    if (a->is_fixed)
        expect_same_bits(a->point, b->point);
    else
        expect_same_bits(a->cylinder, b->cylinder);
}

static void expect_same_picture(const HdScene *a, const HdScene *b) {
    assert_int_equal(a->frame_count, b->frame_count);
    expect_same_path(&a->eye, &b->eye);
    expect_same_path(&a->target, &b->target);
    expect_same_bits(a->field_of_view_degrees, b->field_of_view_degrees);
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->samples_per_side, b->samples_per_side);
    assert_int_equal(a->depth, b->depth);
    expect_same_bits(a->cutoff, b->cutoff);
    expect_same_bits(a->exposure, b->exposure);
    expect_same_bits(a->background, b->background);
}

static void expect_same_scene(const HdScene *a, const HdScene *b) {
    expect_same_picture(a, b);
    assert_int_equal(a->solid_count, b->solid_count);
    for (int i = 0; i < a->solid_count; i++)
        expect_same_solid(&a->solids[i], &b->solids[i]);
    assert_int_equal(a->light_count, b->light_count);
    for (int i = 0; i < a->light_count; i++)
        expect_same_bits(a->lights[i], b->lights[i]);
    assert_int_equal(a->floor.present, b->floor.present);
    if (!a->floor.present)
        return;
    expect_same_bits(a->floor.corners, b->floor.corners);
    expect_same_material(&a->floor.material, &b->floor.material);
}

static void expect_same_mesh(const HdMeshEntry *a, const HdMeshEntry *b) {
    assert_string_equal(a->file, b->file);
    assert_int_equal(a->normals, b->normals);
    expect_same_bits(a->crease_degrees, b->crease_degrees);
    expect_same_bits(a->instance.position, b->instance.position);
    expect_same_bits(a->instance.rotation_degrees, b->instance.rotation_degrees);
    expect_same_bits(a->instance.scale, b->instance.scale);
    assert_int_equal(a->instance.has_material, b->instance.has_material);
    if (a->instance.has_material)
        expect_same_material(&a->instance.material, &b->instance.material);
}

static void expect_same_file(const HdSceneFile *a, const HdSceneFile *b) {
    expect_same_scene(&a->scene, &b->scene);
    assert_string_equal(a->output.path, b->output.path);
    assert_int_equal(a->output.style.frames_per_second, b->output.style.frames_per_second);
    assert_int_equal(a->output.style.picture.curve, b->output.style.picture.curve);
    assert_int_equal(a->output.style.picture.bits, b->output.style.picture.bits);
    assert_string_equal(a->texture_path, b->texture_path);
    if (a->texture_path[0] != '\0')
        assert_int_equal(a->texture_curve, b->texture_curve);
    assert_int_equal(a->mesh_entry_count, b->mesh_entry_count);
    for (int i = 0; i < a->mesh_entry_count; i++)
        expect_same_mesh(&a->mesh_entries[i], &b->mesh_entries[i]);
}

typedef HdStatus Print(FILE *out, HdError *error);

static HdStatus print_first(FILE *out, HdError *error) {
    return hd_scene_file_print(out, &first, error);
}

/* The caller frees it. */
static char *printed(Print *print) {
    static HdError error;
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    if (print(out, &error) != HD_OK)
        fail_msg("%s", error.message);
    assert_int_equal(fclose(out), 0);
    return text;
}

/* Prints `first`, reads that into `second`, and compares the two. */
static void expect_round_trip(void) {
    char *text = printed(print_first);
    expect_scene(&second, text, NULL);
    expect_same_file(&first, &second);
    hd_scene_file_free(&second);
    free(text);
}

TEST(test_rich_scene) {
    expect_scene(&first, rich_text, NULL);
    expect_round_trip();
    hd_scene_file_free(&first);
}

TEST(test_least_scene) {
    expect_scene(&first, least_text, NULL);
    expect_round_trip();
    hd_scene_file_free(&first);
}

TEST(test_values_that_are_hard_to_write) {
    static const char *const changes[] = {
        "camera.eye.r0=-0.0",
        "camera.eye.z0=0.1",
        "camera.eye.phi0=0.30000000000000004",
        "camera.eye.r_phase=5e-324",
        "camera.eye.z_phase=123456789.12345679",
        "camera.eye={}",
        "background=[-0.0, 0, 1e-300]",
        "background=[0, -0.0, 0]",
        "materials.plain={\"diffuse\": 0.125, \"inner_reflection\": 0.5}",
        "output.path=\"a\\\"b\\\\c \\u00e9.png\"",
        "materials.glass.inner_reflection=0",
        "materials.glass.inner_transmission=0",
        "materials.glass={\"transmission\": 0.5, \"inner_reflection\": 0}",
        "materials.dark.diffuse=-0.0",
        "lights[0].colour=[0,0,0]",
        "lights[0].colour=[-0.0,0,1]",
        "solids[1].edge_lights.per_edge=0",
        "solids[1].edge_lights.colours=[[1,1,1]]",
        "solids[1].edge_lights.colours=[[1,1,1],[1,1,1]]",
        "floor.texture.curve=srgb",
        "meshes[0].scale=[2, 2, 2]",
        "meshes[0].scale=1",
        "meshes[0].scale=[2, 2, 3]",
        "meshes[0].scale=[3, 2, 2]",
        "meshes[0].crease=40",
        "meshes[0].normals=file",
        "meshes[0].position=[0, -0.0, 0]",
        "meshes[1].material=glass",
        "meshes[1].material=plain",
        "meshes[1].file=\"a\\\"b \\u00e9.obj\"",
    };
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        expect_scene(&first, rich_text, changes[i]);
        expect_round_trip();
        hd_scene_file_free(&first);
    }
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

/* The product of colour and intensity must come out to the bit. */
TEST(test_intensities_of_lights) {
    enum { COUNT = 20000 };
    expect_scene(&first, least_text, NULL);
    first.scene.lights = calloc(COUNT, sizeof *first.scene.lights);
    assert_non_null(first.scene.lights);
    first.scene.light_count = COUNT;
    for (int i = 0; i < COUNT; i++)
        first.scene.lights[i].intensity = hd_vec3(random_light(), random_light(), random_light());
    expect_round_trip();
    hd_scene_file_free(&first);
}

TEST(test_classic_scenes) {
    for (int variant = 1; variant <= HD_CLASSIC_VARIANTS; variant++) {
        expect_parsed(&first, official, variant);
        assert_int_equal(first.output.style.frames_per_second, 30);
        assert_int_equal(first.output.style.picture.curve, HD_CURVE_LINEAR);
        assert_int_equal(first.output.style.picture.bits, 8);
        assert_int_equal(first.texture_curve, HD_CURVE_LINEAR);
        expect_round_trip();
        hd_scene_file_free(&first);
    }
}

static void expect_printed(const char *part) {
    char *text = printed(print_first);
    expect_contains(text, part);
    free(text);
}

TEST(test_layout) {
    expect_scene(&first, rich_text, "lights[0].colour=[0.5,0.25,0]");
    expect_printed("{\n  \"hedron\": 1,\n  \"image\": {\n    \"width\": 320,\n");
    expect_printed("\n    \"target\": [0.5, 0.25, 0.125]\n");
    expect_printed(
        "\n        \"colours\": [\n          [1, 0, 0],\n          [0, 1, 0.5]\n        ]");
    /* Materials that are alike have one name, and no more is said than must be. */
    expect_printed(
        "\n    \"solid_2\": {\n      \"diffuse\": 0.125\n    },\n    \"rim_2\": {}\n  },");
    expect_printed("\n      \"material\": \"rim_2\",\n      \"edge_lights\": {\n        "
                   "\"per_edge\": 1,\n        \"falloff_end\": 7\n      }\n");
    expect_printed("\n    \"material\": \"solid_2\",\n    \"texture\": {\n");
    expect_printed("\n      \"colour\": [1, 0.5, 0],\n      \"intensity\": 1.5,\n");
    expect_printed(
        "\n      \"scale\": [1, 2, 3],\n      \"normals\": \"smooth\",\n      \"crease\": 25,"
        "\n      \"material\": \"solid_2\"\n    },\n    {\n      \"file\": "
        "\"other.obj\",\n      \"scale\": 0.5,\n      \"normals\": \"flat\"\n    }\n  ],");
    expect_printed("\n      \"position\": [7, 8, 9],\n      \"falloff_end\": 10\n    }\n  ],");
    hd_scene_file_free(&first);
}

TEST(test_paths_that_are_not_utf8) {
    static HdError error;
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
    static HdError error;
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

static char *read_schema(void) {
    char path[4096];
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    snprintf(path, sizeof path, "%s/%s", unit_project, SCHEMA);
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        fail_msg("cannot open %s", path);
    assert_true(fread(text, 1, (1 << 20) - 1, file) > 0);
    fclose(file);
    return text;
}

TEST(test_committed_schema) {
    char *committed = read_schema();
    char *text = printed(hd_scene_schema_print);
    if (strcmp(committed, text) != 0)
        fail_msg("%s is not what hd_scene_schema_print writes: write it anew", SCHEMA);
    free(committed);
    free(text);
}

static void expect_range(const HdField *field, const json_t *schema) {
    const char *low = field->above_low ? "exclusiveMinimum" : "minimum";
    const char *high = field->below_high ? "exclusiveMaximum" : "maximum";
    expect_near(json_number_value(json_object_get(schema, low)), field->low, 0.0);
    expect_near(json_number_value(json_object_get(schema, high)), field->high, 0.0);
}

/* Every field has its place in the schema, with its range; returns how many there are. */
static int expect_object_schema(const HdObjectType *type, const json_t *schema) {
    const json_t *properties = json_object_get(schema, "properties");
    int count = type->field_count;
    assert_true(json_is_false(json_object_get(schema, "additionalProperties")));
    assert_int_equal(json_object_size(properties), type->field_count + 1);
    assert_non_null(json_object_get(properties, HD_COMMENT_KEY));
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        const json_t *own = json_object_get(properties, field->key);
        if (own == NULL)
            fail_msg("the schema has no \"%s\"", field->key);
        assert_string_equal(json_string_value(json_object_get(own, "description")), field->about);
        if (field->type == HD_FIELD_NUMBER || field->type == HD_FIELD_INTEGER ||
            field->type == HD_FIELD_FACTOR)
            expect_range(field, own);
        if (field->type == HD_FIELD_VECTOR || field->type == HD_FIELD_UNSCALED)
            expect_range(field, json_object_get(own, "items"));
        if (field->type == HD_FIELD_PATH)
            own = json_array_get(json_object_get(own, "oneOf"), 1);
        if (field->type == HD_FIELD_LIST)
            own = json_object_get(own, "items");
        if (field->type == HD_FIELD_MATERIALS)
            own = json_object_get(own, "additionalProperties");
        if (field->object != NULL)
            count += expect_object_schema(field->object, own);
    }
    return count;
}

TEST(test_schema_has_every_field) {
    char *text = printed(hd_scene_schema_print);
    json_error_t error;
    json_t *schema = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    if (schema == NULL)
        fail_msg("%d:%d: %s", error.line, error.column, error.text);
    assert_true(expect_object_schema(&hd_scene_fields, schema) > 80);
    json_decref(schema);
    free(text);
}

/* The reader tells these pairs by their keys. */
TEST(test_table_is_sound) {
    for (int i = 0; i < hd_scene_fields.field_count; i++) {
        const HdObjectType *type = hd_scene_fields.fields[i].object;
        for (int k = 0; type != NULL && k < type->field_count; k++) {
            const HdField *field = &type->fields[k];
            assert_ptr_equal(hd_field(type, field->key), field);
            if (field->instead_of != NULL)
                assert_non_null(hd_field(type, field->instead_of));
            if (field->type == HD_FIELD_FACTOR) {
                assert_int_equal(field[-1].type, HD_FIELD_UNSCALED);
                assert_int_equal(field[-1].offset, field->offset);
            }
        }
    }
    assert_null(hd_field(&hd_scene_fields, "Hedron"));
}
