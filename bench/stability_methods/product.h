/* SPDX-License-Identifier: MIT */
/* The kernels' own results for a ray, a segment or a list of triangles at a time; compiled for
   float and for double. */
#ifndef HD_BENCH_PRODUCT_H
#define HD_BENCH_PRODUCT_H

#include "tables/table.h"

/* A face that a path hit. */
typedef struct HdBounce {
    int object; /* index among the scene's solids, or instances */
    int face;   /* index among the solid's own */
} HdBounce;

/* Counts of how often a ray enters and leaves a closed surface ahead of its origin; `first` is the
   least distance of entering, in units of the direction. */
typedef struct HdCrossings {
    int entered, left;
    double first;
} HdCrossings;

/* A lit point: `object` and `face` as kernels number them. */
typedef struct HdLitPoint {
    HdVec3 point; /* relative to the object */
    HdVec3 normal;
    int object, face;
    bool inside;
} HdLitPoint;

typedef struct HdProduct {
    HdPrecision precision;
    /* Follows a path of mirrors from the eye; returns the number of faces hit, at most `most`. */
    int (*mirror_path)(const HdTable *scene, const HdTable *frame, HdVec3 direction, int most,
                       HdBounce *bounces);
    /* Follows a ray from the eye straight through everything. */
    HdCrossings (*pierce)(const HdTable *scene, const HdTable *frame, HdVec3 direction);
    /* Tests every triangle, in the coordinates of a mesh, none of which exceeds 1. */
    HdCrossings (*cross_triangles)(HdVec3 (*corners)[3], int count, HdVec3 origin,
                                   HdVec3 direction);
    /* Returns the share of light number `light` that the point gets, where the ray tree looks. */
    double (*transmittance)(const HdTable *scene, const HdLitPoint *point, int light);
    /* Returns the radiance of a white diffuse point under all lights. */
    double (*radiance)(const HdTable *scene, const HdLitPoint *point);
} HdProduct;

extern const HdProduct hd_product_float, hd_product_double;

#endif
