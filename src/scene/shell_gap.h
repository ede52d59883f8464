/* SPDX-License-Identifier: MIT */
/* Shells of placed meshes: which of them hold a point, and whether two come near each other. */
#ifndef HD_SCENE_SHELL_GAP_H
#define HD_SCENE_SHELL_GAP_H

#include "mesh/shells.h"
#include "scene/placement.h"

/* A built mesh in the scene. */
typedef struct HdPlacedMesh {
    const HdMesh *mesh;
    const HdShells *shells;
    HdPlacement to;
} HdPlacedMesh;

/* Numbers of shells, which are owned. */
typedef struct HdShellList {
    int count, capacity;
    int32_t *shells;
} HdShellList;

/* Lists the closed shells of `around`, except the number `but`, that hold a point of the
   coordinates of hd_mesh_corner, in ascending order. Open ones are listed if they surround the
   point along a line. Shells that have the point on their surface are not. Returns false if out of
   memory. */
bool hd_shells_around(const HdPlacedMesh *around, HdVec3 point, int but, HdShellList *list);

/* Returns a point in the coordinates of `around` for one in those of `within`. */
HdVec3 hd_point_between(const HdPlacedMesh *within, const HdPlacedMesh *around, HdVec3 point);

enum { HD_ANY_SHELL = -1 };

/* Returns whether a plane separates each triangle of the one shell from each of the other one by
   more than `gap`, a share of half the diagonal of the second one's box. With HD_ANY_SHELL twice,
   compares all shells of the one mesh with all others of the other mesh. */
bool hd_shells_are_clear(const HdPlacedMesh *within, int inner, const HdPlacedMesh *around,
                         int outer, double gap);

#endif
