/* SPDX-License-Identifier: MIT */
/* What the studies share beside the product and the methods. */
#ifndef HD_BENCH_METHODS_H
#define HD_BENCH_METHODS_H

#include <stdbool.h>

#include "base/vector.h"
#include "triangle_tests.h"

/* Whether this processor runs the tests that are compiled with contraction. */
bool hd_can_contract(void);

static inline HdFloat3 hd_to_float(HdVec3 v) {
    return (HdFloat3){(float)v.x, (float)v.y, (float)v.z};
}

/* Rounded to float, and back. */
static inline HdVec3 hd_round(HdVec3 v) {
    return hd_vec3((double)(float)v.x, (double)(float)v.y, (double)(float)v.z);
}

#endif
