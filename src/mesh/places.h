/* SPDX-License-Identifier: MIT */
/* Vertices with equal coordinates count as one place; -0 equals 0. */
#ifndef HD_MESH_PLACES_H
#define HD_MESH_PLACES_H

#include <stdbool.h>
#include <stdint.h>

#include "mesh/mesh.h"

/* Returns the bits in a random order, so that any of them may choose a row of a table. */
static inline uint64_t hd_mix_bits(uint64_t bits) {
    /* Steele, Lea and Flood 2014, Fast Splittable Pseudorandom Number Generators */
    bits = (bits ^ bits >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    bits = (bits ^ bits >> 27) * UINT64_C(0x94d049bb133111eb);
    return bits ^ bits >> 31;
}

uint64_t hd_hash_of_place(HdVec3 place);

static inline bool hd_is_same_place(HdVec3 a, HdVec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Numbers the places in the order in which vertices first use them; `place_of` receives that of
   each vertex, `*count` how many there are. Returns false if out of memory. */
bool hd_find_places(const HdMesh *mesh, int32_t *place_of, int *count);

#endif
