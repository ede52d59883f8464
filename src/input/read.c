/* SPDX-License-Identifier: MIT */
#include "input/read.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "input/builtin.h"
#include "input/check.h"
#include "input/fields.h"
#include "input/report.h"

typedef struct NamedMaterial {
    const char *name; /* of the tree */
    HdMaterial material;
    bool is_used;
} NamedMaterial;

typedef struct Reader {
    HdSceneReport report;
    HdError *error;
    HdStatus status;
    NamedMaterial *materials;
    NamedMaterial **by_name; /* the same, sorted once all are read */
    int material_count;
    bool knows_materials; /* otherwise no name of one can be checked */
} Reader;

static void leave_to(Reader *reader, size_t length) {
    reader->report.path[length] = '\0';
}

static void read_object(Reader *reader, const HdObjectType *type, const json_t *json, void *owner);

/* Numbers */

/* Reads a number in the field's range; false, and `out` as it was, where it is none. */
static bool read_number(Reader *reader, const HdField *field, const json_t *value, bool is_part,
                        double *out) {
    const double number = json_number_value(value);
    if (!json_is_number(value) || !hd_field_holds(field, number)) {
        hd_report_field(&reader->report, field, value, is_part);
        return false;
    }
    *out = number;
    return true;
}

/* As in JSON Schema, 3.0 is an integer too. */
static void read_integer(Reader *reader, const HdField *field, const json_t *value, int *out) {
    const double number = json_number_value(value);
    if (!json_is_number(value) || floor(number) != number || !hd_field_holds(field, number))
        hd_report_field(&reader->report, field, value, false);
    else
        *out = (int)number;
}

static void refuse_vector(Reader *reader, const HdField *field, const json_t *value) {
    char number[HD_EXPECTED_SIZE], expected[HD_EXPECTED_SIZE + 32];
    hd_field_expected(field, true, number);
    snprintf(expected, sizeof expected, "three numbers, each %s", number);
    hd_report_value(&reader->report, value, expected);
}

static void read_vector(Reader *reader, const HdField *field, const json_t *value, HdVec3 *out) {
    double parts[3];
    bool is_read = true;
    if (!json_is_array(value) || json_array_size(value) != 3) {
        refuse_vector(reader, field, value);
        return;
    }
    for (size_t i = 0; i < 3; i++) {
        const size_t length = hd_json_path_index(reader->report.path, i);
        is_read &= read_number(reader, field, json_array_get(value, i), true, &parts[i]);
        leave_to(reader, length);
    }
    if (is_read)
        *out = hd_vec3(parts[0], parts[1], parts[2]);
}

/* Whether the value is an array with as many elements as the field may have. */
static bool check_count(Reader *reader, const HdField *field, const json_t *value) {
    char expected[HD_EXPECTED_SIZE];
    const size_t count = json_array_size(value);
    if (!json_is_array(value)) {
        hd_report_field(&reader->report, field, value, false);
        return false;
    }
    if (count >= (size_t)field->least && count <= (size_t)field->most)
        return true;
    hd_field_expected_count(field, expected);
    hd_report(&reader->report, "has %zu elements, expected %s", count, expected);
    return false;
}

static void read_vectors(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    HdVec3 *vectors = (void *)((char *)owner + field->offset);
    const size_t count = json_array_size(value);
    if (!check_count(reader, field, value))
        return;
    for (size_t i = 0; i < count; i++) {
        const size_t length = hd_json_path_index(reader->report.path, i);
        vectors[i] = vectors[0]; /* a default, should it be refused */
        read_vector(reader, field, json_array_get(value, i), &vectors[i]);
        leave_to(reader, length);
    }
    if (field->count_offset != 0)
        *(int *)(void *)((char *)owner + field->count_offset) = (int)count;
}

/* Words */

/* Numbers by their value: 16.0 is 16. A word stands in quotes in the table. */
static bool is_choice(const HdChoice *choice, const json_t *value) {
    const char *word = json_string_value(value);
    if (json_is_number(value))
        return choice->json[0] != '"' && strtod(choice->json, NULL) == json_number_value(value);
    return word != NULL && choice->json[0] == '"' && strlen(choice->json) == strlen(word) + 2 &&
           memcmp(choice->json + 1, word, strlen(word)) == 0;
}

static void read_choice(Reader *reader, const HdField *field, const json_t *value, void *place) {
    const HdChoice *choice = field->choices;
    while (choice->json != NULL && !is_choice(choice, value))
        choice++;
    if (choice->json == NULL)
        hd_report_choice(&reader->report, field, value);
    else if (field->choices[1].json != NULL)
        *(int *)place = choice->value;
}

static void read_text(Reader *reader, const HdField *field, const json_t *value,
                      char out[HD_MAX_PATH]) {
    if (!json_is_string(value) || json_string_length(value) == 0) {
        hd_report_field(&reader->report, field, value, false);
        return;
    }
    if (hd_check_file_name(&reader->report, value))
        memcpy(out, json_string_value(value), json_string_length(value) + 1);
}

/* A relative path counts from the folder of the scene. False where there is no room for it. */
static bool place_file(Reader *reader, char path[HD_MAX_PATH]) {
    const char *folder = reader->report.source->folder;
    if (folder[0] == '\0' || !hd_texture_path_is_relative(path))
        return true;
    const bool has_slash = folder[strlen(folder) - 1] == '/';
    const size_t before = strlen(folder) + !has_slash, length = before + strlen(path);
    if (length >= HD_MAX_PATH) {
        hd_report(&reader->report, "has %zu bytes with the scene's folder, expected fewer than %d",
                  length, HD_MAX_PATH);
        return false;
    }
    memmove(path + before, path, strlen(path) + 1);
    memcpy(path, folder, strlen(folder));
    path[before - 1] = '/';
    return true;
}

static void *allocate(Reader *reader, size_t count, size_t size) {
    void *memory = calloc(count, size);
    if (memory == NULL)
        reader->status = hd_fail(reader->error, HD_FAILED, "out of memory: no room for the scene");
    return memory;
}

static void read_file(Reader *reader, const HdField *field, const json_t *value, char **out) {
    char path[HD_MAX_PATH] = "";
    read_text(reader, field, value, path);
    if (path[0] == '\0' || !place_file(reader, path))
        return;
    *out = allocate(reader, strlen(path) + 1, 1);
    if (*out != NULL)
        memcpy(*out, path, strlen(path) + 1);
}

/* One number is the same for every axis. */
static void read_scale(Reader *reader, const HdField *field, const json_t *value, HdVec3 *out) {
    double number = 1.0;
    if (json_is_array(value) && json_array_size(value) == 3)
        read_vector(reader, field, value, out);
    else if (!json_is_number(value))
        hd_report_field(&reader->report, field, value, false);
    else if (read_number(reader, field, value, true, &number))
        *out = hd_vec3(number, number, number);
}

static int compare_names(const void *a, const void *b) {
    return strcmp((*(NamedMaterial *const *)a)->name, (*(NamedMaterial *const *)b)->name);
}

static NamedMaterial *find_material(const Reader *reader, const char *name) {
    NamedMaterial wanted = {.name = name}, *key = &wanted;
    NamedMaterial **found = reader->by_name == NULL
                                ? NULL
                                : bsearch(&key, reader->by_name, (size_t)reader->material_count,
                                          sizeof(NamedMaterial *), compare_names);
    return found != NULL ? *found : NULL;
}

/* Looking for what may be meant takes long among many names, and is for readers. */
static void report_unknown_material(Reader *reader, const HdField *field, const json_t *value) {
    HdNearest nearest = {.word = json_string_value(value)};
    for (int i = 0; i < reader->material_count; i++)
        if (!hd_problems_are_full(reader->report.problems))
            hd_nearest_offer(&nearest, reader->materials[i].name);
    if (nearest.name == NULL)
        hd_report_field(&reader->report, field, value, false);
    else
        hd_report_mistaken(&reader->report, value, nearest.name);
}

static void read_material(Reader *reader, const HdField *field, const json_t *value,
                          HdMaterial *out) {
    const char *name = json_string_value(value);
    if (name == NULL) {
        hd_report_field(&reader->report, field, value, false);
        return;
    }
    NamedMaterial *named = find_material(reader, name);
    if (named != NULL) {
        *out = named->material;
        named->is_used = true;
    } else if (reader->knows_materials) {
        report_unknown_material(reader, field, value);
    }
}

/* Objects */

static void read_path(Reader *reader, const HdField *field, const json_t *value, HdPath *out) {
    if (json_is_array(value)) {
        read_vector(reader, field, value, &out->point);
    } else if (json_is_object(value)) {
        *out = (HdPath){.is_fixed = false};
        read_object(reader, field->object, value, out);
    } else {
        hd_report_field(&reader->report, field, value, false);
    }
}

static void read_list(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    const size_t count = json_array_size(value), size = field->object->size;
    if (!check_count(reader, field, value) || count == 0)
        return;
    char *elements = allocate(reader, count, size);
    if (elements == NULL)
        return;
    *(int *)(void *)((char *)owner + field->count_offset) = (int)count;
    memcpy((char *)owner + field->offset, &elements, sizeof elements);
    for (size_t i = 0; i < count; i++) {
        const size_t length = hd_json_path_index(reader->report.path, i);
        read_object(reader, field->object, json_array_get(value, i), elements + i * size);
        leave_to(reader, length);
    }
}

/* With one of the two given there is an inner side; the other is as outside. */
static void settle_inner_side(HdMaterial *material, const json_t *json) {
    const bool reflects = json_object_get(json, "inner_reflection") != NULL;
    const bool transmits = json_object_get(json, "inner_transmission") != NULL;
    material->has_inner_side = reflects || transmits;
    if (transmits && !reflects)
        material->inner_reflection = material->reflection;
    if (reflects && !transmits)
        material->inner_transmission = material->transmission;
}

/* Here, so that the message names the material and comes once; what is wrong is set aside, lest the
   check of the scene tells it again for each solid. */
static void check_shares(Reader *reader, HdMaterial *material) {
    char place[HD_JSON_PATH_SIZE + 2];
    const int before = reader->report.problems->count;
    snprintf(place, sizeof place, "%s: ", reader->report.path);
    hd_material_check(material, place, reader->report.problems);
    if (reader->report.problems->count != before)
        material->reflection = material->inner_reflection = 0.0;
}

/* None where there is no room, which the reader's status then tells. */
static void sort_materials(Reader *reader) {
    const size_t count = (size_t)reader->material_count;
    reader->by_name = allocate(reader, count + 1, sizeof(NamedMaterial *));
    if (reader->by_name == NULL)
        return;
    for (size_t i = 0; i < count; i++)
        reader->by_name[i] = &reader->materials[i];
    qsort(reader->by_name, count, sizeof(NamedMaterial *), compare_names);
}

static void read_materials(Reader *reader, const HdField *field, const json_t *value) {
    const size_t count = json_object_size(value);
    const char *name;
    json_t *json;
    if (!json_is_object(value)) {
        hd_report_field(&reader->report, field, value, false);
        return;
    }
    if (count > (size_t)field->most) {
        hd_report(&reader->report, "has %zu materials, expected at most %d", count, field->most);
        return;
    }
    reader->knows_materials = true;
    reader->materials = allocate(reader, count + 1, sizeof *reader->materials);
    if (reader->materials == NULL)
        return;
    json_object_foreach((json_t *)value, name, json) {
        NamedMaterial *named = &reader->materials[reader->material_count++];
        named->name = name;
        const size_t length = hd_json_path_key(reader->report.path, name);
        read_object(reader, field->object, json, &named->material);
        settle_inner_side(&named->material, json);
        check_shares(reader, &named->material);
        leave_to(reader, length);
    }
    sort_materials(reader);
}

static void read_field(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    void *place = (char *)owner + field->offset;
    double factor = 1.0;
    switch (field->type) {
    case HD_FIELD_BOOLEAN:
        if (json_is_boolean(value))
            *(bool *)place = json_is_true(value);
        else
            hd_report_field(&reader->report, field, value, false);
        break;
    case HD_FIELD_INTEGER:
        read_integer(reader, field, value, place);
        break;
    case HD_FIELD_NUMBER:
        read_number(reader, field, value, false, place);
        break;
    case HD_FIELD_FACTOR:
        if (read_number(reader, field, value, false, &factor))
            *(HdVec3 *)place = hd_scale(*(const HdVec3 *)place, factor);
        break;
    case HD_FIELD_VECTOR:
    case HD_FIELD_UNSCALED:
        read_vector(reader, field, value, place);
        break;
    case HD_FIELD_VECTORS:
        read_vectors(reader, field, value, owner);
        break;
    case HD_FIELD_CHOICE:
        read_choice(reader, field, value, place);
        break;
    case HD_FIELD_SCALE:
        read_scale(reader, field, value, place);
        break;
    case HD_FIELD_TEXT:
        read_text(reader, field, value, place);
        break;
    case HD_FIELD_FILE:
        read_file(reader, field, value, place);
        break;
    case HD_FIELD_MATERIAL:
        read_material(reader, field, value, place);
        break;
    case HD_FIELD_PATH:
        read_path(reader, field, value, place);
        break;
    case HD_FIELD_OBJECT:
        read_object(reader, field->object, value, place);
        break;
    case HD_FIELD_LIST:
        read_list(reader, field, value, owner);
        break;
    case HD_FIELD_MATERIALS:
        read_materials(reader, field, value);
        break;
    }
}

static void reset_object(const HdObjectType *type, void *owner) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        hd_field_reset(field, owner);
        if (field->type == HD_FIELD_OBJECT && field->is_given == NULL)
            reset_object(field->object, (char *)owner + field->offset);
        if (field->type == HD_FIELD_MATERIAL)
            reset_object(&hd_material_fields, (char *)owner + field->offset);
    }
}

/* The value of the field, if it is there and may be. */
static const json_t *find_value(Reader *reader, const HdField *field, const json_t *json) {
    char expected[HD_EXPECTED_SIZE];
    const json_t *value = json_object_get(json, field->key);
    if (value == NULL && field->required) {
        hd_field_expected(field, false, expected);
        hd_report(&reader->report, "is missing, expected %s", expected);
    }
    if (value != NULL && field->instead_of != NULL &&
        json_object_get(json, field->instead_of) != NULL) {
        hd_report(&reader->report, "is given beside \"%s\", expected only one of them",
                  field->instead_of);
        return NULL;
    }
    return value;
}

static void read_object(Reader *reader, const HdObjectType *type, const json_t *json, void *owner) {
    reset_object(type, owner);
    if (!json_is_object(json)) {
        hd_report_value(&reader->report, json, "an object");
        return;
    }
    for (int i = 0; i < type->field_count && reader->status == HD_OK; i++) {
        const HdField *field = &type->fields[i];
        const size_t length = hd_json_path_key(reader->report.path, field->key);
        const json_t *value = find_value(reader, field, json);
        if (value != NULL && field->flag_offset != 0)
            *(bool *)(void *)((char *)owner + field->flag_offset) = true;
        if (value != NULL)
            read_field(reader, field, value, owner);
        leave_to(reader, length);
    }
    hd_report_unknown_keys(&reader->report, type, json);
}

/* The scene */

/* Where a value is refused, its default must not make other values look wrong. */
static void set_wrong_parts_aside(const Reader *reader, HdSceneFile *file) {
    const HdObjectType *camera = hd_field(&hd_scene_fields, "camera")->object;
    HdScene *scene = &file->scene;
    bool is_any_wrong = false;
    if (reader->report.is_view_wrong) {
        hd_field_reset(hd_field(camera, "eye"), scene);
        hd_field_reset(hd_field(camera, "target"), scene);
    }
    if (reader->report.is_floor_wrong)
        scene->floor.present = false;
    for (int i = 0; i < scene->solid_count; i++)
        if (reader->report.is_solid_wrong[i]) {
            scene->solids[i].rim_width = 0.0;
            is_any_wrong = true;
        }
    /* Only refracting solids must keep clear of others. */
    for (int i = 0; i < scene->solid_count && is_any_wrong; i++)
        scene->solids[i].face.index_of_refraction = 1.0;
}

static void note_unused_materials(const Reader *reader, HdProblems *notes) {
    char path[HD_JSON_PATH_SIZE];
    for (int i = 0; i < reader->material_count; i++) {
        snprintf(path, sizeof path, "materials");
        hd_json_path_key(path, reader->materials[i].name);
        if (!reader->materials[i].is_used)
            hd_problem(notes, "%s is used nowhere", path);
    }
}

HdStatus hd_scene_from_json(HdSceneFile *file, const json_t *root, const HdSceneSource *source,
                            HdProblems *problems, HdError *error) {
    Reader reader = {
        .report = {.source = source, .problems = problems}, .error = error, .status = HD_OK};
    reader.knows_materials = json_object_get(root, "materials") == NULL;
    read_object(&reader, &hd_scene_fields, root, file);
    file->scene.floor.present = json_is_object(json_object_get(root, "floor"));
    snprintf(reader.report.path, sizeof reader.report.path, "floor.texture.file");
    if (!hd_check_texture_path(&reader.report, file->texture_path) ||
        !place_file(&reader, file->texture_path))
        file->texture_path[0] = '\0';
    snprintf(reader.report.path, sizeof reader.report.path, "output.path");
    hd_check_output_path(&reader.report, file->output.path);
    if (source->notes != NULL)
        note_unused_materials(&reader, source->notes);
    free(reader.by_name);
    free(reader.materials);
    if (reader.status != HD_OK)
        return reader.status;
    set_wrong_parts_aside(&reader, file);
    if (json_is_object(root))
        hd_scene_check(&file->scene, HD_NAMING_JSON, problems);
    return HD_OK;
}
