/* SPDX-License-Identifier: MIT */
/* A convex polygon as triangles, with given points and edges. */
#ifndef HD_SCENE_TRIANGULATE_DELAUNAY_H
#define HD_SCENE_TRIANGULATE_DELAUNAY_H

#include <stdint.h>

#include "base/error.h"
#include "base/vector.h"

/* Triangles, counterclockwise, whose corners are all of the points and whose edges the segments are
   among: the constrained Delaunay triangulation, which has the largest angles of all (Lawson 1977,
   Sloan 1993). The first `corner_count` points are the polygon's corners, counterclockwise;
   the others lie on its sides or inside, nowhere nearer than HD_SAME_PLACE to each other or, those
   inside, to a side. Segments have nothing but ends in common. `triangles` has room for
   2 * point_count. */
HdStatus hd_triangulate_plane(const HdVec2 *points, int point_count, int corner_count,
                              const int32_t (*segments)[2], int segment_count,
                              int32_t (*triangles)[3], int *triangle_count, HdError *error);

#endif
