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
    int corners[HD_MAX_SHAPE_TRIANGLES][3]; /* counterclockwise from outside */
    int face_of[HD_MAX_SHAPE_TRIANGLES];    /* -1: it has no area */
    HdVec3 normals[HD_MAX_SHAPE_TRIANGLES]; /* of the triangles; unit, or 0 */
    int copies;                             /* how often the surface is there */
} HdShape;

/* A point of a shape's surface that a ray is aimed at. */
typedef struct HdAim {
    int triangle;
    double share[3]; /* of the triangle's corners */
} HdAim;

typedef enum HdAimKind { HD_AIM_INTERIOR, HD_AIM_EDGE, HD_AIM_CORNER, HD_AIM_KINDS } HdAimKind;

/* Each face a fan of triangles. */
void hd_shape_of_platonic(HdShape *shape, const HdPlatonic *solid);

/* The same surface, each face a fan about its middle. Of two faces that share an edge only one has
   the edge's middle for a vertex, so that its corner lies on the other's edge: a T-junction. */
void hd_shape_with_t_junctions(HdShape *shape, const HdPlatonic *solid);

/* Two pyramids with many sides, a hundred times as long as thick: slivers. */
void hd_shape_needle(HdShape *shape);

/* Adds triangles with no area to the edges. */
void hd_shape_add_zero_areas(HdShape *shape);

/* Puts every triangle there twice. */
void hd_shape_double(HdShape *shape);

/* A turn about all three axes, in degrees. */
HdVec3 hd_random_turn(uint64_t *random);

HdVec3 hd_random_direction(uint64_t *random);

HdAim hd_random_aim(const HdShape *shape, HdAimKind kind, uint64_t *random);

/* Where it is, from other places of the shape's vertices. */
HdVec3 hd_aim_point(const HdShape *shape, const HdAim *aim, const HdVec3 *vertices);

/* The least cosine between `away` and the normals of the triangles whose plane the point is on; for
   a convex surface it belongs to them or to others of their face. */
double hd_aim_facing(const HdShape *shape, const HdAim *aim, HdVec3 away);

#endif
