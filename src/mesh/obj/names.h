/* SPDX-License-Identifier: MIT */
/* Numbers for names, in the order in which they first come up. */
#ifndef HD_MESH_OBJ_NAMES_H
#define HD_MESH_OBJ_NAMES_H

#include <stdint.h>

#include "mesh/obj/memory.h"
#include "mesh/obj/words.h"

/* All zeros: empty. */
typedef struct HdNameTable {
    int count;
    char **names;   /* owned; room for HD_MAX_MESH_MATERIALS */
    int32_t *sizes; /* owned; of the names, without the zero byte */
    int32_t *slots; /* owned; hashed; -1: empty */
} HdNameTable;

/* What hd_name_table_add returns instead of a number. */
enum { HD_NAME_NO_MEMORY = -1, HD_NAME_TOO_MANY = -2 };

/* The number of the name, which is added where it is new. */
int hd_name_table_add(HdNameTable *table, HdSpan name, HdObjMemory *memory);

/* The number of the name, or -1. */
int hd_name_table_find(const HdNameTable *table, HdSpan name);

void hd_name_table_free(HdNameTable *table);

#endif
