/* SPDX-License-Identifier: MIT */
/* Memory of one reading: limited, and given back in one go. */
#ifndef HD_MESH_OBJ_MEMORY_H
#define HD_MESH_OBJ_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

/* Start with all zeros but `most`. */
typedef struct HdObjMemory {
    size_t most; /* bytes at a time */
    size_t used;
    bool is_over; /* something was refused because it would have been more */
    struct HdObjBlock *blocks;
} HdObjMemory;

/* As realloc(), of blocks from here. NULL, with the old block as it was, where there is no more. */
void *hd_obj_reallocate(HdObjMemory *memory, void *block, size_t bytes);

/* What the block was asked for with. */
size_t hd_obj_block_size(const void *block);

/* `block` may be NULL. */
void hd_obj_release(HdObjMemory *memory, void *block);

/* Memory that counts here, and that free() frees, for what outlives the reading; at least a byte,
   not zeroed. */
void *hd_obj_allocate_result(HdObjMemory *memory, size_t count, size_t size);

/* Tells why there was no memory to read the mesh at `path`. */
HdStatus hd_obj_fail_memory(const HdObjMemory *memory, const char *path, HdError *error);

/* Releases every block. */
void hd_obj_release_all(HdObjMemory *memory);

#endif
