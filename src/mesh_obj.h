/* SPDX-License-Identifier: MIT */
/* Meshes from Wavefront OBJ files and their material libraries. */
#ifndef HD_MESH_OBJ_H
#define HD_MESH_OBJ_H

#include "mesh.h"
#include "problems.h"

/* Reads the file at `path`, with the MTL files it names, which lie beside it. Polygons become
   triangles. Materials become ours: Kd colour (and what passes), Ks specular, Ns shininess, Ka
   ambient, Ke emission, d or Tf transmission, Ni index of refraction, illum 3 and up mirrors with
   the share Ks; map_Kd texture. What is not used is told in `notes`: a library that is missing,
   maps of other kinds. Triangles without an area are dropped and counted.

   A file that cannot be read, is no OBJ, names vertices that it does not have, has numbers that are
   not finite or beyond HD_MAX_NUMBER, or would take more than `most_bytes` of memory while it is
   read, is an error (HD_BAD_INPUT) that names the file and, where there is one, the line. */
HdStatus hd_mesh_read_obj(HdMesh *mesh, const char *path, size_t most_bytes, HdProblems *notes,
                          HdError *error);

#endif
