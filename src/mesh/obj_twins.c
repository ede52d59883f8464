/* SPDX-License-Identifier: MIT */
#include "mesh/obj_twins.h"

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

/* A 64-bit finaliser (Steele, Lea and Flood 2014, Fast Splittable Pseudorandom Number Generators).
 */
static uint64_t mix(uint64_t bits) {
    bits = (bits ^ bits >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    bits = (bits ^ bits >> 27) * UINT64_C(0x94d049bb133111eb);
    return bits ^ bits >> 31;
}

static HdVec3 place_of(const HdObjTwins *twins, const int32_t *corners, int32_t number) {
    return twins->vertices[corners[(size_t)number * twins->stride]];
}

/* Equal for 0 and -0, which are one place. */
static uint64_t hash_of_place(HdVec3 place) {
    const double numbers[3] = {place.x + 0.0, place.y + 0.0, place.z + 0.0};
    uint64_t bits[3];
    memcpy(bits, numbers, sizeof bits);
    return mix(bits[0] * UINT64_C(0x9e3779b97f4a7c15) + bits[1] * UINT64_C(0xc2b2ae3d27d4eb4f) +
               bits[2] * UINT64_C(0x165667b19e3779f9));
}

/* A sum over the edges: the same from any corner on and in both directions. */
static uint64_t hash_of_face(const HdObjTwins *twins, const int32_t *corners, int32_t count) {
    uint64_t last = hash_of_place(place_of(twins, corners, count - 1)), sum = 0;
    for (int32_t i = 0; i < count; i++) {
        const uint64_t next = hash_of_place(place_of(twins, corners, i));
        sum += mix(last + next);
        last = next;
    }
    return mix(sum);
}

static bool is_same_place(HdVec3 a, HdVec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Returns whether the corners of `a` are those of `b` from its corner `first` on, in steps. */
static bool matches(const HdObjTwins *twins, const int32_t *a, const int32_t *b, int32_t count,
                    int32_t first, int32_t step) {
    for (int32_t i = 0; i < count; i++)
        if (!is_same_place(place_of(twins, a, i),
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
