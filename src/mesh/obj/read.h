/* SPDX-License-Identifier: MIT */
/* Meshes from Wavefront OBJ files and their material libraries. */
#ifndef HD_MESH_OBJ_READ_H
#define HD_MESH_OBJ_READ_H

#include "base/error.h"
#include "mesh/mesh.h"

/* The most bytes of a line, continued ones together; comments may be longer. */
enum { HD_OBJ_MOST_LINE = 65000 };

/* Reads the file at `path`, with the MTL files it names, which lie beside it or below. Polygons
   become triangles. Materials become ours by the table in docs/formats.md: Kd colour (and what
   passes), Ks specular, Ns shininess, Ka ambient, Ke emission, d or Tf transmission, Ni index of
   refraction, illum 3 to 9 mirrors with the share Ks; map_Kd texture, whose path begins with the
   folder of `path`, or with "./"; nobody has looked whether it is there. Materials without
   triangles may be among them. What is not used is told in `notes`, in sentences that begin with a
   path: a library that is missing, wrong lines of libraries, maps of other kinds, values that had
   to be made legal. Triangles without an area are dropped and counted.

   A file that cannot be read, is no OBJ, has no faces or none with an area, names vertices that it
   does not have, has numbers that are not finite or beyond HD_MAX_NUMBER, or would take more than
   `most_bytes` of memory while it is read, the mesh included, is an error (HD_BAD_INPUT) that names
   the file and, where there is one, the line. HD_FAILED: the system has too little memory. After an
   error the mesh is empty. */
HdStatus hd_mesh_read_obj(HdMesh *mesh, const char *path, size_t most_bytes, HdProblems *notes,
                          HdError *error);

#endif
