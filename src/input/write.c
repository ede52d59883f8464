/* SPDX-License-Identifier: MIT */
/* Field by field of the table; defaults are left out but where an object is complete. */
#include "input/write.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "input/json/print.h"

typedef struct NamedMaterial {
    const HdMaterial *material;
    uint64_t hash; /* by which it is known */
    char name[32];
} NamedMaterial;

typedef struct Writer {
    HdJsonPrinter printer;
    int material_count;
    NamedMaterial *materials; /* each differs from all others */
} Writer;

static void write_object(Writer *writer, const HdObjectType *type, const void *owner);

/* A hash takes everything by its value: it is of scenes too that no file can tell. */
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
    hd_json_open(&writer->printer, '{');
    for (int i = 0; i < writer->material_count; i++) {
        hd_json_key(&writer->printer, writer->materials[i].name);
        write_object(writer, field->object, writer->materials[i].material);
    }
    hd_json_close(&writer->printer, '}');
}

/* Light */

/* A light's intensity, three numbers, as a colour of 0..1 and a factor whose product is the same to
   the bit. A power of two always does; beyond the largest that may stand there, and for a channel
   that is 1e300 times darker than another, the product is rounded. */
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

/* What hd_field_set takes, but for paths. A hash takes light as it is. */
static void take_numbers(const Writer *writer, const HdField *field, const void *owner,
                         double out[3]) {
    const void *place = place_of(field, owner);
    if (field->type == HD_FIELD_BOOLEAN) {
        out[0] = *(const bool *)place ? 1.0 : 0.0;
    } else if (field->type == HD_FIELD_INTEGER || field->type == HD_FIELD_CHOICE) {
        out[0] = *(const int *)place;
    } else if (field->type == HD_FIELD_NUMBER) {
        out[0] = *(const double *)place;
    } else {
        const HdVec3 vector = *(const HdVec3 *)place;
        const bool is_divided = field->type == HD_FIELD_UNSCALED && !is_hashed(writer);
        const double factor = light_factor(vector), divisor = is_divided ? factor : 1.0;
        out[0] = field->type == HD_FIELD_FACTOR ? factor : vector.x / divisor;
        out[1] = vector.y / divisor;
        out[2] = vector.z / divisor;
    }
}

static void print_choice(HdJsonPrinter *printer, const char *word) {
    (hd_choice_is_number(word) ? hd_json_raw : hd_json_string)(printer, word);
}

static void print_numbers(HdJsonPrinter *printer, const HdField *field, const double numbers[3]) {
    const HdVec3 vector = hd_vec3(numbers[0], numbers[1], numbers[2]);
    const bool is_even = vector.x == vector.y && vector.y == vector.z;
    if (field->type == HD_FIELD_BOOLEAN)
        hd_json_raw(printer, numbers[0] != 0.0 ? "true" : "false");
    else if (field->type == HD_FIELD_CHOICE)
        print_choice(printer, hd_field_choice(field, (int)numbers[0]));
    else if (hd_field_parts(field) == 1 || (field->type == HD_FIELD_SCALE && is_even))
        hd_json_number(printer, numbers[0]); /* of every axis */
    else
        hd_json_vector(printer, vector);
}

typedef void WriteField(Writer *writer, const HdField *field, const void *owner);

static void write_numbers(Writer *writer, const HdField *field, const void *owner) {
    double numbers[3] = {0.0, 0.0, 0.0};
    take_numbers(writer, field, owner, numbers);
    if (is_hashed(writer) && field->type == HD_FIELD_CHOICE)
        hd_json_number(&writer->printer, numbers[0]);
    else
        print_numbers(&writer->printer, field, numbers);
}

static void write_vectors(Writer *writer, const HdField *field, const void *owner) {
    const HdVec3 *vectors = place_of(field, owner);
    hd_json_open(&writer->printer, '[');
    for (int i = 0; i < hd_field_count(field, owner); i++)
        hd_json_vector(&writer->printer, vectors[i]);
    hd_json_close(&writer->printer, ']');
}

static void write_text(Writer *writer, const HdField *field, const void *owner) {
    hd_json_string(&writer->printer, place_of(field, owner));
}

static void write_file(Writer *writer, const HdField *field, const void *owner) {
    const char *path;
    memcpy(&path, place_of(field, owner), sizeof path);
    hd_json_string(&writer->printer, path);
}

static void write_material(Writer *writer, const HdField *field, const void *owner) {
    const HdMaterial *material = place_of(field, owner);
    if (is_hashed(writer))
        write_object(writer, &hd_material_fields, material);
    else
        hd_json_string(&writer->printer, material_name(writer, material));
}

static void write_part(Writer *writer, const HdField *field, const void *owner) {
    write_object(writer, field->object, place_of(field, owner));
}

static void write_path(Writer *writer, const HdField *field, const void *owner) {
    const HdPath *path = place_of(field, owner);
    if (path->is_fixed)
        hd_json_vector(&writer->printer, path->point);
    else
        write_object(writer, field->object, path);
}

static void write_list(Writer *writer, const HdField *field, const void *owner) {
    const char *elements;
    memcpy(&elements, place_of(field, owner), sizeof elements);
    hd_json_open(&writer->printer, '[');
    for (int i = 0; i < hd_field_count(field, owner); i++)
        write_object(writer, field->object, elements + (size_t)i * field->object->size);
    hd_json_close(&writer->printer, ']');
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

/* Whether reading nothing gives the same. Numbers are compared by their bits, lest 0 and -0 become
   one. */
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
    take_numbers(writer, field, owner, numbers);
    return memcmp(numbers, field->standard, (size_t)hd_field_parts(field) * sizeof *numbers) == 0;
}

static bool is_left_out(const Writer *writer, const HdField *field) {
    return is_hashed(writer) && (field->type == HD_FIELD_TEXT || field->type == HD_FIELD_FILE ||
                                 field->type == HD_FIELD_FACTOR ||
                                 field->type == HD_FIELD_MATERIALS || field->is_unseen);
}

static void write_object(Writer *writer, const HdObjectType *type, const void *owner) {
    hd_json_open(&writer->printer, '{');
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        const bool is_absent = !hd_field_is_given(field, owner);
        const bool is_wanted = field->required || type->is_complete;
        if (is_absent || is_left_out(writer, field) ||
            (!is_wanted && is_default(writer, field, owner)))
            continue;
        hd_json_key(&writer->printer, field->key);
        write_field(writer, field, owner);
    }
    hd_json_close(&writer->printer, '}');
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
    HdStatus status = check_text("path of the output", file->output.path, error);
    if (status == HD_OK)
        status = check_text("path of the texture", file->texture_path, error);
    for (int i = 0; i < file->mesh_entry_count && status == HD_OK; i++)
        status = check_text("path of a mesh", file->mesh_entries[i].file, error);
    if (status != HD_OK)
        return status;
    const size_t most = 2 * (size_t)file->scene.solid_count + (size_t)file->mesh_entry_count + 1;
    writer.materials = calloc(most, sizeof *writer.materials);
    if (writer.materials == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room for the names of materials");
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

static void print_object(HdJsonPrinter *printer, const HdObjectType *type);

static void print_pair(HdJsonPrinter *printer, const char *key, const char *text) {
    hd_json_key(printer, key);
    hd_json_string(printer, text);
}

static void print_count(HdJsonPrinter *printer, const char *key, double number) {
    hd_json_key(printer, key);
    hd_json_number(printer, number);
}

static void print_range(HdJsonPrinter *printer, const HdField *field, const char *type) {
    print_pair(printer, "type", type);
    print_count(printer, field->above_low ? "exclusiveMinimum" : "minimum", field->low);
    print_count(printer, field->below_high ? "exclusiveMaximum" : "maximum", field->high);
}

static void open_array(HdJsonPrinter *printer, int least, int most) {
    print_pair(printer, "type", "array");
    print_count(printer, "minItems", least);
    print_count(printer, "maxItems", most);
    hd_json_key(printer, "items");
    hd_json_open(printer, '{');
}

static void print_vector(HdJsonPrinter *printer, const HdField *field) {
    open_array(printer, 3, 3);
    print_range(printer, field, "number");
    hd_json_close(printer, '}');
}

static void print_choices(HdJsonPrinter *printer, const HdField *field) {
    hd_json_key(printer, "enum");
    hd_json_open(printer, '[');
    for (const HdChoice *choice = field->choices; choice->word != NULL; choice++)
        print_choice(printer, choice->word);
    hd_json_close(printer, ']');
}

static void print_number(HdJsonPrinter *printer, const HdField *field) {
    print_range(printer, field, field->type == HD_FIELD_INTEGER ? "integer" : "number");
}

static void print_part(HdJsonPrinter *printer, const HdField *field) {
    print_object(printer, field->object);
}

/* A vector, or else an object or a number. */
static void print_either(HdJsonPrinter *printer, const HdField *field) {
    const bool is_path = field->type == HD_FIELD_PATH;
    hd_json_key(printer, "oneOf");
    hd_json_open(printer, '[');
    hd_json_open(printer, '{');
    (is_path ? print_vector : print_number)(printer, field);
    hd_json_close(printer, '}');
    hd_json_open(printer, '{');
    (is_path ? print_part : print_vector)(printer, field);
    hd_json_close(printer, '}');
    hd_json_close(printer, ']');
}

static void print_text(HdJsonPrinter *printer, const HdField *field) {
    print_pair(printer, "type", "string");
    print_count(printer, "minLength", 1);
    if (field->type != HD_FIELD_MATERIAL)
        print_count(printer, "maxLength", HD_MAX_PATH - 1);
}

static void print_materials(HdJsonPrinter *printer, const HdField *field) {
    print_pair(printer, "type", "object");
    print_count(printer, "maxProperties", field->most);
    hd_json_key(printer, "additionalProperties");
    hd_json_open(printer, '{');
    print_object(printer, field->object);
    hd_json_close(printer, '}');
}

typedef void PrintType(HdJsonPrinter *printer, const HdField *field);

static void print_boolean(HdJsonPrinter *printer, const HdField *unused) {
    (void)unused;
    print_pair(printer, "type", "boolean");
}

static void print_array(HdJsonPrinter *printer, const HdField *field) {
    open_array(printer, field->least, field->most);
    (field->object != NULL ? print_part : print_vector)(printer, field);
    hd_json_close(printer, '}');
}

static void print_type(HdJsonPrinter *printer, const HdField *field) {
    static PrintType *const of_type[] = {
        [HD_FIELD_BOOLEAN] = print_boolean, [HD_FIELD_INTEGER] = print_number,
        [HD_FIELD_NUMBER] = print_number,   [HD_FIELD_FACTOR] = print_number,
        [HD_FIELD_VECTOR] = print_vector,   [HD_FIELD_UNSCALED] = print_vector,
        [HD_FIELD_VECTORS] = print_array,   [HD_FIELD_CHOICE] = print_choices,
        [HD_FIELD_SCALE] = print_either,    [HD_FIELD_TEXT] = print_text,
        [HD_FIELD_FILE] = print_text,       [HD_FIELD_MATERIAL] = print_text,
        [HD_FIELD_PATH] = print_either,     [HD_FIELD_OBJECT] = print_part,
        [HD_FIELD_LIST] = print_array,      [HD_FIELD_MATERIALS] = print_materials};
    of_type[field->type](printer, field);
}

/* Of what may be left out; what then is not there at all has none. */
static void print_default(HdJsonPrinter *printer, const HdField *field) {
    const bool is_object = field->object != NULL && field->type != HD_FIELD_PATH;
    if (field->required || hd_field_may_be_absent(field) || is_object)
        return;
    hd_json_key(printer, "default");
    if (field->type == HD_FIELD_VECTORS)
        hd_json_open(printer, '[');
    print_numbers(printer, field, field->standard);
    if (field->type == HD_FIELD_VECTORS)
        hd_json_close(printer, ']');
}

static void print_field(HdJsonPrinter *printer, const HdField *field) {
    hd_json_key(printer, field->key);
    hd_json_open(printer, '{');
    print_pair(printer, "description", field->about);
    print_type(printer, field);
    print_default(printer, field);
    hd_json_close(printer, '}');
}

static void print_required(HdJsonPrinter *printer, const HdObjectType *type) {
    int count = 0;
    for (int i = 0; i < type->field_count; i++)
        count += type->fields[i].required;
    if (count == 0)
        return;
    hd_json_key(printer, "required");
    hd_json_open(printer, '[');
    for (int i = 0; i < type->field_count; i++)
        if (type->fields[i].required)
            hd_json_string(printer, type->fields[i].key);
    hd_json_close(printer, ']');
}

/* Keys that exclude each other; no object has more than one such pair. */
static void print_exclusion(HdJsonPrinter *printer, const HdObjectType *type) {
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        if (field->instead_of == NULL)
            continue;
        hd_json_key(printer, "not");
        hd_json_open(printer, '{');
        hd_json_key(printer, "required");
        hd_json_open(printer, '[');
        hd_json_string(printer, field->instead_of);
        hd_json_string(printer, field->key);
        hd_json_close(printer, ']');
        hd_json_close(printer, '}');
    }
}

/* What is between the braces of an object's schema. */
static void print_object(HdJsonPrinter *printer, const HdObjectType *type) {
    print_pair(printer, "type", "object");
    hd_json_key(printer, "additionalProperties");
    hd_json_raw(printer, "false");
    print_required(printer, type);
    print_exclusion(printer, type);
    hd_json_key(printer, "properties");
    hd_json_open(printer, '{');
    for (int i = 0; i < type->field_count; i++)
        print_field(printer, &type->fields[i]);
    hd_json_key(printer, HD_COMMENT_KEY);
    hd_json_open(printer, '{');
    print_pair(printer, "description", "For people");
    print_pair(printer, "type", "string");
    hd_json_close(printer, '}');
    hd_json_close(printer, '}');
}

HdStatus hd_scene_schema_print(FILE *out, HdError *error) {
    HdJsonPrinter printer = {.out = out};
    hd_json_open(&printer, '{');
    print_pair(&printer, "$schema", "https://json-schema.org/draft/2020-12/schema");
    print_pair(&printer, "$id", "urn:hedron:scene:1");
    print_pair(&printer, "title", "A scene of hedron");
    print_object(&printer, &hd_scene_fields);
    hd_json_close(&printer, '}');
    putc('\n', out);
    if (fflush(out) != 0 || ferror(out))
        return hd_fail(error, HD_FAILED, "cannot write the schema: %s", strerror(errno));
    return HD_OK;
}
