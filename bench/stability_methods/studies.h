/* SPDX-License-Identifier: MIT */
/* The studies of hedron_stability_methods. Each prints lines as main.c describes and returns false
   if memory runs out. */
#ifndef HD_BENCH_STUDIES_H
#define HD_BENCH_STUDIES_H

#include <stdbool.h>

#include "base/vector.h"
#include "triangle_tests.h"

/* The size of things, and their distance from the world's origin in sizes. */
typedef struct HdPlace {
    double scale, offset;
} HdPlace;

/* Scales at the origin, then offsets of scale 1, then, for the paths alone, all others. */
extern const HdPlace hd_places[];
extern const int hd_place_count, hd_all_place_count;

/* The direction of offsets; unit, with no round numbers. */
#define HD_OFFSET_X 0.6297
#define HD_OFFSET_Y -0.5421
#define HD_OFFSET_Z 0.5562

/* Runs `count` rays, paths or segments for each place. */
bool hd_study_crossings(int count);
bool hd_study_paths(int count);
bool hd_study_shadows(int count);

/* Returns whether this processor runs the tests that are compiled with contraction. */
bool hd_can_contract(void);

static inline HdFloat3 hd_to_float(HdVec3 v) {
    return (HdFloat3){(float)v.x, (float)v.y, (float)v.z};
}

/* Rounds to float, and back. */
static inline HdVec3 hd_round(HdVec3 v) {
    return hd_vec3((double)(float)v.x, (double)(float)v.y, (double)(float)v.z);
}

#endif
