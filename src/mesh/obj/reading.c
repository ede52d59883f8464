/* SPDX-License-Identifier: MIT */
#include "mesh/obj/reading.h"

#include <math.h>
#include <stdlib.h>

#include "base/hash.h"
#include "base/limits.h"

void *hd_obj_resize(HdObjMemory *memory, void *array, size_t size, size_t before, size_t count) {
    const size_t others = memory->used - before * size;
    if (count > SIZE_MAX / size || count * size > memory->most ||
        others > memory->most - count * size) {
        memory->is_over = true;
        return NULL;
    }
    void *resized = realloc(array, count > 0 ? count * size : 1);
    if (resized != NULL)
        memory->used = others + count * size;
    return resized;
}

void *hd_obj_grow(HdObjMemory *memory, void *array, size_t size, size_t count, size_t *room) {
    if (count <= *room)
        return array;
    const size_t more = *room + *room / 2 + 16;
    const size_t wanted = count > more ? count : more;
    void *grown = hd_obj_resize(memory, array, size, *room, wanted);
    if (grown != NULL)
        *room = wanted;
    return grown;
}

void *hd_obj_allocate(HdObjMemory *memory, size_t count, size_t size) {
    return hd_obj_resize(memory, NULL, size, 0, count);
}

void hd_obj_release(HdObjMemory *memory, void *array, size_t bytes) {
    if (array != NULL)
        memory->used -= bytes;
    free(array);
}

HdStatus hd_obj_fail_memory(const HdObjMemory *memory, const char *path, HdError *error) {
    if (memory->is_over)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s: reading it takes more than the %zu bytes of memory that it may take",
                       path, memory->most);
    return hd_fail(error, HD_FAILED, "out of memory: no room to read the mesh %s", path);
}

/* ---- words ---- */

enum {
    MOST_SHOWN = 80,
    LONGEST_NUMBER = 64, /* longer ones might leave the range of double on their way */
    MOST_POWER = 19      /* of ten, either way */
};

static const double powers_of_ten[2 * MOST_POWER + 1] = {
    1e-19, 1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7,
    1e-6,  1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  1e0,   1e1,   1e2,   1e3,   1e4,  1e5,  1e6,
    1e7,   1e8,   1e9,   1e10,  1e11,  1e12,  1e13,  1e14,  1e15,  1e16,  1e17, 1e18, 1e19};

int hd_span_shown(HdSpan span) {
    const ptrdiff_t length = span.end - span.begin;
    int shown = length < MOST_SHOWN ? (int)length : MOST_SHOWN;
    while (shown > 0 && shown < length && ((unsigned char)span.begin[shown] & 0xc0) == 0x80)
        shown--;
    return shown;
}

bool hd_span_is(HdSpan span, const char *text) {
    const size_t length = strlen(text);
    return hd_span_size(span) == length && memcmp(span.begin, text, length) == 0;
}

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
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

static bool is_digit(const char *at, const char *end) {
    return at < end && *at >= '0' && *at <= '9';
}

static const char *skip_sign(const char *at, const char *end) {
    return at < end && (*at == '-' || *at == '+') ? at + 1 : at;
}

/* Reads "e-12" and the like, or nothing. NULL: something else. */
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

/* Reads digits with a point among them, those on either side of it as a whole number. NULL: there
   are no digits. */
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
    if (word.end - word.begin > LONGEST_NUMBER)
        return "a number of at most 64 characters";
    const char *at = read_mantissa(skip_sign(word.begin, word.end), word.end, value);
    if (at != NULL)
        at = read_power(at, word.end, &power);
    if (at != word.end)
        return "a decimal number";
    const bool is_lost = power < -MOST_POWER || power > MOST_POWER;
    if (power != 0 && *value != 0.0)
        *value *= is_lost ? pow(10.0, power) : powers_of_ten[power + MOST_POWER];
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

static bool is_separator(char c) {
    return c == '/' || c == '\\';
}

const char *hd_file_name_fault(HdSpan name) {
    if (hd_name_fault(name) != NULL)
        return hd_name_fault(name);
    if (is_separator(*name.begin) || (name.end - name.begin > 1 && name.begin[1] == ':'))
        return "a name that counts from this file's folder";
    for (const char *at = name.begin; at < name.end;) {
        const char *end = at;
        while (end < name.end && !is_separator(*end))
            end++;
        if (hd_span_is((HdSpan){at, end}, ".."))
            return "a name in this file's folder or below it";
        at = end < name.end ? end + 1 : end;
    }
    return NULL;
}

void hd_fix_separators(char *name) {
    for (; *name != '\0'; name++)
        if (*name == '\\')
            *name = '/';
}

/* ---- names ---- */

enum {
    SLOTS = 4 * HD_MAX_MESH_MATERIALS,
    /* With a quarter of the slots in use, only names made to collide need that many. They would
       make each look-up as long as they like. */
    MOST_PROBES = 256
};

static bool allocate_names(HdNameTable *table, HdObjMemory *memory) {
    table->names = hd_obj_allocate(memory, HD_MAX_MESH_MATERIALS, sizeof *table->names);
    table->slots = hd_obj_allocate(memory, SLOTS, sizeof *table->slots);
    if (table->slots != NULL)
        memset(table->slots, -1, SLOTS * sizeof *table->slots);
    return table->names != NULL && table->slots != NULL;
}

void hd_name_table_free(HdNameTable *table) {
    for (int i = 0; i < table->count; i++)
        free(table->names[i]);
    free(table->names);
    free(table->slots);
    *table = (HdNameTable){0};
}

/* The slot that has the name or is free for it; NULL: too many probes. */
static int32_t *slot_of(const HdNameTable *table, HdSpan name) {
    const size_t size = hd_span_size(name);
    size_t at = hd_hash_bytes(HD_HASH_START, name.begin, size) % SLOTS;
    for (int i = 0; i < MOST_PROBES; i++) {
        int32_t *slot = &table->slots[at];
        const char *other = *slot >= 0 ? table->names[*slot] : NULL;
        /* Of a long name no more is looked at than this one has: short ones collide with many. */
        if (other == NULL || (strncmp(other, name.begin, size) == 0 && other[size] == '\0'))
            return slot;
        at = (at + 1) % SLOTS;
    }
    return NULL;
}

int hd_name_table_find(const HdNameTable *table, HdSpan name) {
    const int32_t *slot = table->slots != NULL ? slot_of(table, name) : NULL;
    return slot != NULL ? *slot : -1;
}

int hd_name_table_add(HdNameTable *table, HdSpan name, HdObjMemory *memory) {
    const size_t size = hd_span_size(name);
    if (table->slots == NULL && !allocate_names(table, memory)) {
        hd_name_table_free(table);
        return HD_NAME_NO_MEMORY;
    }
    int32_t *slot = slot_of(table, name);
    if (slot != NULL && *slot >= 0)
        return *slot;
    if (slot == NULL || table->count == HD_MAX_MESH_MATERIALS)
        return HD_NAME_TOO_MANY;
    char *copy = hd_obj_allocate(memory, size + 1, 1);
    if (copy == NULL)
        return HD_NAME_NO_MEMORY;
    memcpy(copy, name.begin, size);
    copy[size] = '\0';
    table->names[table->count] = copy;
    *slot = table->count;
    return table->count++;
}
