/* SPDX-License-Identifier: MIT */
/* Vectors in double precision, for the host. */
#ifndef HD_BASE_VECTOR_H
#define HD_BASE_VECTOR_H

#include <math.h>

typedef struct HdVec3 {
    double x, y, z;
} HdVec3;

static inline HdVec3 hd_vec3(double x, double y, double z) {
    return (HdVec3){x, y, z};
}
static inline HdVec3 hd_add(HdVec3 a, HdVec3 b) {
    return hd_vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline HdVec3 hd_sub(HdVec3 a, HdVec3 b) {
    return hd_vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline HdVec3 hd_scale(HdVec3 a, double s) {
    return hd_vec3(a.x * s, a.y * s, a.z * s);
}
static inline double hd_dot(HdVec3 a, HdVec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline HdVec3 hd_cross(HdVec3 a, HdVec3 b) {
    return hd_vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double hd_length(HdVec3 a) {
    return sqrt(hd_dot(a, a));
}
/* Returns the largest absolute coordinate. */
static inline double hd_largest(HdVec3 a) {
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}
/* Return the minimum and the maximum of each coordinate. */
static inline HdVec3 hd_minimum(HdVec3 a, HdVec3 b) {
    return hd_vec3(fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z));
}
static inline HdVec3 hd_maximum(HdVec3 a, HdVec3 b) {
    return hd_vec3(fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z));
}
static inline HdVec3 hd_normalize(HdVec3 a) {
    return hd_scale(a, 1.0 / hd_length(a));
}

typedef struct HdVec2 {
    double x, y;
} HdVec2;

#endif
