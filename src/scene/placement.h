/* SPDX-License-Identifier: MIT */
/* Where the instances of meshes are, and whether a camera sees them. */
#ifndef HD_SCENE_PLACEMENT_H
#define HD_SCENE_PLACEMENT_H

#include "scene/camera.h"
#include "scene/scene.h"

/* The map from mesh coordinates, in which the box of the mesh has its centre at 0 and half its
   longest side is 1, to world space: columns . p + start. */
typedef struct HdPlacement {
    HdVec3 columns[3], start;
} HdPlacement;

/* Maps a point. */
static inline HdVec3 hd_place(const HdPlacement *to, HdVec3 point) {
    const HdVec3 *c = to->columns;
    return hd_add(hd_add(hd_scale(c[0], point.x), hd_scale(c[1], point.y)),
                  hd_add(hd_scale(c[2], point.z), to->start));
}

/* Computes the columns of the inverse; those of `to` are perpendicular to each other. */
void hd_invert_columns(const HdVec3 to[3], HdVec3 back[3]);

/* Returns half the sides of the box about what a placement makes of a box with half the sides
   `half`. */
HdVec3 hd_placed_half(const HdPlacement *to, HdVec3 half);

/* Likewise for the box of a built mesh. */
HdVec3 hd_placed_mesh_half(const HdMesh *mesh, const HdPlacement *to);

const HdMesh *hd_mesh_of(const HdScene *scene, int instance);

/* Returns an instance's placement in world space. */
HdPlacement hd_placement_of(const HdScene *scene, int instance);

/* Scales the instance of a built mesh so that the longest side of the mesh's box, along the axes of
   the mesh, becomes `size`. Moves it so that it stands on `position`: its lowest point is level
   with it, the middle of its box above it. */
void hd_instance_fit(HdInstance *instance, const HdMesh *mesh, double size);

/* Computes the tight box about an instance, in world space. */
void hd_instance_box(const HdScene *scene, int instance, HdVec3 *lower, HdVec3 *upper);

/* How much of an instance is within the picture, whatever stands in front of it. None: all corners
   of its triangles are behind the eye, or beyond one same edge of the picture. Whole: each corner
   is within the picture. */
typedef enum HdSight { HD_SIGHT_NONE, HD_SIGHT_PART, HD_SIGHT_WHOLE } HdSight;

/* Finds it for the whole picture, without the crop. */
HdSight hd_instance_sight(const HdScene *scene, int instance, const HdCamera *camera);

#endif
