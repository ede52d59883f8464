/* SPDX-License-Identifier: MIT */
/* Closed convex surfaces of few triangles, about the origin, no larger than 1. */
#ifndef HD_BENCH_SHAPES_H
#define HD_BENCH_SHAPES_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/platonic.h"

enum { HD_MAX_SHAPE_VERTICES = 64, HD_MAX_SHAPE_TRIANGLES = 256 };

typedef struct HdShape {
    int vertex_count, triangle_count;
    HdVec3 vertices[HD_MAX_SHAPE_VERTICES];
    int corners[HD_MAX_SHAPE_TRIANGLES][3]; /* corners, counterclockwise from outside */
    int face_of[HD_MAX_SHAPE_TRIANGLES];    /* -1: it has no area */
    HdVec3 normals[HD_MAX_SHAPE_TRIANGLES]; /* normals of the triangles; unit, or 0 */
    int copies;                             /* copies of the surface */
} HdShape;

/* A point of a shape's surface that a ray is aimed at. */
typedef struct HdAim {
    int triangle;
    double share[3]; /* barycentric, of the triangle's corners */
} HdAim;

typedef enum HdAimKind { HD_AIM_INTERIOR, HD_AIM_EDGE, HD_AIM_CORNER, HD_AIM_KINDS } HdAimKind;

/* Makes each face a fan of triangles. */
void hd_shape_of_platonic(HdShape *shape, const HdPlatonic *solid);

/* Makes the same surface, each face a fan about its middle. Of two faces that share an edge only
   one has its middle as a vertex: this corner lies on the other's edge, a T-junction. */
void hd_shape_with_t_junctions(HdShape *shape, const HdPlatonic *solid);

/* Makes two pyramids with many sides, a hundred times as long as thick: slivers. */
void hd_shape_needle(HdShape *shape);

/* Adds triangles with no area to the edges. */
void hd_shape_add_zero_areas(HdShape *shape);

/* Puts every triangle there twice. */
void hd_shape_double(HdShape *shape);

/* Returns a rotation about all three axes, in degrees. */
HdVec3 hd_random_turn(uint64_t *random);

HdVec3 hd_random_direction(uint64_t *random);

HdAim hd_random_aim(const HdShape *shape, HdAimKind kind, uint64_t *random);

/* Returns the point, computed from other vertices of the shape. */
HdVec3 hd_aim_point(const HdShape *shape, const HdAim *aim, const HdVec3 *vertices);

/* Returns the least cosine between `away` and the normals of the triangles whose plane holds the
   point. On a convex surface these are its own or others of their face. */
double hd_aim_facing(const HdShape *shape, const HdAim *aim, HdVec3 away);

#endif
