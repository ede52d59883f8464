/* SPDX-License-Identifier: MIT */
#include "mesh/places.h"

#include <stdlib.h>
#include <string.h>

uint64_t hd_hash_of_place(HdVec3 place) {
    const double numbers[3] = {place.x + 0.0, place.y + 0.0, place.z + 0.0};
    uint64_t bits[3];
    memcpy(bits, numbers, sizeof bits);
    return hd_mix_bits(bits[0] * UINT64_C(0x9e3779b97f4a7c15) +
                       bits[1] * UINT64_C(0xc2b2ae3d27d4eb4f) +
                       bits[2] * UINT64_C(0x165667b19e3779f9));
}

bool hd_find_places(const HdMesh *mesh, int32_t *place_of, int *count) {
    const HdVec3 *vertices = mesh->vertices;
    size_t capacity = 2;
    while (capacity < 2 * (size_t)mesh->vertex_count)
        capacity *= 2;
    int32_t *first = calloc(capacity, sizeof *first); /* vertex of each place, plus 1; 0: none */
    *count = 0;
    for (int32_t i = 0; i < mesh->vertex_count && first != NULL; i++) {
        size_t at = (size_t)hd_hash_of_place(vertices[i]) & (capacity - 1);
        while (first[at] != 0 && !hd_is_same_place(vertices[first[at] - 1], vertices[i]))
            at = (at + 1) & (capacity - 1);
        if (first[at] == 0) {
            first[at] = i + 1;
            place_of[i] = (*count)++;
        } else {
            place_of[i] = place_of[first[at] - 1];
        }
    }
    free(first);
    return first != NULL;
}
