/* SPDX-License-Identifier: MIT */
/* Finds faces of an OBJ file that coincide. */
#ifndef HD_MESH_OBJ_TWINS_H
#define HD_MESH_OBJ_TWINS_H

#include "mesh/obj_reading.h"

/* A face: its corners' vertices, `stride` numbers apart. */
typedef struct HdObjTwin {
    const int32_t *corners; /* NULL: none */
    int32_t count;
    uint32_t hash;
} HdObjTwin;

/* The faces of a file so far, of which no two coincide. */
typedef struct HdObjTwins {
    const HdVec3 *vertices;
    size_t stride, capacity; /* a power of two */
    HdObjTwin *table;        /* owned */
} HdObjTwins;

/* Prepares for `face_count` faces. Returns false if out of memory. */
bool hd_obj_twins_begin(HdObjTwins *twins, const HdVec3 *vertices, size_t stride, size_t face_count,
                        HdObjMemory *memory);

/* Returns whether the corners of an earlier face are at the same places, in the same order around
   the face or in the reverse. If not, adds the face, whose `corners` must last. */
bool hd_obj_is_twin(HdObjTwins *twins, const int32_t *corners, int32_t count);

void hd_obj_twins_end(HdObjTwins *twins, HdObjMemory *memory);

#endif
