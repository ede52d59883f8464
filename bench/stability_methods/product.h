/* SPDX-License-Identifier: MIT */
/* What the kernels themselves find, for a ray, a segment or a list of triangles at a time; compiled
   for float and for double. */
#ifndef HD_BENCH_PRODUCT_H
#define HD_BENCH_PRODUCT_H

#include "tables/table.h"

/* A face that a path met. */
typedef struct HdBounce {
    int object; /* of the scene's solids, or instances */
    int face;   /* of its own */
} HdBounce;

/* How often a ray enters and leaves a closed surface ahead of its origin; `first` is the least
   distance of entering, in units of the direction. */
typedef struct HdCrossings {
    int entered, left;
    double first;
} HdCrossings;

/* A point that is lit; `object` and `face` as kernels number them. */
typedef struct HdLitPoint {
    HdVec3 point; /* relative to the object */
    HdVec3 normal;
    int object, face;
    bool inside;
} HdLitPoint;

typedef struct HdProduct {
    HdPrecision precision;
    /* Follows a path of mirrors from the eye; returns how many faces it met, at most `most`. */
    int (*mirror_path)(const HdTable *scene, const HdTable *frame, HdVec3 direction, int most,
                       HdBounce *bounces);
    /* Follows a ray from the eye straight through everything. */
    HdCrossings (*pierce)(const HdTable *scene, const HdTable *frame, HdVec3 direction);
    /* Tries every triangle, in the coordinates of a mesh, none of which exceeds 1. */
    HdCrossings (*cross_triangles)(HdVec3 (*corners)[3], int count, HdVec3 origin,
                                   HdVec3 direction);
    /* What light number `light` sends through to the point, 0 to 1; where the ray tree looks. */
    double (*transmittance)(const HdTable *scene, const HdLitPoint *point, int light);
    /* The radiance of a white diffuse point under all lights. */
    double (*radiance)(const HdTable *scene, const HdLitPoint *point);
} HdProduct;

extern const HdProduct hd_product_float, hd_product_double;

#endif
