/* SPDX-License-Identifier: MIT */
/* The meshes of the self-test. */
#ifndef HD_DEVICE_SELF_TEST_MESH_H
#define HD_DEVICE_SELF_TEST_MESH_H

#include <stdbool.h>

#include "mesh/mesh.h"

/* Makes a closed mesh of 48 triangles, built, whose corners are exact numbers on every system: a
   ball with smooth normals, texture coordinates and the materials 0 and, above and below, 1; or a
   cube within +-1 whose faces are groups, of material 0. The materials are left zeroed. The caller
   frees the mesh, also where this fails. */
HdStatus hd_self_test_mesh(HdMesh *mesh, bool is_ball, HdError *error);

#endif
