/* SPDX-License-Identifier: MIT */
#include "mesh/obj/memory.h"

#include <stdint.h>
#include <stdlib.h>

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
