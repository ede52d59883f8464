/* SPDX-License-Identifier: MIT */
/* What is searched: a bumpy, filtering sphere within a shell, one mesh of about as many triangles
   as asked, half of them each. All rays end on it. */
#ifndef HD_BENCH_OBJECT_H
#define HD_BENCH_OBJECT_H

#include <stdbool.h>

#include "scene/scene.h"
#include "tables/tables.h"

typedef struct HdObject {
    HdScene scene;
    HdSceneTables tables;
    HdFrameTables frame;
    HdVec3 centre;     /* that the kernels use for meshes */
    HdVec3 eye, light; /* relative to it */
    int triangle_count;
    HdVec3 *normals; /* unit, of the triangles by the kernels' numbers; owned */
} HdObject;

/* `lanes` are those of the kernels' bundles. Prints what is wrong and returns false on failure. */
bool hd_object_create(HdObject *object, int triangles, int lanes);
void hd_object_free(HdObject *object);

/* Corner 0 to 2 of a triangle by the kernels' numbers, as they have it. */
HdVec3 hd_object_corner(const HdObject *object, int triangle, int corner);

/* Of half the view's angle. */
extern const double hd_object_tangent;

/* What the sphere lets pass at each crossing. */
extern const double hd_object_filter[3];

#endif
