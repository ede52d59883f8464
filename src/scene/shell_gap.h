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
   point along a line. Shells that have the point on their surface are not. Takes the count of
   visited boxes and triangles from `work`. Returns false if out of memory. */
bool hd_shells_around(const HdPlacedMesh *around, HdVec3 point, int but, HdShellList *list,
                      int64_t *work);

/* Returns a point in the coordinates of `around` for one in those of `within`. */
HdVec3 hd_point_between(const HdPlacedMesh *within, const HdPlacedMesh *around, HdVec3 point);

/* Returns whether the box of the outer shell holds all corners of the inner one. */
bool hd_shell_fits(const HdPlacedMesh *within, int inner, const HdPlacedMesh *around, int outer);

/* Returns whether the boxes of two shells meet. */
bool hd_shell_boxes_meet(const HdPlacedMesh *a, int first, const HdPlacedMesh *b, int second);

/* Returns whether a plane separates each triangle of a shell from each of another one by more than
   `gap`, a share of half the diagonal of the second one's box. Both have trees (hd_shell_build).
   Takes the count of visited pairs from `work`, and returns false once none is left. */
bool hd_shells_are_clear(const HdPlacedMesh *within, int inner, const HdPlacedMesh *around,
                         int outer, double gap, int64_t *work);

/* Returns whether two boxes have a common point. */
static inline bool hd_boxes_meet(HdVec3 lower, HdVec3 upper, HdVec3 other_lower,
                                 HdVec3 other_upper) {
    return lower.x <= other_upper.x && other_lower.x <= upper.x && lower.y <= other_upper.y &&
           other_lower.y <= upper.y && lower.z <= other_upper.z && other_lower.z <= upper.z;
}

#endif
