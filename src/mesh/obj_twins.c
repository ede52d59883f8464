/* SPDX-License-Identifier: MIT */
#include "mesh/obj_twins.h"

#include "mesh/places.h"

bool hd_obj_twins_begin(HdObjTwins *twins, const HdVec3 *vertices, size_t stride, size_t face_count,
                        HdObjMemory *memory) {
    *twins = (HdObjTwins){.vertices = vertices, .stride = stride, .capacity = 1};
    while (twins->capacity < face_count + face_count / 2 + 1)
        twins->capacity *= 2;
    twins->table = hd_obj_allocate(memory, twins->capacity, sizeof *twins->table);
    if (twins->table != NULL)
        memset(twins->table, 0, twins->capacity * sizeof *twins->table);
    return twins->table != NULL;
}

void hd_obj_twins_end(HdObjTwins *twins, HdObjMemory *memory) {
    hd_obj_release(memory, twins->table, twins->capacity * sizeof *twins->table);
    twins->table = NULL;
}

static HdVec3 place_of(const HdObjTwins *twins, const int32_t *corners, int32_t number) {
    return twins->vertices[corners[(size_t)number * twins->stride]];
}

/* A sum over the edges: the same from any corner on and in both directions. */
static uint64_t hash_of_face(const HdObjTwins *twins, const int32_t *corners, int32_t count) {
    uint64_t last = hd_hash_of_place(place_of(twins, corners, count - 1)), sum = 0;
    for (int32_t i = 0; i < count; i++) {
        const uint64_t next = hd_hash_of_place(place_of(twins, corners, i));
        sum += hd_mix_bits(last + next);
        last = next;
    }
    return hd_mix_bits(sum);
}

/* Returns whether the corners of `a` are those of `b` from its corner `first` on, in steps. */
static bool matches(const HdObjTwins *twins, const int32_t *a, const int32_t *b, int32_t count,
                    int32_t first, int32_t step) {
    for (int32_t i = 0; i < count; i++)
        if (!hd_is_same_place(place_of(twins, a, i),
                              place_of(twins, b, (first + i * step + count) % count)))
            return false;
    return true;
}

static bool coincide(const HdObjTwins *twins, const int32_t *a, const int32_t *b, int32_t count) {
    for (int32_t first = 0; first < count; first++)
        if (matches(twins, a, b, count, first, 1) || matches(twins, a, b, count, first, -1))
            return true;
    return false;
}

bool hd_obj_is_twin(HdObjTwins *twins, const int32_t *corners, int32_t count) {
    const uint64_t hash = hash_of_face(twins, corners, count);
    const uint32_t tag = (uint32_t)(hash >> 32);
    size_t at = (size_t)hash & (twins->capacity - 1);
    for (; twins->table[at].corners != NULL; at = (at + 1) & (twins->capacity - 1)) {
        const HdObjTwin *other = &twins->table[at];
        if (other->hash == tag && other->count == count &&
            coincide(twins, corners, other->corners, count))
            return true;
    }
    twins->table[at] = (HdObjTwin){corners, count, tag};
    return false;
}
