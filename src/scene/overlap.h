/* SPDX-License-Identifier: MIT */
/* Whether a solid and another one, or the floor, lie in each other. */
#ifndef HD_SCENE_OVERLAP_H
#define HD_SCENE_OVERLAP_H

#include "scene/scene.h"

/* How deep the two lie in each other: the length of the shortest move that leaves them touching.
   Negative where they lie apart: then no more than their distance, and where it is not greater than
   `least`, `least`. */
double hd_solid_depth(const HdSolid *a, const HdSolid *b, double least);
double hd_floor_depth(const HdSolid *solid, const HdFloor *floor, double least);

/* The length of the shortest move that leaves the two at most touching; 0 where they touch (share a
   face, an edge or a corner) or lie apart. Up to 1e-9 of the smaller one's circumradius, and what
   the rounding of large coordinates may amount to, counts as touching. */
double hd_solid_overlap(const HdSolid *a, const HdSolid *b);

/* The same for a solid and a floor, a flat one: its corners count as if they lay in the plane that
   passes nearest to them. */
double hd_floor_overlap(const HdSolid *solid, const HdFloor *floor);

#endif
