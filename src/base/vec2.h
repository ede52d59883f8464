/* SPDX-License-Identifier: MIT */
/* Vectors in a plane, in double precision. */
#ifndef HD_BASE_VEC2_H
#define HD_BASE_VEC2_H

#include <math.h>

typedef struct HdVec2 {
    double x, y;
} HdVec2;

static inline HdVec2 hd_sub2(HdVec2 a, HdVec2 b) {
    return (HdVec2){a.x - b.x, a.y - b.y};
}
/* a + t (b - a) */
static inline HdVec2 hd_mix2(HdVec2 a, HdVec2 b, double t) {
    return (HdVec2){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}
static inline double hd_dot2(HdVec2 a, HdVec2 b) {
    return a.x * b.x + a.y * b.y;
}
/* Positive where b is counterclockwise of a. */
static inline double hd_cross2(HdVec2 a, HdVec2 b) {
    return a.x * b.y - a.y * b.x;
}
static inline double hd_length2(HdVec2 a) {
    return sqrt(hd_dot2(a, a));
}

#endif
