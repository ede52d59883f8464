/* SPDX-License-Identifier: MIT */
#include "mesh/obj/memory.h"

#include <stdint.h>
#include <stdlib.h>

/* Before each block; the list is doubly linked so that a block can leave it. */
typedef struct HdObjBlock {
    struct HdObjBlock *next, *last;
    size_t bytes;
    max_align_t contents[];
} HdObjBlock;

static HdObjBlock *block_of(const void *contents) {
    return (HdObjBlock *)((char *)contents - offsetof(HdObjBlock, contents));
}

static bool has_room(HdObjMemory *memory, size_t bytes, size_t released) {
    if (bytes <= memory->most && memory->used - released <= memory->most - bytes)
        return true;
    memory->is_over = true;
    return false;
}

static void link_block(HdObjMemory *memory, HdObjBlock *block) {
    block->last = NULL;
    block->next = memory->blocks;
    if (block->next != NULL)
        block->next->last = block;
    memory->blocks = block;
    memory->used += block->bytes;
}

static void unlink_block(HdObjMemory *memory, HdObjBlock *block) {
    if (block->last != NULL)
        block->last->next = block->next;
    else
        memory->blocks = block->next;
    if (block->next != NULL)
        block->next->last = block->last;
    memory->used -= block->bytes;
}

void *hd_obj_reallocate(HdObjMemory *memory, void *block, size_t bytes) {
    HdObjBlock *old = block != NULL ? block_of(block) : NULL;
    if (bytes > SIZE_MAX - sizeof(HdObjBlock) ||
        !has_room(memory, bytes, old != NULL ? old->bytes : 0))
        return NULL;
    if (old != NULL)
        unlink_block(memory, old);
    HdObjBlock *grown = realloc(old, sizeof *grown + bytes);
    if (grown == NULL) {
        if (old != NULL)
            link_block(memory, old);
        return NULL;
    }
    grown->bytes = bytes;
    link_block(memory, grown);
    return grown->contents;
}

size_t hd_obj_block_size(const void *block) {
    return block_of(block)->bytes;
}

void hd_obj_release(HdObjMemory *memory, void *block) {
    if (block == NULL)
        return;
    HdObjBlock *own = block_of(block);
    unlink_block(memory, own);
    free(own);
}

void *hd_obj_allocate_result(HdObjMemory *memory, size_t count, size_t size) {
    if (count > SIZE_MAX / size || !has_room(memory, count * size, 0))
        return NULL;
    void *result = malloc(count > 0 ? count * size : 1);
    if (result != NULL)
        memory->used += count * size;
    return result;
}

HdStatus hd_obj_fail_memory(const HdObjMemory *memory, const char *path, HdError *error) {
    if (memory->is_over)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s: reading it takes more than the %zu bytes of memory that it may take",
                       path, memory->most);
    return hd_fail(error, HD_FAILED, "out of memory: no room to read the mesh %s", path);
}

void hd_obj_release_all(HdObjMemory *memory) {
    HdObjBlock *next;
    for (HdObjBlock *block = memory->blocks; block != NULL; block = next) {
        next = block->next;
        memory->used -= block->bytes;
        free(block);
    }
    memory->blocks = NULL;
}
