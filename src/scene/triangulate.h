/* SPDX-License-Identifier: MIT */
/* Converts solids and the floor to triangles. */
#ifndef HD_SCENE_TRIANGULATE_H
#define HD_SCENE_TRIANGULATE_H

#include "mesh/mesh.h"
#include "scene/scene.h"

/* Material numbers of a solid's mesh: the faces, the rims, then for each edge-light colour two
   discs, outside the rim and on it, if there are discs. Shadow rays pass discs as they pass what is
   below: `passes_as` is the face's number or the rim's. */
enum { HD_SOLID_MATERIAL_FACE, HD_SOLID_MATERIAL_RIM, HD_SOLID_MATERIAL_DISCS };

enum { HD_MIN_DISC_SIDES = 8, HD_MAX_DISC_SIDES = 256 };

/* Converts the solid, about its own centre and rotated as in the scene, to a closed mesh without
   T-junctions. Two triangles share every inner edge and name the same two vertices. Faces are cut
   along the borders of the rim and of the discs. A disc becomes a polygon of the same area with
   `disc_sides` sides (even, HD_MIN_DISC_SIDES to HD_MAX_DISC_SIDES), two of its corners on the
   edge. Each triangle is divided into `divisions` x `divisions` equal ones (at least 1). Rims and
   discs whose width or sides are at most 1e-8 circumradii are omitted. Triangles of face f have
   group f + 1. Fails with HD_BAD_INPUT if a number is out of range or there would be more than
   HD_MAX_MESH_TRIANGLES; the mesh is then empty. */
HdStatus hd_triangulate_solid(HdMesh *mesh, const HdSolid *solid, int disc_sides, int divisions,
                              HdError *error);

/* Converts the floor, about the mean of its corners, to `divisions` x `divisions` quadrilaterals,
   equal in both texture coordinates, each of two triangles in group 1. Triangles are oriented as
   the floor's corners are. Texture coordinates are linear in a triangle only on a parallelogram;
   other floors need many divisions. Its only material names no texture, for the scene has the
   picture. Errors as above. */
HdStatus hd_triangulate_floor(HdMesh *mesh, const HdFloor *floor, int divisions, HdError *error);

/* Converts the solids and the floor of a valid scene to triangles (HD_GEOMETRY_TRIANGLES). On
   failure the scene is unchanged. */
HdStatus hd_scene_triangulate(HdScene *scene, int disc_sides, int divisions, HdError *error);

#endif
