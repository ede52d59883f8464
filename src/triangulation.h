/* SPDX-License-Identifier: MIT */
/* Solids and the floor as triangles. */
#ifndef HD_TRIANGULATION_H
#define HD_TRIANGULATION_H

#include "mesh.h"
#include "scene.h"

/* Numbers of the materials of a solid's mesh: its faces, its rims, then the discs of each edge's
   colour twice, outside of the rim and on it (where shadow rays do not pass). */
enum { HD_SOLID_MATERIAL_FACE, HD_SOLID_MATERIAL_RIM, HD_SOLID_MATERIAL_DISCS };

/* The solid about its own centre, turned as it is in the scene: closed, with every inner edge
   shared by exactly two triangles that name the same two vertices, no corner of one within the edge
   of another. Faces are cut along the borders of the rim and of the edge lights' discs, which
   become polygons of `disc_sides` sides (of the whole disc, even, at least 8) of the same area as
   the disc, and each triangle is then divided into `divisions` x `divisions` equal ones (at least
   1). Triangles of face f have group f + 1. */
HdStatus hd_triangulate_solid(HdMesh *mesh, const HdSolid *solid, int disc_sides, int divisions,
                              HdError *error);

/* The floor about its centre (the mean of its corners): its two halves, each divided likewise,
   group 1, with texture coordinates at the corners. Where the floor is no parallelogram, inverse
   bilinear coordinates are not linear in a triangle: `divisions` should then be large. */
HdStatus hd_triangulate_floor(HdMesh *mesh, const HdFloor *floor, int divisions, HdError *error);

#endif
