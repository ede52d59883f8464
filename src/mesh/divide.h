/* SPDX-License-Identifier: MIT */
/* Triangles divided into smaller ones. */
#ifndef HD_MESH_DIVIDE_H
#define HD_MESH_DIVIDE_H

#include "mesh/mesh.h"

/* Divides each triangle of a mesh without normals and texture coordinates into `divisions` x
   `divisions` equal ones, which keep its material and group. Triangles that share an edge share the
   new vertices on it. HD_BAD_INPUT: there would be more than HD_MAX_MESH_TRIANGLES; then, and when
   there is no memory, the mesh stays as it is. */
HdStatus hd_divide_triangles(HdMesh *mesh, int divisions, HdError *error);

/* Checks `divisions`, and that `triangle_count` triangles so divided are no more than
   HD_MAX_MESH_TRIANGLES. */
HdStatus hd_check_divisions(int64_t triangle_count, int divisions, HdError *error);

#endif
