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

void hd_choice_print(HdJsonPrinter *printer, const char *word) {
    (hd_choice_is_number(word) ? hd_json_raw : hd_json_string)(printer, word);
}

void hd_numbers_print(HdJsonPrinter *printer, const HdField *field, const double numbers[3]) {
    const HdVec3 vector = hd_vec3(numbers[0], numbers[1], numbers[2]);
    const bool is_even = vector.x == vector.y && vector.y == vector.z;
    if (field->type == HD_FIELD_BOOLEAN)
        hd_json_raw(printer, numbers[0] != 0.0 ? "true" : "false");
    else if (field->type == HD_FIELD_CHOICE)
        hd_choice_print(printer, hd_field_choice(field, (int)numbers[0]));
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
        hd_numbers_print(&writer->printer, field, numbers);
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
