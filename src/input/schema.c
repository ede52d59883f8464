/* SPDX-License-Identifier: MIT */
#include "input/schema.h"

#include <errno.h>
#include <string.h>

#include "input/fields.h"
#include "input/json/print.h"

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
    for (const HdChoice *choice = field->choices; choice->json != NULL; choice++)
        hd_json_raw(printer, choice->json);
    hd_json_close(printer, ']');
}

/* A vector, or else an object or a number. */
static void print_either(HdJsonPrinter *printer, const HdField *field, bool vector_is_first) {
    hd_json_key(printer, "oneOf");
    hd_json_open(printer, '[');
    for (int i = 0; i < 2; i++) {
        hd_json_open(printer, '{');
        if ((i == 0) == vector_is_first)
            print_vector(printer, field);
        else if (field->object != NULL)
            print_object(printer, field->object);
        else
            print_range(printer, field, "number");
        hd_json_close(printer, '}');
    }
    hd_json_close(printer, ']');
}

static void print_text(HdJsonPrinter *printer, int most) {
    print_pair(printer, "type", "string");
    print_count(printer, "minLength", 1);
    if (most > 0)
        print_count(printer, "maxLength", most);
}

static void print_materials(HdJsonPrinter *printer, const HdField *field) {
    print_pair(printer, "type", "object");
    print_count(printer, "maxProperties", field->most);
    hd_json_key(printer, "additionalProperties");
    hd_json_open(printer, '{');
    print_object(printer, field->object);
    hd_json_close(printer, '}');
}

static void print_type(HdJsonPrinter *printer, const HdField *field) {
    switch (field->type) {
    case HD_FIELD_BOOLEAN:
        print_pair(printer, "type", "boolean");
        break;
    case HD_FIELD_INTEGER:
        print_range(printer, field, "integer");
        break;
    case HD_FIELD_NUMBER:
    case HD_FIELD_FACTOR:
        print_range(printer, field, "number");
        break;
    case HD_FIELD_VECTOR:
    case HD_FIELD_UNSCALED:
        print_vector(printer, field);
        break;
    case HD_FIELD_VECTORS:
        open_array(printer, field->least, field->most);
        print_vector(printer, field);
        hd_json_close(printer, '}');
        break;
    case HD_FIELD_CHOICE:
        print_choices(printer, field);
        break;
    case HD_FIELD_SCALE:
        print_either(printer, field, false);
        break;
    case HD_FIELD_TEXT:
    case HD_FIELD_FILE:
        print_text(printer, HD_MAX_PATH - 1);
        break;
    case HD_FIELD_MATERIAL:
        print_text(printer, 0);
        break;
    case HD_FIELD_PATH:
        print_either(printer, field, true);
        break;
    case HD_FIELD_OBJECT:
        print_object(printer, field->object);
        break;
    case HD_FIELD_LIST:
        open_array(printer, field->least, field->most);
        print_object(printer, field->object);
        hd_json_close(printer, '}');
        break;
    case HD_FIELD_MATERIALS:
        print_materials(printer, field);
        break;
    }
}

/* Of what may be left out; what then is not there at all has none. */
static void print_default(HdJsonPrinter *printer, const HdField *field) {
    const HdVec3 vector = hd_vec3(field->standard[0], field->standard[1], field->standard[2]);
    const bool is_object = field->object != NULL && field->type != HD_FIELD_PATH;
    if (field->required || hd_field_may_be_absent(field) || is_object)
        return;
    hd_json_key(printer, "default");
    switch (field->type) {
    case HD_FIELD_BOOLEAN:
        hd_json_raw(printer, "false");
        break;
    case HD_FIELD_CHOICE:
        hd_json_raw(printer, hd_field_choice(field, (int)field->standard[0]));
        break;
    case HD_FIELD_VECTORS:
        hd_json_open(printer, '[');
        hd_json_vector(printer, vector);
        hd_json_close(printer, ']');
        break;
    case HD_FIELD_VECTOR:
    case HD_FIELD_UNSCALED:
    case HD_FIELD_PATH:
        hd_json_vector(printer, vector);
        break;
    default:
        hd_json_number(printer, field->standard[0]);
        break;
    }
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
    hd_json_close(printer, '}');
}

HdStatus hd_scene_schema_print(FILE *out, HdError *error) {
    HdJsonPrinter printer = {.out = out};
    hd_json_open(&printer, '{');
    print_pair(&printer, "$schema", "https://json-schema.org/draft/2020-12/schema");
    print_pair(&printer, "title", "A scene of hedron");
    print_object(&printer, &hd_scene_fields);
    hd_json_close(&printer, '}');
    putc('\n', out);
    if (fflush(out) != 0 || ferror(out))
        return hd_fail(error, HD_FAILED, "cannot write the schema: %s", strerror(errno));
    return HD_OK;
}
