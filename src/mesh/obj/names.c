/* SPDX-License-Identifier: MIT */
#include "mesh/obj/names.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "mesh/mesh.h"

enum {
    SLOTS = 4 * HD_MAX_MESH_MATERIALS,
    /* With a quarter of the slots in use, only names made to collide need that many. They would
       make each look-up as long as they like. */
    MOST_PROBES = 256
};

static bool allocate(HdNameTable *table, HdObjMemory *memory) {
    table->names = hd_obj_allocate(memory, HD_MAX_MESH_MATERIALS, sizeof *table->names);
    table->sizes = hd_obj_allocate(memory, HD_MAX_MESH_MATERIALS, sizeof *table->sizes);
    table->slots = hd_obj_allocate(memory, SLOTS, sizeof *table->slots);
    if (table->slots != NULL)
        memset(table->slots, -1, SLOTS * sizeof *table->slots);
    return table->names != NULL && table->sizes != NULL && table->slots != NULL;
}

void hd_name_table_free(HdNameTable *table) {
    for (int i = 0; i < table->count; i++)
        free(table->names[i]);
    free(table->names);
    free(table->sizes);
    free(table->slots);
    *table = (HdNameTable){0};
}

/* Long names are not looked at for each short one that collides with them. */
static bool is_name(const HdNameTable *table, int32_t number, HdSpan name, size_t size) {
    return (size_t)table->sizes[number] == size &&
           memcmp(table->names[number], name.begin, size) == 0;
}

/* The slot that has the name or is free for it; NULL: too many probes. */
static int32_t *slot_of(const HdNameTable *table, HdSpan name) {
    const size_t size = (size_t)(name.end - name.begin);
    size_t at = hd_hash_bytes(HD_HASH_START, name.begin, size) % SLOTS;
    for (int i = 0; i < MOST_PROBES; i++) {
        int32_t *slot = &table->slots[at];
        if (*slot < 0 || is_name(table, *slot, name, size))
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
    const size_t size = (size_t)(name.end - name.begin);
    if (table->slots == NULL && !allocate(table, memory)) {
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
    table->sizes[table->count] = (int32_t)size;
    *slot = table->count;
    return table->count++;
}
