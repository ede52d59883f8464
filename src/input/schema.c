/* SPDX-License-Identifier: MIT */
#include "input/schema.h"

#include <errno.h>
#include <string.h>

#include "input/write.h"

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
        hd_choice_print(printer, choice->word);
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
    hd_numbers_print(printer, field, field->standard);
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
