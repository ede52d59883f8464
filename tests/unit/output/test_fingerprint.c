/* SPDX-License-Identifier: MIT */
/* Whatever decides a pixel changes the fingerprint, and nothing else does. */
#include <stdint.h>

#include "image/mark.h"
#include "input/fields.h"
#include "output/fingerprint.h"
#include "scene_text.h"

enum { MAX_FIELDS = 256 };

static HdSceneFile file;
static const HdPictureStyle style = {.curve = HD_CURVE_SRGB, .bits = 8};
static uint64_t usual;

static const HdField *changed[MAX_FIELDS];
static int changed_count;

static uint64_t fingerprint(void) {
    return hd_run_fingerprint(&file, HD_PRECISION_FLOAT, &style);
}

static void note_changed(const HdField *field) {
    assert_true(changed_count < MAX_FIELDS);
    for (int i = 0; i < changed_count; i++)
        if (changed[i] == field)
            return;
    changed[changed_count++] = field;
}

static bool is_changed(const HdField *field) {
    for (int i = 0; i < changed_count; i++)
        if (changed[i] == field)
            return true;
    return false;
}

static void expect_seen(const char *what) {
    if (fingerprint() == usual)
        fail_msg("%s is changed, but the fingerprint is not", what);
}

static void expect_unseen(const char *what) {
    if (fingerprint() != usual)
        fail_msg("%s decides no pixel, but it changes the fingerprint", what);
}

static void change_integer(const HdField *field, int *place) {
    ++*place;
    expect_seen(field->key);
    --*place;
    note_changed(field);
}

static void change_number(const HdField *field, double *place) {
    const double was = *place;
    *place = was + 1.0;
    expect_seen(field->key);
    *place = was;
    note_changed(field);
}

static void change_vector(const HdField *field, HdVec3 *vector) {
    change_number(field, &vector->x);
    change_number(field, &vector->y);
    change_number(field, &vector->z);
}

static void change_object(const HdObjectType *type, void *owner);

static void change_path(const HdField *field, HdPath *path) {
    path->is_fixed = !path->is_fixed;
    expect_seen(field->key);
    path->is_fixed = !path->is_fixed;
    if (path->is_fixed)
        change_vector(field, &path->point);
    else
        change_object(field->object, path);
    note_changed(field);
}

static int *count_of(const HdField *field, void *owner) {
    return (int *)(void *)((char *)owner + field->count_offset);
}

static void change_vectors(const HdField *field, void *owner) {
    HdVec3 *vectors = (HdVec3 *)(void *)((char *)owner + field->offset);
    const int count = field->count_offset != 0 ? *count_of(field, owner) : field->most;
    for (int i = 0; i < count; i++)
        change_vector(field, &vectors[i]);
    if (field->count_offset != 0)
        change_integer(field, count_of(field, owner));
}

static void change_list(const HdField *field, void *owner) {
    char *elements;
    int *count = count_of(field, owner);
    memcpy(&elements, (char *)owner + field->offset, sizeof elements);
    assert_true(*count > 0);
    for (int i = 0; i < *count; i++)
        change_object(field->object, elements + (size_t)i * field->object->size);
    --*count;
    expect_seen(field->key);
    ++*count;
    note_changed(field);
}

static void change_text(const HdField *field, char *text) {
    const size_t length = strlen(text);
    text[length] = 'x';
    expect_unseen(field->key);
    text[length] = '\0';
    note_changed(field);
}

static void change_boolean(const HdField *field, bool *place) {
    *place = !*place;
    expect_seen(field->key);
    *place = !*place;
    note_changed(field);
}

static void change_value(const HdField *field, void *owner) {
    void *place = (char *)owner + field->offset;
    switch (field->type) {
    case HD_FIELD_BOOLEAN:
        change_boolean(field, place);
        break;
    case HD_FIELD_CHOICE:
        if (field->choices[1].word == NULL)
            break;
        change_integer(field, place);
        break;
    case HD_FIELD_INTEGER:
        change_integer(field, place);
        break;
    case HD_FIELD_NUMBER:
        change_number(field, place);
        break;
    case HD_FIELD_VECTOR:
    case HD_FIELD_UNSCALED:
    case HD_FIELD_FACTOR:
    case HD_FIELD_SCALE:
        change_vector(field, place);
        break;
    case HD_FIELD_VECTORS:
        change_vectors(field, owner);
        break;
    case HD_FIELD_TEXT:
        change_text(field, place);
        break;
    case HD_FIELD_MATERIAL:
        change_object(&hd_material_fields, place);
        break;
    case HD_FIELD_PATH:
        change_path(field, place);
        break;
    case HD_FIELD_OBJECT:
        change_object(field->object, place);
        break;
    case HD_FIELD_LIST:
        change_list(field, owner);
        break;
    case HD_FIELD_FILE:
    case HD_FIELD_MATERIALS:
        break;
    }
}

static void change_object(const HdObjectType *type, void *owner) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        if (strcmp(field->key, "output") != 0 &&
            (hd_field_is_given(field, owner) || field->zero_is_absent))
            change_value(field, owner);
    }
}

/* Everything that holds a value of its own was reached. */
static void expect_all_changed(const HdObjectType *type) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        const bool has_value = field->type != HD_FIELD_OBJECT && field->type != HD_FIELD_MATERIAL &&
                               field->type != HD_FIELD_MATERIALS && field->type != HD_FIELD_FILE &&
                               (field->type != HD_FIELD_CHOICE || field->choices[1].word != NULL);
        if (strcmp(field->key, "output") == 0)
            continue;
        if (has_value && !is_changed(field))
            fail_msg("no scene of this test has %s", field->key);
        if (field->object != NULL)
            expect_all_changed(field->object);
    }
}

TEST(every_field_of_a_scene_changes_it) {
    change_object(&hd_scene_fields, &file);
    expect_all_changed(&hd_scene_fields);
    assert_true(fingerprint() == usual);
}

/* As a file tells them, a colour and a factor, they may come back a rounding off. */
TEST(the_last_digit_of_bright_lights_changes_it) {
    HdVec3 *light = &file.scene.lights[0].intensity;
    const HdVec3 kept = *light;
    for (int i = 0; i < 1000; i++) {
        *light = hd_vec3(6e11 + 1e8 / 3.0 * i, 1e11 / 7.0 * i / 1000, 1e11 / (i + 1));
        const uint64_t before = fingerprint();
        light->y = nextafter(light->y, 1e12);
        assert_true(fingerprint() != before);
    }
    *light = kept;
}

TEST(what_becomes_of_the_frames_does_not) {
    file.output.style.frames_per_second++;
    expect_unseen("output.frames_per_second");
    file.output.style.frames_per_second--;
    change_text(&hd_scene_fields.fields[0], file.output.path);
    file.mesh_entries[0].file[0] ^= 1;
    expect_unseen("the name of a mesh's file");
    file.mesh_entries[0].file[0] ^= 1;
}

/* What files hold */

static HdVec3 vertices[3], normals[1];
static double uvs[1][2];
static int32_t corners[1][3], corner_normals[1][3], corner_uvs[1][3], material_of[1];
static uint8_t group_of[1];
static uint16_t floor_texels[6], texels[3];
static HdMeshMaterial materials[3]; /* the second is the mesh's */
static HdMesh mesh;
static HdPicture picture;
static HdInstance instance;

static void fill_content(HdScene *scene) {
    mesh = (HdMesh){.vertex_count = 3,
                    .normal_count = 1,
                    .uv_count = 1,
                    .triangle_count = 1,
                    .material_count = 1,
                    .vertices = vertices,
                    .normals = normals,
                    .uvs = uvs,
                    .corners = corners,
                    .corner_normals = corner_normals,
                    .corner_uvs = corner_uvs,
                    .material_of = material_of,
                    .group_of = group_of,
                    .materials = &materials[1]};
    picture = (HdPicture){.texture = {.width = 1, .height = 1, .texels = texels}};
    instance.has_material = true;
    scene->floor.texture = (HdTexture){.width = 2, .height = 1, .texels = floor_texels};
    scene->mesh_count = scene->picture_count = scene->instance_count = 1;
    scene->meshes = &mesh;
    scene->pictures = &picture;
    scene->instances = &instance;
}

static void drop_content(HdScene *scene) {
    scene->floor.texture = (HdTexture){0};
    scene->mesh_count = scene->picture_count = scene->instance_count = 0;
    scene->meshes = NULL;
    scene->pictures = NULL;
    scene->instances = NULL;
}

#define BITS(thing)                                                                                \
    { #thing, &(thing), sizeof(thing) }

/* Of each of these, one bit of the first byte and one of the last. */
TEST(what_files_hold_changes_it) {
    HdScene *scene = &file.scene;
    const struct {
        const char *what;
        void *place;
        size_t size;
    } list[] = {
        BITS(floor_texels),
        BITS(texels),
        BITS(vertices),
        BITS(normals),
        BITS(uvs),
        BITS(corners),
        BITS(corner_normals),
        BITS(corner_uvs),
        BITS(material_of),
        BITS(group_of),
        BITS(materials[1].emission),
        BITS(materials[1].picture),
        BITS(materials[1].passes_as),
        BITS(materials[1].material.diffuse),
        BITS(instance.position),
        BITS(instance.rotation_degrees),
        BITS(instance.scale),
        BITS(instance.mesh),
        BITS(picture.is_clamped),
        BITS(materials[1].is_opaque_to_shadows),
        BITS(instance.has_material),
        BITS(instance.material.reflection),
        BITS(scene->crop),
        BITS(scene->crop.left),
        BITS(scene->crop.top),
        BITS(scene->crop.whole_height),
        BITS(scene->geometry),
        BITS(scene->accel),
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        unsigned char *bytes = list[i].place;
        bytes[0] ^= 1;
        expect_seen(list[i].what);
        bytes[0] ^= 1;
        if (list[i].size == 1)
            continue;
        bytes[list[i].size - 1] ^= 1;
        expect_seen(list[i].what);
        bytes[list[i].size - 1] ^= 1;
    }
    assert_true(fingerprint() == usual);
}

TEST(arrays_that_are_missing_change_it) {
    mesh.normals = NULL;
    expect_seen("normals");
    mesh.normals = normals;
    mesh.group_of = NULL;
    expect_seen("group_of");
    mesh.group_of = group_of;
}

TEST(names_in_files_do_not) {
    char name[] = "name";
    materials[1].name = materials[1].texture = name;
    expect_unseen("the name of a material or of its texture");
    materials[1].name = materials[1].texture = NULL;
}

TEST(what_lies_beside_an_array_does_not) {
    for (int i = 0; i < 3; i += 2) {
        materials[i].emission.x = materials[i].material.diffuse = 1.0;
        expect_unseen("what lies beside a mesh's materials");
    }
}

TEST(how_it_is_rendered_and_stored_changes_it) {
    const HdPictureStyle linear = {.curve = HD_CURVE_LINEAR, .bits = 8};
    const HdPictureStyle deep = {.curve = HD_CURVE_SRGB, .bits = 16};
    assert_true(hd_run_fingerprint(&file, HD_PRECISION_DOUBLE, &style) != usual);
    assert_true(hd_run_fingerprint(&file, HD_PRECISION_FLOAT, &linear) != usual);
    assert_true(hd_run_fingerprint(&file, HD_PRECISION_FLOAT, &deep) != usual);
    assert_true(hd_picture_fingerprint(usual, 0) != hd_picture_fingerprint(usual, 1));
    assert_true(hd_picture_fingerprint(usual, 0) != hd_picture_fingerprint(usual + 1, 0));
}

/* A scene file can tell of the first two alone. */
TEST(every_sampling_has_its_own) {
    const HdSampling was = file.scene.sampling;
    uint64_t marks[3];
    for (int i = 0; i < 3; i++) {
        file.scene.sampling = (HdSampling)i;
        marks[i] = fingerprint();
    }
    file.scene.sampling = was;
    assert_true(marks[HD_SAMPLING_GRID] != marks[HD_SAMPLING_ADAPTIVE]);
    assert_true(marks[HD_SAMPLING_ADAPTIVE] != marks[HD_SAMPLING_REFERENCE]);
    assert_true(marks[HD_SAMPLING_REFERENCE] != marks[HD_SAMPLING_GRID]);
}

static int read_scene(void **state) {
    (void)state;
    expect_scene(&file, rich_text, NULL);
    file.schema[0] = 's';
    fill_content(&file.scene);
    usual = fingerprint();
    return 0;
}

static int free_scene(void **state) {
    (void)state;
    drop_content(&file.scene);
    hd_scene_file_free(&file);
    return 0;
}

GROUP(read_scene, free_scene)
