/* SPDX-License-Identifier: MIT */
/* Arrays that grow with what is put into them. */
#ifndef HD_BASE_GROWTH_H
#define HD_BASE_GROWTH_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Puts a copy of `element`, of `size` bytes, behind the `count` elements of an array, which grows
   where it must; `array` is the address of the pointer to it, and `capacity` what it has room for.
   False where there is no memory: then all is as it was. */
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

/* The array, with room for `count` elements, which are lost where it must grow; `capacity` is what
   it has room for. NULL where there is no memory, or none was asked for yet. */
static inline void *hd_reserved(void *array, size_t element, int count, int *capacity) {
    if (count <= *capacity)
        return array;
    free(array);
    array = calloc((size_t)count, element);
    *capacity = array != NULL ? count : 0;
    return array;
}

#endif
