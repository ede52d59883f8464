/* SPDX-License-Identifier: MIT */
#include <setjmp.h>

#include "mesh/obj/memory.h"

static void *limited_reallocate(void *block, size_t bytes);
static void limited_release(void *block);

#define FAST_OBJ_REALLOC limited_reallocate
#define FAST_OBJ_FREE    limited_release
#define FAST_OBJ_IMPLEMENTATION
#include "mesh/obj/fast_obj.h"

/* fast_obj goes on, wrongly, where it gets no memory. So it is left by a jump; all that it has is
   the memory's. */
typedef struct Reader {
    HdObjMemory *memory;
    HdFastObjEnd end;
    jmp_buf stop;
} Reader;

/* Its functions for memory know nothing of who called it. */
static _Thread_local Reader *reader;

static void *limited_reallocate(void *block, size_t bytes) {
    /* It reckons sizes with 32 bits, and its arrays only grow. One that would leave them asks for
       less than it has: for 3/2 of that, less 4 GiB. */
    if (block != NULL && bytes <= hd_obj_block_size(block))
        reader->end = HD_FAST_OBJ_TOO_LONG;
    void *grown =
        reader->end == HD_FAST_OBJ_DONE ? hd_obj_reallocate(reader->memory, block, bytes) : NULL;
    if (grown != NULL)
        return grown;
    if (reader->end == HD_FAST_OBJ_DONE)
        reader->end = HD_FAST_OBJ_NO_MEMORY;
    longjmp(reader->stop, 1);
}

static void limited_release(void *block) {
    hd_obj_release(reader->memory, block);
}

HdFastObjEnd hd_fast_obj_read(fastObjMesh **mesh, const fastObjCallbacks *callbacks, void *user,
                              HdObjMemory *memory) {
    Reader own = {.memory = memory};
    reader = &own;
    *mesh = NULL;
    /* No separator in the name: names of libraries reach the callbacks as they are in the file. */
    if (setjmp(own.stop) == 0)
        *mesh = fast_obj_read_with_callbacks("", callbacks, user);
    reader = NULL;
    return own.end;
}

void hd_fast_obj_release(HdObjMemory *memory, void *array) {
    if (array != NULL)
        hd_obj_release(memory, (fastObjUInt *)array - 2);
}
