/* SPDX-License-Identifier: MIT */
/* Growing arrays. */
#ifndef HD_BASE_GROWTH_H
#define HD_BASE_GROWTH_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Appends a copy of `element`, of `size` bytes, to an array of `count` elements. `array` is the
   address of its pointer; the array grows beyond `capacity` elements if needed. Returns false if
   out of memory, with nothing changed. */
static inline bool hd_append(void *array, size_t size, int *count, int *capacity,
                             const void *element) {
    char *elements;
    memcpy(&elements, array, sizeof elements);
    if (*count == *capacity) {
        const int more = *count < 32 ? 64 : 2 * *count;
        char *grown = *count > 1 << 29 ? NULL : realloc(elements, (size_t)more * size);
        if (grown == NULL)
            return false;
        memcpy(array, &grown, sizeof grown);
        elements = grown;
        *capacity = more;
    }
    memcpy(elements + (size_t)(*count)++ * size, element, size);
    return true;
}

/* Returns the array with a capacity of at least `count` elements. Growing discards the elements and
   zeroes the new ones. Returns NULL if out of memory or if nothing was reserved yet. */
static inline void *hd_reserved(void *array, size_t element, int count, int *capacity) {
    if (count <= *capacity)
        return array;
    free(array);
    array = calloc((size_t)count, element);
    *capacity = array != NULL ? count : 0;
    return array;
}

#endif
