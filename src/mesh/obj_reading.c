/* SPDX-License-Identifier: MIT */
#include "mesh/obj_reading.h"

#include <math.h>
#include <search.h>
#include <stdlib.h>

#include "base/limits.h"

void *hd_obj_resize(HdObjMemory *memory, void *array, size_t size, size_t before, size_t count) {
    const size_t others = memory->used - before * size;
    if (count > SIZE_MAX / size || count * size > memory->max_bytes ||
        others > memory->max_bytes - count * size) {
        memory->is_over = memory->has_refused = true;
        return NULL;
    }
    void *resized = realloc(array, count > 0 ? count * size : 1);
    if (resized != NULL)
        memory->used = others + count * size;
    else
        memory->has_refused = true;
    return resized;
}

void *hd_obj_allocate(HdObjMemory *memory, size_t count, size_t size) {
    return hd_obj_resize(memory, NULL, size, 0, count);
}

void hd_obj_release(HdObjMemory *memory, void *array, size_t bytes) {
    if (array != NULL)
        memory->used -= bytes;
    free(array);
}

/* ---- words ---- */

enum {
    MAX_SHOWN = 80,
    MAX_NUMBER_LENGTH = 64, /* longer ones might overflow a double on the way */
    MAX_POWER = 19          /* of ten, in either direction */
};

static const double powers_of_ten[2 * MAX_POWER + 1] = {
    1e-19, 1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7,
    1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  1e0,   1e1,   1e2,   1e3,   1e4,  1e5,  1e6,
    1e7,   1e8,   1e9,   1e10,  1e11,  1e12,  1e13,  1e14,  1e15,  1e16,  1e17, 1e18, 1e19};

int hd_span_shown(HdSpan span) {
    const ptrdiff_t length = span.end - span.begin;
    int shown = length < MAX_SHOWN ? (int)length : MAX_SHOWN;
    while (shown > 0 && shown < length && ((unsigned char)span.begin[shown] & 0xc0) == 0x80)
        shown--;
    return shown;
}

bool hd_span_is(HdSpan span, const char *text) {
    const size_t length = strlen(text);
    return hd_span_size(span) == length && memcmp(span.begin, text, length) == 0;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\x1a'; /* the last one ends files of old systems */
}

HdSpan hd_next_word(HdSpan *line) {
    const char *at = line->begin;
    while (at < line->end && is_blank(*at))
        at++;
    const char *begin = at;
    while (at < line->end && !is_blank(*at))
        at++;
    line->begin = at;
    return (HdSpan){begin, at};
}

HdSpan hd_rest(HdSpan line) {
    while (line.begin < line.end && is_blank(*line.begin))
        line.begin++;
    while (line.begin < line.end && is_blank(line.end[-1]))
        line.end--;
    return line;
}

HdSpan hd_without_comment(HdSpan name) {
    for (const char *at = name.begin; at + 1 < name.end; at++)
        if (is_blank(at[0]) && at[1] == '#')
            return hd_rest((HdSpan){name.begin, at});
    return name;
}

size_t hd_mark_size(HdSpan text) {
    return hd_span_size(text) >= 3 && memcmp(text.begin, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
}

size_t hd_padding_size(HdSpan text) {
    const char *at = text.begin;
    while (at < text.end && (is_blank(*at) || *at == '\0' || *at == '\n' || *at == '\r'))
        at++;
    return (size_t)(at - text.begin);
}

static bool is_digit(const char *at, const char *end) {
    return at < end && *at >= '0' && *at <= '9';
}

static const char *skip_sign(const char *at, const char *end) {
    return at < end && (*at == '-' || *at == '+') ? at + 1 : at;
}

/* Reads an exponent such as "e-12", or nothing. Returns NULL for anything else. */
static const char *read_power(const char *at, const char *end, int *power) {
    *power = 0;
    if (at == end || (*at != 'e' && *at != 'E'))
        return at;
    const char *digits = skip_sign(++at, end);
    if (!is_digit(digits, end))
        return NULL;
    const bool is_negative = *at == '-';
    for (at = digits; is_digit(at, end); at++)
        *power = *power < 10000 ? 10 * *power + (*at - '0') : *power;
    if (is_negative)
        *power = -*power;
    return at;
}

/* Reads digits with an optional point; each side is read as an integer. Returns NULL without
   digits. */
static const char *read_mantissa(const char *at, const char *end, double *mantissa) {
    double whole = 0.0, fraction = 0.0, scale = 1.0;
    bool has_digits = false;
    for (; is_digit(at, end); at++, has_digits = true)
        whole = 10.0 * whole + (*at - '0');
    if (at < end && *at == '.')
        at++;
    for (; is_digit(at, end); at++, has_digits = true) {
        fraction = 10.0 * fraction + (*at - '0');
        scale *= 10.0;
    }
    *mantissa = whole + fraction / scale;
    return has_digits ? at : NULL;
}

const char *hd_number_fault(HdSpan word, double *value) {
    int power = 0;
    if (word.end - word.begin > MAX_NUMBER_LENGTH)
        return "a number of at most 64 characters";
    const char *at = read_mantissa(skip_sign(word.begin, word.end), word.end, value);
    if (at != NULL)
        at = read_power(at, word.end, &power);
    if (at != word.end)
        return "a decimal number";
    const bool is_lost = power < -MAX_POWER || power > MAX_POWER;
    if (power != 0 && *value != 0.0)
        *value *= is_lost ? pow(10.0, power) : powers_of_ten[power + MAX_POWER];
    if (*value > HD_MAX_NUMBER)
        return "a number from -1e12 to 1e12";
    if (is_lost && *value >= HD_MIN_LENGTH)
        return "a power of ten from -19 to 19";
    if (is_lost)
        *value = 0.0;
    if (*word.begin == '-')
        *value = -*value;
    return NULL;
}

const char *hd_name_fault(HdSpan name) {
    if (name.begin == name.end)
        return "a name";
    for (const char *at = name.begin; at < name.end; at++)
        if ((unsigned char)*at < ' ' || *at == 0x7f)
            return "a name without control characters";
    return NULL;
}

/* ---- names ---- */

static int compare_names(const void *first, const void *second) {
    const HdSpan a = ((const HdName *)first)->text, b = ((const HdName *)second)->text;
    const size_t x = hd_span_size(a), y = hd_span_size(b);
    const int order = memcmp(a.begin, b.begin, x < y ? x : y);
    return order != 0 ? order : (x > y) - (x < y);
}

int hd_name_table_find(const HdNameTable *table, HdSpan name) {
    const HdName key = {.text = name};
    HdName *const *found = tfind(&key, &table->tree, compare_names);
    return found != NULL ? (int)(*found - table->names) : -1;
}

int hd_name_table_add(HdNameTable *table, HdSpan name, HdObjMemory *memory) {
    const size_t size = hd_span_size(name);
    const int number = hd_name_table_find(table, name);
    if (number >= 0)
        return number;
    if (table->count == HD_MAX_MESH_MATERIALS)
        return HD_NAME_TOO_MANY;
    if (table->names == NULL)
        table->names = hd_obj_allocate(memory, HD_MAX_MESH_MATERIALS, sizeof *table->names);
    char *copy = table->names != NULL ? hd_obj_allocate(memory, size + 1, 1) : NULL;
    if (copy == NULL)
        return HD_NAME_NO_MEMORY;
    memcpy(copy, name.begin, size);
    copy[size] = '\0';
    HdName *added = &table->names[table->count++];
    *added = (HdName){{copy, copy + size}, copy, table->count - 1};
    return tsearch(added, &table->tree, compare_names) != NULL ? table->count - 1
                                                               : HD_NAME_NO_MEMORY;
}

void hd_name_table_free(HdNameTable *table) {
    while (table->tree != NULL)
        tdelete(*(HdName **)table->tree, &table->tree, compare_names);
    for (int i = 0; i < table->count; i++)
        free(table->names[i].owned);
    free(table->names);
    *table = (HdNameTable){0};
}
