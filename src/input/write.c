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

static void write_materials(Writer *writer) {
    hd_json_open(&writer->printer, '{');
    for (int i = 0; i < writer->material_count; i++) {
        hd_json_key(&writer->printer, writer->materials[i].name);
        write_object(writer, &hd_material_fields, writer->materials[i].material);
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
    double power = 1.0;
    while (power < largest)
        power *= 2.0;
    return power <= HD_MAX_NUMBER ? power : largest;
}

static HdVec3 light_colour(HdVec3 light) {
    const double factor = light_factor(light);
    return hd_vec3(light.x / factor, light.y / factor, light.z / factor);
}

/* Fields */

static void write_vectors(Writer *writer, const HdField *field, const void *owner) {
    const HdVec3 *vectors = place_of(field, owner);
    hd_json_open(&writer->printer, '[');
    for (int i = 0; i < hd_field_count(field, owner); i++)
        hd_json_vector(&writer->printer, vectors[i]);
    hd_json_close(&writer->printer, ']');
}

static void write_choice(Writer *writer, const HdField *field, int value) {
    if (is_hashed(writer) && field->choices[1].json != NULL)
        hd_json_number(&writer->printer, value);
    else
        hd_json_raw(&writer->printer, hd_field_choice(field, value));
}

static void write_material(Writer *writer, const HdMaterial *material) {
    if (is_hashed(writer))
        write_object(writer, &hd_material_fields, material);
    else
        hd_json_string(&writer->printer, material_name(writer, material));
}

static void write_path(Writer *writer, const HdField *field, const HdPath *path) {
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

/* One number where every axis has the same. */
static void write_scale(Writer *writer, HdVec3 scale) {
    if (scale.x == scale.y && scale.y == scale.z)
        hd_json_number(&writer->printer, scale.x);
    else
        hd_json_vector(&writer->printer, scale);
}

static void write_file(Writer *writer, const void *place) {
    const char *path;
    memcpy(&path, place, sizeof path);
    hd_json_string(&writer->printer, path);
}

static void write_value(Writer *writer, const HdField *field, const void *owner) {
    HdJsonPrinter *printer = &writer->printer;
    const void *place = place_of(field, owner);
    switch (field->type) {
    case HD_FIELD_BOOLEAN:
        hd_json_raw(printer, *(const bool *)place ? "true" : "false");
        break;
    case HD_FIELD_INTEGER:
        hd_json_number(printer, *(const int *)place);
        break;
    case HD_FIELD_NUMBER:
        hd_json_number(printer, *(const double *)place);
        break;
    case HD_FIELD_UNSCALED:
        hd_json_vector(printer, light_colour(*(const HdVec3 *)place));
        break;
    case HD_FIELD_FACTOR:
        hd_json_number(printer, light_factor(*(const HdVec3 *)place));
        break;
    case HD_FIELD_VECTOR:
        hd_json_vector(printer, *(const HdVec3 *)place);
        break;
    case HD_FIELD_VECTORS:
        write_vectors(writer, field, owner);
        break;
    case HD_FIELD_CHOICE:
        write_choice(writer, field, *(const int *)place);
        break;
    case HD_FIELD_SCALE:
        write_scale(writer, *(const HdVec3 *)place);
        break;
    case HD_FIELD_TEXT:
        hd_json_string(printer, place);
        break;
    case HD_FIELD_FILE:
        write_file(writer, place);
        break;
    case HD_FIELD_MATERIAL:
        write_material(writer, place);
        break;
    case HD_FIELD_PATH:
        write_path(writer, field, place);
        break;
    case HD_FIELD_OBJECT:
        write_object(writer, field->object, place);
        break;
    case HD_FIELD_LIST:
        write_list(writer, field, owner);
        break;
    case HD_FIELD_MATERIALS:
        write_materials(writer);
        break;
    }
}

/* Objects */

/* Numbers are compared by their bits, lest 0 and -0 become one. */
static bool are_same(const double *a, const double *b, size_t count) {
    return memcmp(a, b, count * sizeof *a) == 0;
}

static bool is_standard_vector(const HdField *field, HdVec3 vector) {
    const double parts[3] = {vector.x, vector.y, vector.z};
    return are_same(parts, field->standard, 3);
}

/* Whether reading nothing gives the same. */
static bool is_default(const HdField *field, const void *owner) {
    const void *place = place_of(field, owner);
    if (hd_field_may_be_absent(field))
        return !hd_field_is_given(field, owner);
    switch (field->type) {
    case HD_FIELD_BOOLEAN:
        return !*(const bool *)place;
    case HD_FIELD_INTEGER:
    case HD_FIELD_CHOICE:
        return *(const int *)place == (int)field->standard[0];
    case HD_FIELD_NUMBER:
        return are_same(place, field->standard, 1);
    case HD_FIELD_FACTOR:
        return light_factor(*(const HdVec3 *)place) == field->standard[0];
    case HD_FIELD_VECTOR:
    case HD_FIELD_SCALE:
        return is_standard_vector(field, *(const HdVec3 *)place);
    case HD_FIELD_UNSCALED:
        return is_standard_vector(field, light_colour(*(const HdVec3 *)place));
    case HD_FIELD_VECTORS:
        return hd_field_count(field, owner) == 1 &&
               is_standard_vector(field, *(const HdVec3 *)place);
    case HD_FIELD_LIST:
        return hd_field_count(field, owner) == 0;
    default:
        return false;
    }
}

static bool is_left_out(const Writer *writer, const HdField *field) {
    return is_hashed(writer) &&
           (field->type == HD_FIELD_TEXT || field->type == HD_FIELD_FILE ||
            field->type == HD_FIELD_MATERIALS || strcmp(field->key, "output") == 0);
}

static void write_object(Writer *writer, const HdObjectType *type, const void *owner) {
    hd_json_open(&writer->printer, '{');
    for (int i = 0; i < type->field_count; i++) {
        const HdField *field = &type->fields[i];
        const bool is_absent = !hd_field_is_given(field, owner);
        const bool is_wanted = field->required || type->is_complete;
        if (is_absent || is_left_out(writer, field) || (!is_wanted && is_default(field, owner)))
            continue;
        hd_json_key(&writer->printer, field->key);
        write_value(writer, field, owner);
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
