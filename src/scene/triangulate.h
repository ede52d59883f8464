/* SPDX-License-Identifier: MIT */
/* Solids and the floor as triangles. */
#ifndef HD_SCENE_TRIANGULATE_H
#define HD_SCENE_TRIANGULATE_H

#include "mesh/mesh.h"
#include "scene/scene.h"

/* Numbers of the materials of a solid's mesh: its faces, its rims, then the discs of each of the
   edge lights' colours twice, outside of the rim and on it, if there are discs. Shadow rays pass
   discs as they pass what is below: `passes_as` is the face's number or the rim's. */
enum { HD_SOLID_MATERIAL_FACE, HD_SOLID_MATERIAL_RIM, HD_SOLID_MATERIAL_DISCS };

enum { HD_MIN_DISC_SIDES = 8, HD_MAX_DISC_SIDES = 256 };

/* The solid about its own centre, turned as it is in the scene: closed, with every inner edge
   shared by exactly two triangles that name the same two vertices, no corner of one within the edge
   of another. Faces are cut along the borders of the rim and of the edge lights' discs, which
   become polygons of `disc_sides` sides (of the whole disc, even, HD_MIN_DISC_SIDES to
   HD_MAX_DISC_SIDES) of the same area as the disc, two of their corners on its edge, and each
   triangle is then divided into `divisions` x `divisions` equal ones (at least 1). Rims and discs
   whose width or sides are no longer than a hundred-millionth of the circumradius are left out.
   Triangles of face f have group f + 1. HD_BAD_INPUT: a number is out of its range, or there would
   be more than HD_MAX_MESH_TRIANGLES. On failure the mesh is empty. */
HdStatus hd_triangulate_solid(HdMesh *mesh, const HdSolid *solid, int disc_sides, int divisions,
                              HdError *error);

/* The floor about its centre (the mean of its corners): `divisions` x `divisions` quadrilaterals of
   equal shares of both texture coordinates, each two triangles, group 1, with texture coordinates
   at the corners; counterclockwise as the floor's corners are. Where the floor is no parallelogram,
   texture coordinates are not linear in a triangle: `divisions` should then be large. Its only
   material names no texture: the scene has the picture itself. Errors as above. */
HdStatus hd_triangulate_floor(HdMesh *mesh, const HdFloor *floor, int divisions, HdError *error);

/* Makes the solids and the floor of a valid scene out of triangles (HD_GEOMETRY_TRIANGLES), as
   hd_triangulate_solid and hd_triangulate_floor do; the discs of edge lights have `disc_sides`
   sides. On failure the scene is as it was. */
HdStatus hd_scene_triangulate(HdScene *scene, int disc_sides, int divisions, HdError *error);

#endif
