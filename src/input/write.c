/* SPDX-License-Identifier: MIT */
/* Writes field by field of the table; omits defaults unless an object is complete. */
#include "input/write.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/text.h"

/* JSON for people: an indent of 2, and the three numbers of a vector on one line. jansson, which
   prints JSON for programs (statistics, devices), would put each number on a line of its own. */

/* A printer with either a stream or a hash, which it continues over the text. */
typedef struct Printer {
    FILE *out; /* NULL: print nothing */
    uint64_t hash;
    int depth;
    bool has_elements; /* elements in the innermost object or array */
    bool has_key;      /* next value's key is written */
} Printer;

static void put_text(Printer *printer, const char *text) {
    if (printer->out != NULL)
        fputs(text, printer->out);
    else
        printer->hash = hd_hash_bytes(printer->hash, text, strlen(text));
}

static void start_line(Printer *printer) {
    put_text(printer, "\n");
    for (int i = 0; i < printer->depth; i++)
        put_text(printer, "  ");
}

/* Writes the separator before the next key or value. */
static void separate(Printer *printer) {
    if (printer->has_key) {
        printer->has_key = false;
        return;
    }
    if (printer->has_elements)
        put_text(printer, ",");
    if (printer->depth > 0)
        start_line(printer);
    printer->has_elements = true;
}

static void put_quoted(Printer *printer, const char *text) {
    char piece[8];
    put_text(printer, "\"");
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            snprintf(piece, sizeof piece, "\\%c", c);
        else if (c < 0x20 || c == 0x7f)
            snprintf(piece, sizeof piece, "\\u%04x", c);
        else
            snprintf(piece, sizeof piece, "%c", c);
        put_text(printer, piece);
    }
    put_text(printer, "\"");
}

/* Writes the key of the next value. */
static void put_key(Printer *printer, const char *key) {
    separate(printer);
    put_quoted(printer, key);
    put_text(printer, ": ");
    printer->has_key = true;
}

/* Writes a bracket of an object or array. */
static void put_open(Printer *printer, char bracket) {
    const char text[2] = {bracket, '\0'};
    separate(printer);
    put_text(printer, text);
    printer->depth++;
    printer->has_elements = false;
}

static void put_open_at(Printer *printer, const char *key, char bracket) {
    put_key(printer, key);
    put_open(printer, bracket);
}

static void put_close(Printer *printer, char bracket) {
    const char text[2] = {bracket, '\0'};
    printer->depth--;
    if (printer->has_elements)
        start_line(printer);
    put_text(printer, text);
    printer->has_elements = true;
}

/* Writes JSON unchanged. */
static void put_raw(Printer *printer, const char *json) {
    separate(printer);
    put_text(printer, json);
}

/* Writes a string; `text` is UTF-8. */
static void put_string(Printer *printer, const char *text) {
    separate(printer);
    put_quoted(printer, text);
}

static void put_number(Printer *printer, double value) {
    char text[HD_NUMBER_SIZE];
    hd_exact_number(value, text);
    put_raw(printer, text);
}

static void put_vector(Printer *printer, HdVec3 value) {
    const double parts[3] = {value.x, value.y, value.z};
    char text[HD_NUMBER_SIZE];
    separate(printer);
    for (int i = 0; i < 3; i++) {
        hd_exact_number(parts[i], text);
        put_text(printer, i == 0 ? "[" : ", ");
        put_text(printer, text);
    }
    put_text(printer, "]");
}

/* Scenes */

typedef struct NamedMaterial {
    const HdMaterial *material;
    uint64_t hash; /* known by it */
    char name[32];
} NamedMaterial;

typedef struct Writer {
    Printer printer;
    int material_count;
    NamedMaterial *materials; /* all different */
} Writer;

static void write_object(Writer *writer, const HdObjectType *type, const void *owner);

/* Returns whether this is for a hash, which includes everything by value, even if no file can hold
   it. */
static bool is_hashed(const Writer *writer) {
    return writer->printer.out == NULL;
}

static const void *place_of(const HdField *field, const void *owner) {
    return (const char *)owner + field->offset;
}

/* Materials */

static const char *material_name(const Writer *writer, const HdMaterial *material) {
    const uint64_t hash = hd_object_hash(HD_HASH_START, &hd_material_fields, material);
    for (int i = 0; i < writer->material_count; i++)
        if (writer->materials[i].hash == hash)
            return writer->materials[i].name;
    return NULL;
}

static void add_material(Writer *writer, const HdMaterial *material, const char *name, int number) {
    if (material_name(writer, material) != NULL)
        return;
    NamedMaterial *named = &writer->materials[writer->material_count++];
    named->material = material;
    named->hash = hd_object_hash(HD_HASH_START, &hd_material_fields, material);
    if (number > 0)
        snprintf(named->name, sizeof named->name, "%s_%d", name, number);
    else
        snprintf(named->name, sizeof named->name, "%s", name);
}

static void collect_materials(Writer *writer, const HdSceneFile *file) {
    const HdScene *scene = &file->scene;
    for (int i = 0; i < scene->solid_count; i++) {
        add_material(writer, &scene->solids[i].face, "solid", i + 1);
        if (scene->solids[i].rim_width > 0.0)
            add_material(writer, &scene->solids[i].rim, "rim", i + 1);
    }
    for (int i = 0; i < file->mesh_entry_count; i++)
        if (file->mesh_entries[i].instance.has_material)
            add_material(writer, &file->mesh_entries[i].instance.material, "mesh", i + 1);
    if (scene->floor.present)
        add_material(writer, &scene->floor.material, "floor", 0);
}

static void write_materials(Writer *writer, const HdField *field, const void *unused) {
    (void)unused;
    put_open(&writer->printer, '{');
    for (int i = 0; i < writer->material_count; i++) {
        put_key(&writer->printer, writer->materials[i].name);
        write_object(writer, field->object, writer->materials[i].material);
    }
    put_close(&writer->printer, '}');
}

/* Light */

/* Returns the factor that makes a light's intensity a colour of 0..1, so that their product is
   exact. A power of two always does. Beyond the largest allowed factor, or if channels differ by
   more than 1e300, the product is rounded. */
static double light_factor(HdVec3 light) {
    const double largest = fmax(light.x, fmax(light.y, light.z));
    if (largest <= 1.0)
        return 1.0;
    const HdVec3 colour = hd_vec3(light.x / largest, light.y / largest, light.z / largest);
    const HdVec3 product = hd_scale(colour, largest);
    if (product.x == light.x && product.y == light.y && product.z == light.z)
        return largest;
    int exponent;
    (void)frexp(largest, &exponent);
    const double power = ldexp(1.0, exponent);
    return power <= HD_MAX_NUMBER ? power : largest;
}

/* Fields */

/* Gets the numbers for hd_field_set, except paths. A hash uses light unchanged. */
static void get_numbers(const Writer *writer, const HdField *field, const void *owner,
                        double out[3]) {
    const void *place = place_of(field, owner);
    if (field->type == HD_FIELD_BOOLEAN) {
        out[0] = *(const bool *)place ? 1.0 : 0.0;
    } else if (field->type == HD_FIELD_INTEGER || field->type == HD_FIELD_CHOICE) {
        out[0] = *(const int *)place;
    } else if (field->type == HD_FIELD_NUMBER) {
        out[0] = *(const double *)place;
    } else if (field->type == HD_FIELD_RATE) {
        out[0] = ((const HdOutputStyle *)place)->frames_per_second;
        out[1] = ((const HdOutputStyle *)place)->is_ntsc ? 1.0 : 0.0;
    } else {
        const HdVec3 vector = *(const HdVec3 *)place;
        const bool is_divided = field->type == HD_FIELD_UNSCALED && !is_hashed(writer);
        const double factor = light_factor(vector), divisor = is_divided ? factor : 1.0;
        out[0] = field->type == HD_FIELD_FACTOR ? factor : vector.x / divisor;
        out[1] = vector.y / divisor;
        out[2] = vector.z / divisor;
    }
}

static void print_choice(Printer *printer, const char *word) {
    (hd_choice_is_number(word) ? put_raw : put_string)(printer, word);
}

static void print_ntsc(Printer *printer, int frames) {
    char text[32];
    snprintf(text, sizeof text, "%d000/1001", frames);
    put_string(printer, text);
}

static void print_numbers(Printer *printer, const HdField *field, const double numbers[3]) {
    const HdVec3 vector = hd_vec3(numbers[0], numbers[1], numbers[2]);
    const bool is_even = vector.x == vector.y && vector.y == vector.z;
    if (field->type == HD_FIELD_BOOLEAN)
        put_raw(printer, numbers[0] != 0.0 ? "true" : "false");
    else if (field->type == HD_FIELD_CHOICE)
        print_choice(printer, hd_field_choice(field, (int)numbers[0]));
    else if (field->type == HD_FIELD_RATE && numbers[1] != 0.0)
        print_ntsc(printer, (int)numbers[0]);
    else if (hd_field_parts(field) == 1 || (field->type == HD_FIELD_SCALE && is_even))
        put_number(printer, numbers[0]); /* same on every axis */
    else
        put_vector(printer, vector);
}

typedef void WriteField(Writer *writer, const HdField *field, const void *owner);

static void write_numbers(Writer *writer, const HdField *field, const void *owner) {
    double numbers[3] = {0.0, 0.0, 0.0};
    get_numbers(writer, field, owner, numbers);
    if (is_hashed(writer) && field->type == HD_FIELD_CHOICE)
        put_number(&writer->printer, numbers[0]);
    else
        print_numbers(&writer->printer, field, numbers);
}

static void write_vectors(Writer *writer, const HdField *field, const void *owner) {
    const HdVec3 *vectors = place_of(field, owner);
    put_open(&writer->printer, '[');
    for (int i = 0; i < hd_field_count(field, owner); i++)
        put_vector(&writer->printer, vectors[i]);
    put_close(&writer->printer, ']');
}

static void write_text(Writer *writer, const HdField *field, const void *owner) {
    put_string(&writer->printer, place_of(field, owner));
}

static void write_file(Writer *writer, const HdField *field, const void *owner) {
    const char *path;
    memcpy(&path, place_of(field, owner), sizeof path);
    put_string(&writer->printer, path);
}

static void write_material(Writer *writer, const HdField *field, const void *owner) {
    const HdMaterial *material = place_of(field, owner);
    if (is_hashed(writer))
        write_object(writer, &hd_material_fields, material);
    else
        put_string(&writer->printer, material_name(writer, material));
}

static void write_part(Writer *writer, const HdField *field, const void *owner) {
    write_object(writer, field->object, place_of(field, owner));
}

static void write_path(Writer *writer, const HdField *field, const void *owner) {
    const HdPath *path = place_of(field, owner);
    if (path->is_fixed)
        put_vector(&writer->printer, path->point);
    else
        write_object(writer, field->object, path);
}

static void write_list(Writer *writer, const HdField *field, const void *owner) {
    const char *elements;
    memcpy(&elements, place_of(field, owner), sizeof elements);
    put_open(&writer->printer, '[');
    for (int i = 0; i < hd_field_count(field, owner); i++)
        write_object(writer, field->object, elements + (size_t)i * field->object->size);
    put_close(&writer->printer, ']');
}

/* Objects */

static void write_field(Writer *writer, const HdField *field, const void *owner) {
    static WriteField *const of_type[HD_FIELD_MATERIALS + 1] = {
        [HD_FIELD_VECTORS] = write_vectors, [HD_FIELD_TEXT] = write_text,
        [HD_FIELD_FILE] = write_file,       [HD_FIELD_MATERIAL] = write_material,
        [HD_FIELD_PATH] = write_path,       [HD_FIELD_OBJECT] = write_part,
        [HD_FIELD_LIST] = write_list,       [HD_FIELD_MATERIALS] = write_materials};
    WriteField *write = of_type[field->type];
    (write != NULL ? write : write_numbers)(writer, field, owner);
}

/* Returns whether reading nothing gives the same. Compares bits, so that 0 and -0 differ. */
static bool is_default(const Writer *writer, const HdField *field, const void *owner) {
    double numbers[3];
    if (hd_field_may_be_absent(field))
        return !hd_field_is_given(field, owner);
    if (field->type == HD_FIELD_LIST)
        return hd_field_count(field, owner) == 0;
    if (field->type == HD_FIELD_VECTORS && hd_field_count(field, owner) != 1)
        return false;
    if (field->type == HD_FIELD_PATH || hd_field_parts(field) == 0)
        return false;
    get_numbers(writer, field, owner, numbers);
    return memcmp(numbers, field->standard, (size_t)hd_field_parts(field) * sizeof *numbers) == 0;
}

static bool is_left_out(const Writer *writer, const HdField *field) {
    return is_hashed(writer) && (field->type == HD_FIELD_TEXT || field->type == HD_FIELD_FILE ||
                                 field->type == HD_FIELD_FACTOR ||
                                 field->type == HD_FIELD_MATERIALS || field->is_unseen);
}

static void write_object(Writer *writer, const HdObjectType *type, const void *owner) {
    put_open(&writer->printer, '{');
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        const bool is_absent = !hd_field_is_given(field, owner);
        const bool is_wanted = field->required || type->is_complete;
        if (is_absent || is_left_out(writer, field) ||
            (!is_wanted && is_default(writer, field, owner)))
            continue;
        put_key(&writer->printer, field->key);
        write_field(writer, field, owner);
    }
    put_close(&writer->printer, '}');
}

static HdStatus check_text(const char *what, const char *text, HdError *error) {
    json_t *string = json_string(text);
    json_decref(string);
    if (string == NULL)
        return hd_fail(error, HD_BAD_INPUT, "the %s is \"%s\", expected UTF-8, as JSON needs it",
                       what, text);
    return HD_OK;
}

HdStatus hd_scene_file_print(FILE *out, const HdSceneFile *file, HdError *error) {
    Writer writer = {.printer = {.out = out}};
    HD_TRY(check_text("path of the output", file->output.path, error));
    HD_TRY(check_text("path of the texture", file->texture_path, error));
    for (int i = 0; i < file->mesh_entry_count; i++)
        HD_TRY(check_text("path of a mesh", file->mesh_entries[i].file, error));
    const size_t most = 2 * (size_t)file->scene.solid_count + (size_t)file->mesh_entry_count + 1;
    writer.materials = calloc(most, sizeof *writer.materials);
    if (writer.materials == NULL)
        return HD_NO_ROOM(error, "the names of materials");
    collect_materials(&writer, file);
    write_object(&writer, &hd_scene_fields, file);
    putc('\n', out);
    free(writer.materials);
    if (fflush(out) != 0 || ferror(out))
        return hd_fail(error, HD_FAILED, "cannot write the scene: %s", strerror(errno));
    return HD_OK;
}

uint64_t hd_object_hash(uint64_t hash, const HdObjectType *type, const void *owner) {
    Writer writer = {.printer = {.hash = hash}};
    write_object(&writer, type, owner);
    return writer.printer.hash;
}

/* The JSON Schema */

static void print_object(Printer *printer, const HdObjectType *type);

static void print_pair(Printer *printer, const char *key, const char *text) {
    put_key(printer, key);
    put_string(printer, text);
}

static void print_count(Printer *printer, const char *key, double number) {
    put_key(printer, key);
    put_number(printer, number);
}

static void print_range(Printer *printer, const HdField *field, const char *type) {
    const double low = field->has_sign ? -field->high : field->low;
    print_pair(printer, "type", type);
    print_count(printer, field->above_low ? "exclusiveMinimum" : "minimum", low);
    print_count(printer, field->below_high ? "exclusiveMaximum" : "maximum", field->high);
    if (!field->has_sign)
        return;
    put_open_at(printer, "not", '{');
    print_count(printer, "exclusiveMinimum", -field->low);
    print_count(printer, "exclusiveMaximum", field->low);
    put_close(printer, '}');
}

static void open_array(Printer *printer, int least, int most) {
    print_pair(printer, "type", "array");
    print_count(printer, "minItems", least);
    print_count(printer, "maxItems", most);
    put_open_at(printer, "items", '{');
}

static void print_vector(Printer *printer, const HdField *field) {
    open_array(printer, 3, 3);
    print_range(printer, field, "number");
    put_close(printer, '}');
}

static void print_choices(Printer *printer, const HdField *field) {
    put_open_at(printer, "enum", '[');
    for (const HdChoice *choice = field->choices; choice->word != NULL; choice++)
        print_choice(printer, choice->word);
    put_close(printer, ']');
}

static void print_number(Printer *printer, const HdField *field) {
    const bool is_whole = field->type == HD_FIELD_INTEGER || field->type == HD_FIELD_RATE;
    print_range(printer, field, is_whole ? "integer" : "number");
}

static void print_part(Printer *printer, const HdField *field) {
    print_object(printer, field->object);
}

/* Prints the schema of a vector or else an object or a number. */
static void print_either(Printer *printer, const HdField *field) {
    const bool is_path = field->type == HD_FIELD_PATH;
    put_open_at(printer, "oneOf", '[');
    put_open(printer, '{');
    (is_path ? print_vector : print_number)(printer, field);
    put_close(printer, '}');
    put_open(printer, '{');
    (is_path ? print_part : print_vector)(printer, field);
    put_close(printer, '}');
    put_close(printer, ']');
}

static void print_rate(Printer *printer, const HdField *field) {
    put_open_at(printer, "oneOf", '[');
    put_open(printer, '{');
    print_number(printer, field);
    put_close(printer, '}');
    put_open(printer, '{');
    print_pair(printer, "type", "string");
    print_pair(printer, "pattern", "^([1-9][0-9]?|1[0-9]{2}|2[0-3][0-9]|240)000/1001$");
    put_close(printer, '}');
    put_close(printer, ']');
}

static void print_text(Printer *printer, const HdField *field) {
    print_pair(printer, "type", "string");
    print_count(printer, "minLength", 1);
    if (field->type != HD_FIELD_MATERIAL)
        print_count(printer, "maxLength", HD_MAX_PATH - 1);
}

static void print_materials(Printer *printer, const HdField *field) {
    print_pair(printer, "type", "object");
    print_count(printer, "maxProperties", field->most);
    put_open_at(printer, "additionalProperties", '{');
    print_object(printer, field->object);
    put_close(printer, '}');
}

typedef void PrintType(Printer *printer, const HdField *field);

static void print_boolean(Printer *printer, const HdField *unused) {
    (void)unused;
    print_pair(printer, "type", "boolean");
}

static void print_array(Printer *printer, const HdField *field) {
    open_array(printer, field->least, field->most);
    (field->object != NULL ? print_part : print_vector)(printer, field);
    put_close(printer, '}');
}

static void print_type(Printer *printer, const HdField *field) {
    static PrintType *const of_type[] = {
        [HD_FIELD_BOOLEAN] = print_boolean, [HD_FIELD_INTEGER] = print_number,
        [HD_FIELD_NUMBER] = print_number,   [HD_FIELD_FACTOR] = print_number,
        [HD_FIELD_VECTOR] = print_vector,   [HD_FIELD_UNSCALED] = print_vector,
        [HD_FIELD_VECTORS] = print_array,   [HD_FIELD_CHOICE] = print_choices,
        [HD_FIELD_SCALE] = print_either,    [HD_FIELD_TEXT] = print_text,
        [HD_FIELD_FILE] = print_text,       [HD_FIELD_MATERIAL] = print_text,
        [HD_FIELD_PATH] = print_either,     [HD_FIELD_OBJECT] = print_part,
        [HD_FIELD_LIST] = print_array,      [HD_FIELD_MATERIALS] = print_materials,
        [HD_FIELD_RATE] = print_rate};
    of_type[field->type](printer, field);
}

/* Prints the default of an optional field that has one. */
static void print_default(Printer *printer, const HdField *field) {
    const bool is_object = field->object != NULL && field->type != HD_FIELD_PATH;
    if (field->required || hd_field_may_be_absent(field) || is_object)
        return;
    put_key(printer, "default");
    if (field->type == HD_FIELD_VECTORS)
        put_open(printer, '[');
    print_numbers(printer, field, field->standard);
    if (field->type == HD_FIELD_VECTORS)
        put_close(printer, ']');
}

static void print_field(Printer *printer, const HdField *field) {
    char description[HD_DESCRIPTION_SIZE];
    hd_field_describe(field, description);
    put_open_at(printer, field->key, '{');
    print_pair(printer, "description", description);
    print_type(printer, field);
    print_default(printer, field);
    put_close(printer, '}');
}

static void print_required(Printer *printer, const HdObjectType *type) {
    bool has_any = false;
    for (int i = 0; i < type->field_count; i++) {
        if (!type->fields[i].required)
            continue;
        if (!has_any)
            put_open_at(printer, "required", '[');
        put_string(printer, type->fields[i].key);
        has_any = true;
    }
    if (has_any)
        put_close(printer, ']');
}

/* Prints the exclusion of two keys; no object has more than one such pair. */
static void print_exclusion(Printer *printer, const HdObjectType *type) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        if (field->instead_of == NULL)
            continue;
        put_open_at(printer, "not", '{');
        put_open_at(printer, "required", '[');
        put_string(printer, field->instead_of);
        put_string(printer, field->key);
        put_close(printer, ']');
        put_close(printer, '}');
    }
}

/* Prints the inside of an object's schema. */
static void print_object(Printer *printer, const HdObjectType *type) {
    print_pair(printer, "type", "object");
    put_key(printer, "additionalProperties");
    put_raw(printer, "false");
    print_required(printer, type);
    print_exclusion(printer, type);
    put_open_at(printer, "properties", '{');
    for (int i = 0; i < type->field_count; i++)
        print_field(printer, &type->fields[i]);
    put_open_at(printer, HD_COMMENT_KEY, '{');
    print_pair(printer, "description", "Comment for people");
    print_pair(printer, "type", "string");
    put_close(printer, '}');
    put_close(printer, '}');
}

HdStatus hd_scene_schema_print(FILE *out, HdError *error) {
    Printer printer = {.out = out};
    put_open(&printer, '{');
    print_pair(&printer, "$schema", "https://json-schema.org/draft/2020-12/schema");
    print_pair(&printer, "$id", "urn:hedron:scene:1");
    print_pair(&printer, "title", "A scene of hedron");
    print_object(&printer, &hd_scene_fields);
    put_close(&printer, '}');
    putc('\n', out);
    if (fflush(out) != 0 || ferror(out))
        return hd_fail(error, HD_FAILED, "cannot write the schema: %s", strerror(errno));
    return HD_OK;
}
