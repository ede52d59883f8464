/* SPDX-License-Identifier: MIT */
/* Polygons in space, cut into triangles. */
#ifndef HD_MESH_POLYGON_H
#define HD_MESH_POLYGON_H

#include <stdbool.h>
#include <stdint.h>

#include "base/vector.h"

/* Concave polygons take time with the square of their corners. */
enum { HD_MAX_CONCAVE_CORNERS = 1024 };

/* Cuts a polygon of `count` corners, at least 3, into `count` - 2 triangles of the same sense: a
   fan of the first corner where that covers it, else ears in the plane of the axes that it faces
   most. What crosses itself is cut into as many triangles, somehow. `triangles` get numbers of
   corners. False: the polygon is no fan and has more than HD_MAX_CONCAVE_CORNERS. */
bool hd_polygon_cut(const HdVec3 *corners, int count, int32_t (*triangles)[3]);

#endif
