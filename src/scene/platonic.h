/* SPDX-License-Identifier: MIT */
/* The five platonic solids about the origin with circumradius 1, in fixed orientations:
   tetrahedron  vertices at alternate corners of an axis-parallel cube, (1,1,1)/sqrt(3) among them
   hexahedron   faces perpendicular to the axes
   octahedron   vertices on the axes
   dodecahedron eight of its vertices are those of the axis-parallel cube
   icosahedron  vertices (0, +-1, +-phi) and their cyclic permutations, scaled
   See H. S. M. Coxeter, Regular Polytopes, section 3.7. */
#ifndef HD_SCENE_PLATONIC_H
#define HD_SCENE_PLATONIC_H

#include "base/vector.h"

/* X(kind, name in scene files). */
#define HD_SOLID_KINDS(X)                                                                          \
    X(HD_TETRAHEDRON, "tetrahedron")                                                               \
    X(HD_HEXAHEDRON, "cube")                                                                       \
    X(HD_OCTAHEDRON, "octahedron")                                                                 \
    X(HD_DODECAHEDRON, "dodecahedron")                                                             \
    X(HD_ICOSAHEDRON, "icosahedron")

#define HD_KIND_OF(kind, name) kind,
typedef enum HdSolidKind { HD_SOLID_KINDS(HD_KIND_OF) HD_SOLID_KIND_COUNT } HdSolidKind;

enum { HD_MAX_FACES = 20, HD_MAX_VERTICES = 20, HD_MAX_EDGES = 30 };

typedef struct HdPlatonicEdge {
    int vertex[2];
    int face[2];
} HdPlatonicEdge;

typedef struct HdPlatonic {
    int face_count, vertex_count, edge_count;
    HdVec3 vertex[HD_MAX_VERTICES];
    HdVec3 face_normal[HD_MAX_FACES]; /* unit, outward. Faces 2i and 2i + 1 are opposite, their
                                         normals exact negatives; not so in a tetrahedron, which has
                                         no opposite faces */
    HdPlatonicEdge edge[HD_MAX_EDGES];
    double inradius;         /* inradius at circumradius 1 */
    double edge_length;      /* length at circumradius 1 */
    double sine_of_dihedral; /* sine of the angle between two adjacent faces */
} HdPlatonic;

const char *hd_solid_kind_name(HdSolidKind kind);

/* Fills `solid`. Every value follows from square roots alone, so it is the same on every system. */
void hd_platonic(HdSolidKind kind, HdPlatonic *solid);

/* Rotates points about the x, then the y, then the z axis, counterclockwise as seen from the axis's
   tip. Angles of 0 preserve every bit. */
void hd_rotate_points(HdVec3 *points, int count, HdVec3 degrees);

/* Rotates the solid in the same way. */
void hd_platonic_rotate(HdPlatonic *solid, HdVec3 degrees);

#endif
