/* SPDX-License-Identifier: MIT */
/* What the readers of OBJ and MTL files share: memory, of which a reading has a limit; words of
   lines; and numbers for names. */
#ifndef HD_MESH_OBJ_READING_H
#define HD_MESH_OBJ_READING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/error.h"
#include "mesh/mesh.h"

/* Start with all zeros but `most`. */
typedef struct HdObjMemory {
    size_t most; /* bytes at a time */
    size_t used;
    bool is_over;     /* something was refused because it would have been more, */
    bool has_refused; /* or for whatever reason */
} HdObjMemory;

/* As realloc(), of an array of `before` elements, which may be NULL, to `count` of them. NULL, with
   the array as it was, where there is no more. */
void *hd_obj_resize(HdObjMemory *memory, void *array, size_t size, size_t before, size_t count);

/* Not zeroed; at least a byte. */
void *hd_obj_allocate(HdObjMemory *memory, size_t count, size_t size);

/* Frees an array of so many bytes; NULL is allowed. Not needed for what lasts until the reading's
   end. */
void hd_obj_release(HdObjMemory *memory, void *array, size_t bytes);

/* Some bytes of a text, up to but without `end`. */
typedef struct HdSpan {
    const char *begin, *end;
} HdSpan;

/* For "%.*s" in messages: no more bytes than a reader wants to see, and no character cut in two. */
int hd_span_shown(HdSpan span);

static inline size_t hd_span_size(HdSpan span) {
    return (size_t)(span.end - span.begin);
}

static inline HdSpan hd_span_of(const char *text) {
    return (HdSpan){text, text + strlen(text)};
}

bool hd_span_is(HdSpan span, const char *text);

/* Takes the next word of a line; an empty one at the line's end. Words end at blanks and tabs. */
HdSpan hd_next_word(HdSpan *line);

/* The rest of a line without blanks and tabs around it. */
HdSpan hd_rest(HdSpan line);

/* What a word should have been to be a number: decimal, at most HD_MAX_NUMBER either way, not oddly
   long. NULL: it is one, and `*value` what it says, up to the rounding of a few operations; where
   the power of ten is below -19 or above 19, so that it is less than HD_MIN_LENGTH, 0. */
const char *hd_number_fault(HdSpan word, double *value);

/* What a name should have been: there, without control characters. NULL: it is. */
const char *hd_name_fault(HdSpan name);

typedef struct HdName {
    HdSpan text;
    char *owned; /* the same with a zero byte; who takes it leaves NULL */
} HdName;

/* All zeros: empty. */
typedef struct HdNameTable {
    int count;
    HdName *names; /* owned; room for HD_MAX_MESH_MATERIALS */
    void *tree;    /* tsearch()'s, of `names` */
} HdNameTable;

/* What hd_name_table_add returns instead of a number. */
enum { HD_NAME_NO_MEMORY = -1, HD_NAME_TOO_MANY = -2 };

/* The number of the name, which is added where it is new. */
int hd_name_table_add(HdNameTable *table, HdSpan name, HdObjMemory *memory);

/* The number of the name, or -1. */
int hd_name_table_find(const HdNameTable *table, HdSpan name);

void hd_name_table_free(HdNameTable *table);

/* The material of faces before the first `usemtl`. */
#define HD_OBJ_NO_MATERIAL "default"

/* Gives the mesh at `path` a material for each of the names, which are taken from there: as the
   libraries define it or, where none does, white and opaque. `libraries` are their names, each with
   a zero byte, in `size` bytes. What is not used is told in `notes`. False: the memory does not
   suffice. */
bool hd_obj_read_materials(HdMesh *mesh, const char *path, HdNameTable *names, char *libraries,
                           size_t size, HdObjMemory *memory, HdProblems *notes);

#endif
