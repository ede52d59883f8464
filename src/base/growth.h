/* SPDX-License-Identifier: MIT */
/* Arrays that grow with what is put into them. */
#ifndef HD_BASE_GROWTH_H
#define HD_BASE_GROWTH_H

#include <stdlib.h>

/* The array, with room for another element after the `count` that it has; `room` is what it has
   room for. NULL where there is no memory: then the array is as it was. */
static inline void *hd_grown(void *array, size_t element, int count, int *room) {
    if (count < *room)
        return array;
    if (count > 1 << 29)
        return NULL;
    int more = count < 32 ? 64 : 2 * count;
    void *grown = realloc(array, (size_t)more * element);
    if (grown != NULL)
        *room = more;
    return grown;
}

/* The array, with room for `count` elements, which are lost where it must grow; `room` is what it
   has room for. NULL where there is no memory, or none was asked for yet. */
static inline void *hd_reserved(void *array, size_t element, int count, int *room) {
    if (count <= *room)
        return array;
    free(array);
    array = calloc((size_t)count, element);
    *room = array != NULL ? count : 0;
    return array;
}

#endif
