/* SPDX-License-Identifier: MIT */
/* What is drawn on the faces of a solid, rims and edge lights' discs, in units of the circumradius.
   Discs are polygons here. */
#ifndef HD_SCENE_TRIANGULATE_PATTERN_H
#define HD_SCENE_TRIANGULATE_PATTERN_H

#include <stdbool.h>

#include "scene/scene.h"
#include "scene/triangulate/segments.h"

/* Numbers of the materials of a solid's mesh: its faces, its rims, then the discs of each of the
   edge lights' colours twice, outside of the rim and on it, if there are discs. Shadow rays pass
   discs as they pass what is below: `passes_as` is the face's number or the rim's. */
enum { HD_SOLID_MATERIAL_FACE, HD_SOLID_MATERIAL_RIM, HD_SOLID_MATERIAL_DISCS };

enum { HD_MIN_DISC_SIDES = 8, HD_MAX_DISC_SIDES = 256 };

enum { HD_MAX_FACE_SIDES = 5 };

/* A face and its plane. Side i runs from corner i to corner i + 1, counterclockwise. */
typedef struct HdFace {
    int side_count;
    int vertex[HD_MAX_FACE_SIDES];       /* number of each corner among the solid's vertices */
    int edge[HD_MAX_FACE_SIDES];         /* number of each side among the solid's edges */
    bool is_reversed[HD_MAX_FACE_SIDES]; /* the edge runs against the side */
    HdVec3 origin, u, v;                 /* of the plane; u and v are unit, u x v is outward */
    HdVec2 corner[HD_MAX_FACE_SIDES];
    HdVec2 direction[HD_MAX_FACE_SIDES]; /* of each side, unit */
} HdFace;

typedef struct HdPattern {
    HdPlatonic shape; /* turned as it is in the scene */
    HdFace face[HD_MAX_FACES];
    double rim_width;
    int per_edge, colour_count;
    double disc_radius; /* 0: no discs */
    int disc_sides;
    double widening; /* from a disc's radius to that of its polygon's corners */
    /* At multiples of half the angle of a disc's side: even ones lead to its corners, odd ones to
       the middles of its sides. */
    HdVec2 spoke[2 * HD_MAX_DISC_SIDES];
} HdPattern;

void hd_pattern_prepare(HdPattern *pattern, const HdSolid *solid, int disc_sides);

/* Adds the borders between the materials of a face, but not its own sides. False: out of memory. */
bool hd_pattern_add_borders(const HdPattern *pattern, int face, HdNetwork *network);

/* Number of the material at a point of a face, as above: where discs overlap, that of the last
   edge, as in the kernels. */
int hd_pattern_material(const HdPattern *pattern, int face, HdVec2 point);

/* How far a point of a face's plane is inside of one of its sides. */
double hd_face_depth(const HdFace *face, int side, HdVec2 point);

#endif
