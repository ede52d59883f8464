/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "input/scene_file.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "image/picture.h"
#include "input/check.h"
#include "input/classic.h"
#include "input/fields.h"
#include "input/files.h"
#include "input/json.h"
#include "input/report.h"
#include "system/path.h"

typedef struct NamedMaterial {
    const char *name; /* name in the tree */
    HdMaterial material;
    bool is_used;
} NamedMaterial;

typedef struct Reader {
    HdSceneReport report;
    HdError *error;
    HdStatus status;
    NamedMaterial *materials;
    json_t *numbers; /* number of each material by name, once all are read */
    int material_count;
    bool knows_materials; /* validity of the list; if false, names are not checked */
} Reader;

static void truncate_path(Reader *reader, size_t length) {
    reader->report.path[length] = '\0';
}

static void *place_of(const HdField *field, void *owner) {
    return (char *)owner + field->offset;
}

static void read_object(Reader *reader, const HdObjectType *type, const json_t *json, void *owner);

/* Numbers */

/* Reads the value's numbers into `out`. If the value is not what the field expects, reports it,
   leaves `out` unchanged and returns false. */
typedef bool ReadNumbers(Reader *reader, const HdField *field, const json_t *value, double *out);

static bool refuse(Reader *reader, const HdField *field, const json_t *value, int parts) {
    hd_report_field(&reader->report, field, value, parts);
    return false;
}

static bool is_in_range(const HdField *field, const json_t *value) {
    return json_is_number(value) && hd_field_holds(field, json_number_value(value));
}

static bool read_boolean(Reader *reader, const HdField *field, const json_t *value, double *out) {
    if (!json_is_boolean(value))
        return refuse(reader, field, value, 0);
    *out = json_is_true(value) ? 1.0 : 0.0;
    return true;
}

static bool read_number(Reader *reader, const HdField *field, const json_t *value, double *out) {
    const double number = json_number_value(value);
    /* As in JSON Schema, 3.0 is an integer too. */
    const bool is_whole = field->type != HD_FIELD_INTEGER || floor(number) == number;
    if (!is_in_range(field, value) || !is_whole)
        return refuse(reader, field, value, 0);
    *out = number;
    return true;
}

static bool read_vector(Reader *reader, const HdField *field, const json_t *value, double *out) {
    double parts[3];
    bool is_read = true;
    if (json_array_size(value) != 3)
        return refuse(reader, field, value, 3);
    for (size_t i = 0; i < 3; i++) {
        const size_t length = hd_json_path_index(reader->report.path, i);
        const json_t *part = json_array_get(value, i);
        parts[i] = json_number_value(part);
        if (!is_in_range(field, part))
            is_read = refuse(reader, field, part, 1);
        truncate_path(reader, length);
    }
    if (is_read)
        memcpy(out, parts, sizeof parts);
    return is_read;
}

/* Reads an integer n, or "n000/1001", which sets the second number. */
static bool read_rate(Reader *reader, const HdField *field, const json_t *value, double *out) {
    const char *text = json_string_value(value);
    char *end = NULL;
    const double number = json_number_value(value);
    const long top = text != NULL && text[0] >= '1' && text[0] <= '9' ? strtol(text, &end, 10) : 0;
    const bool is_ntsc = end != NULL && strcmp(end, "/1001") == 0 && top % 1000 == 0;
    const double frames = is_ntsc ? (double)top / 1000.0 : floor(number);
    if ((!is_ntsc && frames != number) || !hd_field_holds(field, frames))
        return refuse(reader, field, value, 0);
    out[0] = frames;
    out[1] = is_ntsc ? 1.0 : 0.0;
    return true;
}

/* Reads a vector or one number for every axis. */
static bool read_scale(Reader *reader, const HdField *field, const json_t *value, double *out) {
    if (json_array_size(value) == 3)
        return read_vector(reader, field, value, out);
    if (!is_in_range(field, value))
        return refuse(reader, field, value, json_is_number(value) ? 1 : 0);
    out[0] = out[1] = out[2] = json_number_value(value);
    return true;
}

/* Compares numbers by value: 16.0 is 16. */
static bool is_choice(const char *choice, const json_t *value) {
    const char *word = json_string_value(value);
    if (hd_choice_is_number(choice))
        return json_is_number(value) && strtod(choice, NULL) == json_number_value(value);
    return word != NULL && strcmp(word, choice) == 0;
}

static bool read_choice(Reader *reader, const HdField *field, const json_t *value, double *out) {
    const HdChoice *choice = field->choices;
    while (choice->word != NULL && !is_choice(choice->word, value))
        choice++;
    if (choice->word == NULL)
        hd_report_choice(&reader->report, field, value);
    else
        *out = choice->value;
    return choice->word != NULL;
}

static void read_numbers(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    static ReadNumbers *const of_type[] = {
        [HD_FIELD_BOOLEAN] = read_boolean, [HD_FIELD_INTEGER] = read_number,
        [HD_FIELD_NUMBER] = read_number,   [HD_FIELD_FACTOR] = read_number,
        [HD_FIELD_VECTOR] = read_vector,   [HD_FIELD_UNSCALED] = read_vector,
        [HD_FIELD_PATH] = read_vector,     [HD_FIELD_SCALE] = read_scale,
        [HD_FIELD_CHOICE] = read_choice,   [HD_FIELD_RATE] = read_rate};
    double numbers[3] = {0.0, 0.0, 0.0};
    if (of_type[field->type](reader, field, value, numbers))
        hd_field_set(field, owner, numbers);
}

/* Lists */

/* Returns whether the value is an array with a valid element count. */
static bool check_count(Reader *reader, const HdField *field, const json_t *value) {
    char expected[HD_EXPECTED_SIZE];
    const size_t count = json_array_size(value);
    if (!json_is_array(value))
        return refuse(reader, field, value, 0);
    if (count >= (size_t)field->least && count <= (size_t)field->most)
        return true;
    hd_field_expected_count(field, expected);
    hd_report(&reader->report, "has %zu elements, expected %s", count, expected);
    return false;
}

static void read_vectors(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    HdVec3 *vectors = place_of(field, owner);
    const size_t count = json_array_size(value);
    if (!check_count(reader, field, value))
        return;
    for (size_t i = 0; i < count; i++) {
        const size_t length = hd_json_path_index(reader->report.path, i);
        double parts[3] = {vectors[0].x, vectors[0].y,
                           vectors[0].z}; /* used if the value is rejected */
        read_vector(reader, field, json_array_get(value, i), parts);
        vectors[i] = hd_vec3(parts[0], parts[1], parts[2]);
        truncate_path(reader, length);
    }
    if (field->count_offset != 0)
        *(int *)(void *)((char *)owner + field->count_offset) = (int)count;
}

/* Words */

/* Accepts fewer than HD_MAX_PATH bytes without control characters. */
static bool check_file_name(HdSceneReport *report, const json_t *value) {
    const size_t length = json_string_length(value);
    if (length >= HD_MAX_PATH) {
        hd_report(report, "has %zu bytes, expected fewer than %d", length, HD_MAX_PATH);
        return false;
    }
    for (const char *c = json_string_value(value); *c != '\0'; c++)
        if (hd_control_bytes(c) > 0) {
            hd_report_value(report, value, "a name without control characters");
            return false;
        }
    return true;
}

static void copy_text(Reader *reader, const HdField *field, const json_t *value,
                      char out[HD_MAX_PATH]) {
    if (json_string_length(value) == 0)
        refuse(reader, field, value, 0);
    else if (check_file_name(&reader->report, value))
        memcpy(out, json_string_value(value), json_string_length(value) + 1);
}

static void read_text(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    copy_text(reader, field, value, place_of(field, owner));
}

/* Makes a relative path start at the scene's folder. Returns false if it gets too long. */
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

static void fail_memory(Reader *reader) {
    reader->status = HD_NO_ROOM(reader->error, "the scene");
}

static void *allocate(Reader *reader, size_t count, size_t size) {
    void *memory = calloc(count, size);
    if (memory == NULL)
        fail_memory(reader);
    return memory;
}

static void read_file(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    char path[HD_MAX_PATH] = "", **out = place_of(field, owner);
    copy_text(reader, field, value, path);
    if (path[0] == '\0' || !place_file(reader, path))
        return;
    *out = strdup(path);
    if (*out == NULL)
        fail_memory(reader);
}

/* Returns the material's number, or -1. */
static int find_material(const Reader *reader, const char *name) {
    const json_t *number = json_object_get(reader->numbers, name);
    return number != NULL ? (int)json_integer_value(number) : -1;
}

/* Skips the costly search for similar names if no reader needs it. */
static void report_unknown_material(Reader *reader, const HdField *field, const json_t *value) {
    HdNearest nearest = {.word = json_string_value(value)};
    for (int i = 0; i < reader->material_count; i++)
        if (!hd_problems_are_full(reader->report.problems))
            hd_nearest_offer(&nearest, reader->materials[i].name);
    if (nearest.name != NULL) {
        hd_report_mistaken(&reader->report, value, nearest.name);
        return;
    }
    char expected[HD_EXPECTED_SIZE + HD_KEYS_SIZE], names[HD_KEYS_SIZE];
    hd_json_list_keys(reader->numbers, names);
    hd_field_expected(field, 0, expected);
    hd_add_text(expected, sizeof expected, "", "%s%s", names[0] != '\0' ? ": " : "; there are none",
                names);
    hd_report_value(&reader->report, value, expected);
}

static void read_material(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    const char *name = json_string_value(value);
    const int number = name != NULL ? find_material(reader, name) : -1;
    if (number >= 0) {
        *(HdMaterial *)place_of(field, owner) = reader->materials[number].material;
        reader->materials[number].is_used = true;
    } else if (name == NULL) {
        refuse(reader, field, value, 0);
    } else if (reader->knows_materials) {
        report_unknown_material(reader, field, value);
    }
}

/* Objects */

static void read_part(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    read_object(reader, field->object, value, place_of(field, owner));
}

static void read_path(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    if (json_is_object(value)) {
        *(HdPath *)place_of(field, owner) = (HdPath){.is_fixed = false};
        read_part(reader, field, value, owner);
    } else if (json_is_array(value)) {
        read_numbers(reader, field, value, owner);
    } else {
        refuse(reader, field, value, 0);
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
        truncate_path(reader, length);
    }
}

/* If one of the two is given, there is an inner side; the other one is as outside. */
static void settle_inner_side(HdMaterial *material, const json_t *json) {
    const bool reflects = json_object_get(json, "inner_reflection") != NULL;
    const bool transmits = json_object_get(json, "inner_transmission") != NULL;
    if (transmits && !reflects)
        material->inner_reflection = material->reflection;
    if (reflects && !transmits)
        material->inner_transmission = material->transmission;
}

/* Checks shares here, so that one message names the material. Clears wrong values, or the scene's
   check would report them again for each solid. */
static void check_shares(Reader *reader, HdMaterial *material) {
    HdSceneChecker checker = {.problems = reader->report.problems};
    const int before = checker.problems->count;
    snprintf(checker.place, sizeof checker.place, "%s: ", reader->report.path);
    hd_check_material(&checker, material, true);
    if (checker.problems->count != before)
        material->reflection = material->inner_reflection = 0.0;
}

static void read_materials(Reader *reader, const HdField *field, const json_t *value,
                           void *unused) {
    const size_t count = json_object_size(value);
    const char *name;
    json_t *json;
    (void)unused;
    if (!json_is_object(value)) {
        refuse(reader, field, value, 0);
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
        truncate_path(reader, length);
    }
    reader->numbers = json_object();
    for (int i = 0; i < reader->material_count; i++)
        if (json_object_set_new(reader->numbers, reader->materials[i].name, json_integer(i)) != 0)
            fail_memory(reader);
}

typedef void ReadField(Reader *reader, const HdField *field, const json_t *value, void *owner);

static void read_field(Reader *reader, const HdField *field, const json_t *value, void *owner) {
    static ReadField *const of_type[HD_FIELD_MATERIALS + 1] = {
        [HD_FIELD_VECTORS] = read_vectors, [HD_FIELD_TEXT] = read_text,
        [HD_FIELD_FILE] = read_file,       [HD_FIELD_MATERIAL] = read_material,
        [HD_FIELD_PATH] = read_path,       [HD_FIELD_OBJECT] = read_part,
        [HD_FIELD_LIST] = read_list,       [HD_FIELD_MATERIALS] = read_materials};
    ReadField *read = of_type[field->type];
    (read != NULL ? read : read_numbers)(reader, field, value, owner);
}

static void reset_object(const HdObjectType *type, void *owner) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        hd_field_set(field, owner, field->standard);
        if (field->type == HD_FIELD_OBJECT && !hd_field_may_be_absent(field))
            reset_object(field->object, (char *)owner + field->offset);
        if (field->type == HD_FIELD_MATERIAL)
            reset_object(&hd_material_fields, (char *)owner + field->offset);
    }
}

/* Returns the field's value if it is present and allowed. */
static const json_t *find_value(Reader *reader, const HdField *field, const json_t *json) {
    char expected[HD_EXPECTED_SIZE];
    const json_t *value = json_object_get(json, field->key);
    if (value == NULL && field->required) {
        hd_field_expected(field, 0, expected);
        hd_report(&reader->report, "is missing, expected %s", expected);
    }
    if (value != NULL && field->instead_of != NULL &&
        json_object_get(json, field->instead_of) != NULL) {
        hd_report(&reader->report, "is given together with \"%s\", expected only one of them",
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
        truncate_path(reader, length);
    }
    hd_report_unknown_keys(&reader->report, type, json);
}

/* The scene */

/* Checks that an output path is empty, or has a known ending and a number only if allowed. */
static void check_output_path(HdSceneReport *report, const char *path) {
    char quoted[HD_WORDS_SIZE], name[HD_MAX_PATH];
    HdError error;
    if (path[0] == '\0')
        return;
    hd_quoted(path, quoted);
    const HdFormat *format = hd_format_of(path);
    if (format == NULL)
        hd_report(report,
                  "is %s, expected the name of a film (" HD_FILM_ENDINGS
                  ") or of a picture (" HD_PICTURE_ENDINGS ")",
                  quoted);
    else if (hd_format_is_film(format) && hd_pattern_has_directive(path))
        hd_report(report,
                  "is %s, expected a film without a number (%%d) in its name, or pictures "
                  "(" HD_PICTURE_ENDINGS ")",
                  quoted);
    else if (!hd_format_is_film(format) &&
             (hd_pattern_has_number(path) ? hd_pattern_check(path, &error)
                                          : hd_pattern_format_single(path, name, &error)) != HD_OK)
        hd_report(report, "cannot be used: %s", error.message);
}

/* Checks that a texture path, if any, uses only formats of this build. */
static bool check_texture_path(HdSceneReport *report, const char *path) {
    static const char built_in[] = "builtin:";
    char quoted[HD_WORDS_SIZE];
    if (strncmp(path, built_in, strlen(built_in)) != 0 || strcmp(path, HD_BUILTIN_TEXTURE) == 0)
        return true;
    hd_quoted(path, quoted);
    hd_report(report, "is %s, which is unknown, expected \"" HD_BUILTIN_TEXTURE "\" or a file",
              quoted);
    return false;
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

static void read_scene(Reader *reader, HdSceneFile *file, const json_t *root) {
    HdSceneReport *report = &reader->report;
    reader->knows_materials = json_object_get(root, "materials") == NULL;
    read_object(reader, &hd_scene_fields, root, file);
    snprintf(report->path, sizeof report->path, "floor.texture.file");
    if (!check_texture_path(report, file->texture_path) || !place_file(reader, file->texture_path))
        file->texture_path[0] = '\0';
    snprintf(report->path, sizeof report->path, "output.path");
    check_output_path(report, file->output.path);
    if (report->source->notes != NULL)
        note_unused_materials(reader, report->source->notes);
    json_decref(reader->numbers);
    free(reader->materials);
}

/* Fills `file`, which must be empty, and adds all problems to `problems`: first values that the
   table of fields rejects, which keep their defaults, then conflicts between the others. Fails only
   if memory is short. */
static HdStatus read_and_check(HdSceneFile *file, const json_t *root, const HdSceneSource *source,
                               HdProblems *problems, HdError *error) {
    HdSceneChecker checker = {.problems = problems, .naming = HD_NAMING_JSON};
    Reader reader = {.report = {.source = source, .problems = problems, .checker = &checker},
                     .error = error};
    read_scene(&reader, file, root);
    if (reader.status == HD_OK && json_is_object(root))
        hd_check_scene(&checker, &file->scene);
    return reader.status;
}

static HdStatus fail_syntax(const json_error_t *found, const char *text_read, size_t size,
                            const char *name, HdError *error) {
    char text[JSON_ERROR_TEXT_LENGTH * 2];
    hd_escape(found->text, text, sizeof text);
    const size_t used = strlen(text);
    if (json_error_code(found) == json_error_out_of_memory)
        return hd_fail(error, HD_FAILED, "%s: out of memory: no room for the scene", name);
    if (json_error_code(found) == json_error_null_character)
        snprintf(text, sizeof text, "a string has the character \\u0000, expected text without it");
    if (json_error_code(found) == json_error_numeric_overflow)
        snprintf(text + used, sizeof text - used, ", expected a number that a double can hold");
    const bool is_inside = found->position >= 0 && (size_t)found->position <= size;
    const char *hint = is_inside ? hd_json_hint(text_read, (size_t)found->position) : NULL;
    return hd_fail(error, HD_BAD_INPUT, "%s:%d:%d: %s%s%s", name, found->line, found->column, text,
                   hint != NULL ? "; " : "", hint != NULL ? hint : "");
}

static bool is_mesh(const char *name) {
    static const char *const endings[] = {".obj", ".stl", ".ply", ".gltf", ".glb"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (hd_path_has_ending(name, endings[i]))
            return true;
    return false;
}

/* Returns whether the text looks like a scene. Messages quote it, and a file that is no scene may
   be private. */
static bool may_be_scene(const char *text, size_t size, const char *name) {
    size_t start = 0;
    while (start < size && strchr(" \t\r\n", text[start]) != NULL)
        start++;
    return hd_path_has_ending(name, ".json") || start == size || text[start] == '{';
}

static HdStatus check_text(const char *text, size_t size, const char *name, HdError *error) {
    if (size > HD_MAX_SCENE_BYTES)
        return hd_fail(error, HD_BAD_INPUT, "%s has %zu bytes, expected at most %d", name, size,
                       (int)HD_MAX_SCENE_BYTES);
    if (is_mesh(name))
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is a mesh by its ending, expected a scene; see "
                       "\"meshes\" in 'hedron help scene'",
                       name);
    if (size == 0)
        return hd_fail(error, HD_BAD_INPUT, "%s is empty, expected a scene in JSON", name);
    /* JSON text has no zero bytes, and the parser takes one for the end of a token. */
    const char *zero = memchr(text, 0, size);
    if (zero != NULL)
        return hd_json_fail_at(text, (size_t)(zero - text), name,
                               "there is a zero byte, expected JSON text", error);
    if (hd_classic_may_be(text, size))
        return hd_fail(error, HD_BAD_INPUT,
                       "%s: this looks like a classic input, which 'hedron convert FILE -o "
                       "scene.json' converts to a scene",
                       name);
    if (!may_be_scene(text, size, name))
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is not a scene: expected the ending .json or text that begins with {",
                       name);
    return hd_json_check_count(text, size, name, error);
}

static HdStatus parse_json(json_t **root, const char *text, size_t size, const char *name,
                           HdError *error) {
    static const char mark[] = "\xef\xbb\xbf"; /* the byte order mark of UTF-8 */
    json_error_t found;
    if (size >= strlen(mark) && memcmp(text, mark, strlen(mark)) == 0) {
        text += strlen(mark);
        size -= strlen(mark);
    }
    HD_TRY(check_text(text, size, name, error));
    *root = json_loadb(text, size, HD_JSON_FLAGS, &found);
    return *root != NULL ? HD_OK : fail_syntax(&found, text, size, name, error);
}

/* Loads the files; only lack of memory and a signal are failures of its own. */
static HdStatus load_files(HdSceneFile *file, const HdSceneSource *source, HdProblems *problems,
                           HdError *error) {
    static const struct {
        const char *path;
        HdStatus (*load)(HdSceneFile *file, HdProblems *notes, HdError *error);
    } pictures[] = {{"floor.texture.file", hd_scene_file_load_texture},
                    {"environment.file", hd_scene_file_load_environment}};
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++) {
        const HdStatus status = pictures[i].load(file, source->file_notes, error);
        if (status == HD_BAD_INPUT)
            hd_problem(problems, "%s: %s", pictures[i].path, error->message);
        else if (status != HD_OK)
            return status;
    }
    return hd_scene_file_load_meshes(file, problems, source->file_notes, error);
}

/* Checks the whole sequence against the output; a rendering may override either. */
static void check_output(const HdSceneFile *file, HdProblems *problems) {
    const char *path = file->output.path;
    HdError error;
    if (hd_format_check_style(path, &file->output.style.picture, &error) != HD_OK)
        hd_problem(problems, "output.path: %s", error.message);
    if (path[0] == '\0' || file->scene.frame_count == 1 || hd_format_is_film(hd_format_of(path)) ||
        hd_pattern_has_number(path))
        return;
    hd_problem(problems,
               "output.path is \"%s\", which names one picture, but camera.frames is %d, expected "
               "#### in the name, or a film",
               path, file->scene.frame_count);
}

static void note_seldom_meant(const HdSceneFile *file, HdProblems *notes) {
    const int bits = file->output.style.picture.bits;
    hd_scene_notes(&file->scene, notes);
    if (bits > 8 && hd_format_is_film(hd_format_of(file->output.path)))
        hd_problem(notes,
                   "output.bits is %d, but output.path is a film, which has 8 bits a channel",
                   bits);
    if (file->output.style.picture.has_alpha && file->output.path[0] != '\0' &&
        !hd_format_has_alpha(hd_format_of(file->output.path)))
        hd_problem(notes,
                   "output.alpha is true, but output.path is neither PNG nor OpenEXR, which alone "
                   "have alpha");
    if (file->output.style.picture.has_alpha && file->scene.environment.file != NULL)
        hd_problem(notes, "output.alpha is true, but only background is taken out of colours: "
                          "environment remains at the borders of objects");
}

static HdStatus build(HdSceneFile *file, json_t *root, const HdSceneSource *source,
                      HdError *error) {
    HdProblems problems = {.count = 0};
    for (int i = 0; i < source->change_count; i++)
        hd_scene_change_apply(root, source->changes[i], &problems);
    HD_TRY(read_and_check(file, root, source, &problems, error));
    file->is_strict = source->is_strict;
    if (source->loads_files)
        HD_TRY(load_files(file, source, &problems, error));
    if (source->notes != NULL)
        check_output(file, &problems);
    HD_TRY(hd_problems_status(&problems, source->name, error));
    if (source->notes != NULL)
        note_seldom_meant(file, source->notes);
    return HD_OK;
}

HdStatus hd_scene_file_parse(HdSceneFile *file, const char *text, size_t size,
                             const HdSceneSource *source, HdError *error) {
    json_t *root = NULL;
    *file = (HdSceneFile){.schema = ""};
    hd_json_memory_watch();
    HdStatus status = parse_json(&root, text, size, source->name, error);
    if (status == HD_OK)
        status = build(file, root, source, error);
    json_decref(root);
    if (status == HD_BAD_INPUT && hd_json_memory_failed())
        status =
            hd_fail(error, HD_FAILED, "%s: out of memory: no room for the scene", source->name);
    if (status != HD_OK)
        hd_scene_file_free(file);
    return status;
}

HdStatus hd_scene_file_read(HdSceneFile *file, const char *path, const HdSceneSource *source,
                            HdError *error) {
    char folder[HD_MAX_PATH] = "";
    unsigned char *bytes = NULL;
    size_t size = 0;
    HdSceneSource placed = *source;
    *file = (HdSceneFile){.schema = ""};
    const char *slash = strrchr(path, '/');
    HD_TRY(hd_file_read(path, "scene", HD_MAX_SCENE_BYTES, &bytes, &size, error));
    if (slash != NULL)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - path) + 1, path);
    placed.name = path;
    placed.folder = folder;
    const HdStatus status = hd_scene_file_parse(file, (const char *)bytes, size, &placed, error);
    free(bytes);
    return status;
}
