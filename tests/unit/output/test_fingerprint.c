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

static bool is_changed(const HdField *field) {
    for (int i = 0; i < changed_count; i++)
        if (changed[i] == field)
            return true;
    return false;
}

static void note_changed(const HdField *field) {
    if (is_changed(field))
        return;
    assert_true(changed_count < MAX_FIELDS);
    changed[changed_count++] = field;
}

static void expect_seen(const char *what) {
    if (fingerprint() == usual)
        fail_msg("%s is changed, but the fingerprint is not", what);
}

static void expect_unseen(const char *what) {
    if (fingerprint() != usual)
        fail_msg("%s decides no pixel, but it changes the fingerprint", what);
}

/* The last bit of each of so many numbers. */
static void change_numbers(const HdField *field, void *place, size_t count, size_t size) {
    unsigned char *bytes = place;
    for (size_t i = 0; i < count; i++) {
        bytes[i * size] ^= 1;
        expect_seen(field->key);
        bytes[i * size] ^= 1;
    }
    note_changed(field);
}

static void change_object(const HdObjectType *type, void *owner);

static void change_path(const HdField *field, HdPath *path) {
    path->is_fixed = !path->is_fixed;
    expect_seen(field->key);
    path->is_fixed = !path->is_fixed;
    if (path->is_fixed)
        change_numbers(field, &path->point, 3, sizeof(double));
    else
        change_object(field->object, path);
    note_changed(field);
}

static int *count_of(const HdField *field, void *owner) {
    return (int *)(void *)((char *)owner + field->count_offset);
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

/* Whether it has a value of its own. */
static bool has_value(const HdField *field) {
    return field->type != HD_FIELD_OBJECT && field->type != HD_FIELD_MATERIAL &&
           field->type != HD_FIELD_MATERIALS && field->type != HD_FIELD_FILE &&
           (field->type != HD_FIELD_CHOICE || field->choices[1].word != NULL);
}

static void change_value(const HdField *field, void *owner) {
    void *place = (char *)owner + field->offset;
    switch (field->type) {
    case HD_FIELD_BOOLEAN:
        change_numbers(field, place, 1, sizeof(bool));
        break;
    case HD_FIELD_CHOICE:
    case HD_FIELD_INTEGER:
        if (has_value(field))
            change_numbers(field, place, 1, sizeof(int));
        break;
    case HD_FIELD_NUMBER:
        change_numbers(field, place, 1, sizeof(double));
        break;
    case HD_FIELD_VECTOR:
    case HD_FIELD_UNSCALED:
    case HD_FIELD_FACTOR:
    case HD_FIELD_SCALE:
        change_numbers(field, place, 3, sizeof(double));
        break;
    case HD_FIELD_VECTORS: {
        const bool is_counted = field->count_offset != 0;
        const int count = is_counted ? *count_of(field, owner) : field->most;
        change_numbers(field, place, (size_t)count * 3, sizeof(double));
        if (is_counted)
            change_numbers(field, count_of(field, owner), 1, sizeof(int));
        break;
    }
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

static bool is_output(const HdField *field) {
    return strcmp(field->key, "output") == 0;
}

static void change_object(const HdObjectType *type, void *owner) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        if (!is_output(field) && (hd_field_is_given(field, owner) || field->zero_is_absent))
            change_value(field, owner);
    }
}

/* Everything that has a value was reached. */
static void expect_all_changed(const HdObjectType *type) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        if (is_output(field))
            continue;
        if (has_value(field) && !is_changed(field))
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
    for (int i = 0; i < 50; i++) {
        *light = hd_vec3(6e11 + 2e9 / 3.0 * i, 1e11 / 7.0 * i / 50, 1e11 / (i + 1));
        const uint64_t before = fingerprint();
        light->y = nextafter(light->y, 1e12);
        assert_true(fingerprint() != before);
    }
    *light = kept;
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
    { #thing, &(thing), sizeof(thing), true }
#define UNSEEN(thing)                                                                              \
    { #thing, &(thing), sizeof(thing), false }

/* Of each of these, one bit of the first byte and one of the last. */
TEST(what_files_hold_changes_it_and_what_lies_beside_does_not) {
    HdScene *scene = &file.scene;
    const struct {
        const char *what;
        void *place;
        size_t size;
        bool is_seen;
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
        UNSEEN(materials[0]),
        UNSEEN(materials[2]),
        UNSEEN(materials[1].name),
        UNSEEN(file.output.style.frames_per_second),
        UNSEEN(file.output.path),
        UNSEEN(file.mesh_entries[0].file),
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        unsigned char *bytes = list[i].place;
        for (size_t k = 0; k<list[i].size; k += list[i].size> 1 ? list[i].size - 1 : 1) {
            bytes[k] ^= 1;
            (list[i].is_seen ? expect_seen : expect_unseen)(list[i].what);
            bytes[k] ^= 1;
        }
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
