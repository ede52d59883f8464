/* SPDX-License-Identifier: MIT */
/* Memory of one reading, of which there is a limit. free() frees it. */
#ifndef HD_MESH_OBJ_MEMORY_H
#define HD_MESH_OBJ_MEMORY_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include "base/error.h"

/* Start with all zeros but `most`. */
typedef struct HdObjMemory {
    size_t most; /* bytes at a time */
    size_t used;
    bool is_over; /* something was refused because it would have been more */
} HdObjMemory;

/* As realloc(), of an array of `before` elements, which may be NULL, to `count` of them. NULL, with
   the array as it was, where there is no more. */
void *hd_obj_resize(HdObjMemory *memory, void *array, size_t size, size_t before, size_t count);

/* The array with room for `count` elements, and some more where it has to grow; `*room` is what it
   has room for. NULL as above. */
void *hd_obj_grow(HdObjMemory *memory, void *array, size_t size, size_t count, size_t *room);

/* Puts a copy of `element`, of `size` bytes, behind the `*count` elements of an array, which grows
   where it must; `array` is the address of the pointer to it. False where there is no more. */
static inline bool hd_obj_append(HdObjMemory *memory, void *array, size_t size, size_t *count,
                                 size_t *room, const void *element) {
    char *elements;
    memcpy(&elements, array, sizeof elements);
    if (*count == *room) {
        elements = hd_obj_grow(memory, elements, size, *count + 1, room);
        if (elements == NULL)
            return false;
        memcpy(array, &elements, sizeof elements);
    }
    memcpy(elements + (*count)++ * size, element, size);
    return true;
}

/* Not zeroed; at least a byte. */
void *hd_obj_allocate(HdObjMemory *memory, size_t count, size_t size);

/* Frees an array of so many bytes; NULL is allowed. Not needed for what lasts until the reading's
   end. */
void hd_obj_release(HdObjMemory *memory, void *array, size_t bytes);

/* Tells why there was no memory to read the mesh at `path`. */
HdStatus hd_obj_fail_memory(const HdObjMemory *memory, const char *path, HdError *error);

#endif
