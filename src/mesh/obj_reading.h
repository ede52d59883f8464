/* SPDX-License-Identifier: MIT */
/* Shared by the readers of OBJ and MTL files: limited memory, words of lines, numbered names. */
#ifndef HD_MESH_OBJ_READING_H
#define HD_MESH_OBJ_READING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/error.h"
#include "mesh/mesh.h"

/* Zero-initialise, except `most`. */
typedef struct HdObjMemory {
    size_t max_bytes; /* bytes in use at once */
    size_t used;
    bool is_over;     /* an allocation exceeded `most`, */
    bool has_refused; /* or failed for any reason */
} HdObjMemory;

/* Resizes as realloc() an array of `before` elements, which may be NULL, to `count`. Returns NULL
   on failure, with the array unchanged. */
void *hd_obj_resize(HdObjMemory *memory, void *array, size_t size, size_t before, size_t count);

/* Allocates at least a byte, not zeroed. */
void *hd_obj_allocate(HdObjMemory *memory, size_t count, size_t size);

/* Frees an array of `bytes` bytes; NULL is allowed. Arrays that last until the end of reading do
   not need it. */
void hd_obj_release(HdObjMemory *memory, void *array, size_t bytes);

/* Bytes of a text, up to but excluding `end`. */
typedef struct HdSpan {
    const char *begin, *end;
} HdSpan;

/* Returns the length to print with "%.*s": limited, and never within a character. */
int hd_span_shown(HdSpan span);

static inline size_t hd_span_size(HdSpan span) {
    return (size_t)(span.end - span.begin);
}

static inline HdSpan hd_span_of(const char *text) {
    return (HdSpan){text, text + strlen(text)};
}

bool hd_span_is(HdSpan span, const char *text);

static inline bool hd_span_equals(HdSpan a, HdSpan b) {
    return hd_span_size(a) == hd_span_size(b) && memcmp(a.begin, b.begin, hd_span_size(a)) == 0;
}

/* Takes the next word of a line, up to a blank, tab or end mark (0x1A); empty at the end. */
HdSpan hd_next_word(HdSpan *line);

/* Returns the rest of a line without blanks and tabs around it. */
HdSpan hd_rest(HdSpan line);

/* Returns a name without " # ..." behind it. */
HdSpan hd_without_comment(HdSpan name);

/* Returns the size of the byte order mark that the text begins with; 0: none. */
size_t hd_mark_size(HdSpan text);

/* Returns the number of zero bytes, end marks (0x1A), blanks and line ends that the text begins
   with. */
size_t hd_padding_size(HdSpan text);

/* Parses a number. Returns NULL, or the expected form: decimal, magnitude at most HD_MAX_NUMBER, at
   most 64 characters. `*value` is exact up to the rounding of a few operations. It is 0 if its
   power of ten is below -19 or above 19 and it is less than HD_MIN_LENGTH. */
const char *hd_number_fault(HdSpan word, double *value);

/* Returns the expected form of a name, not empty and without control characters; NULL: it is
   valid. */
const char *hd_name_fault(HdSpan name);

typedef struct HdName {
    HdSpan text;
    char *owned;      /* zero-terminated copy; a new owner sets NULL */
    int32_t stand_in; /* number of the material that faces with this name get */
} HdName;

/* Zero-initialise. */
typedef struct HdNameTable {
    int count;
    HdName *names; /* owned; capacity HD_MAX_MESH_MATERIALS */
    void *tree;    /* of tsearch(), over `names` */
} HdNameTable;

/* Failures of hd_name_table_add. */
enum { HD_NAME_NO_MEMORY = -1, HD_NAME_TOO_MANY = -2 };

/* Returns the number of the name; adds a new one. */
int hd_name_table_add(HdNameTable *table, HdSpan name, HdObjMemory *memory);

/* Returns the number of the name, or -1. */
int hd_name_table_find(const HdNameTable *table, HdSpan name);

void hd_name_table_free(HdNameTable *table);

/* The material of faces before the first `usemtl`. */
#define HD_OBJ_NO_MATERIAL "default"

/* The options of a picture: it shows at scale * (u, v) + offset. */
typedef struct HdMapOptions {
    double scale[2], offset[2];
    bool is_clamped;
} HdMapOptions;

/* Takes the options from the front of a map statement; those without effect here are skipped.
   Returns false, with the option in `fault`, if one is unknown or lacks its values. */
bool hd_take_map_options(HdSpan *line, HdMapOptions *options, HdSpan *fault);

/* Moves `names` to the mesh at `path` as materials, defined by the libraries or else white and
   opaque. A name that no library defines with the comment behind it gets a stand-in without, among
   further materials. Sets an owned array of the options of each material's pictures. `libraries`
   are zero-terminated names in `size` bytes. Reports wrong statements in `faults`, others without
   effect in `notes`. Returns false if out of memory. */
bool hd_obj_read_materials(HdMesh *mesh, const char *path, HdNameTable *names,
                           const char *libraries, size_t size, HdMapOptions **options,
                           HdObjMemory *memory, HdProblems *faults, HdProblems *notes);

/* Applies the options of each material's pictures to a mesh with its triangles. Pictures do not
   repeat if all texture coordinates of their material lie within them. Returns false if out of
   memory. */
bool hd_obj_place_pictures(HdMesh *mesh, const HdMapOptions *options, HdObjMemory *memory);

#endif
