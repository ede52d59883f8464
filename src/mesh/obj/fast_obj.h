/* SPDX-License-Identifier: MIT */
/* The library fast_obj, with memory that has a limit. */
#ifndef HD_MESH_OBJ_FAST_OBJ_H
#define HD_MESH_OBJ_FAST_OBJ_H

#include <fast_obj.h>

#include "mesh/obj/memory.h"

typedef enum HdFastObjEnd {
    HD_FAST_OBJ_DONE,
    HD_FAST_OBJ_NO_MEMORY,
    HD_FAST_OBJ_TOO_LONG /* an array of its own would have more than 4 GiB */
} HdFastObjEnd;

/* Reads a mesh by the callbacks. All of it is the memory's: it is never given to
   fast_obj_destroy(). Unless it is done, `*mesh` is NULL. */
HdFastObjEnd hd_fast_obj_read(fastObjMesh **mesh, const fastObjCallbacks *callbacks, void *user,
                              HdObjMemory *memory);

/* Releases an array of a mesh before the rest; `array` may be NULL. */
void hd_fast_obj_release(HdObjMemory *memory, void *array);

#endif
