/* SPDX-License-Identifier: MIT */
#ifndef HD_SCENE_TRIANGULATE_H
#define HD_SCENE_TRIANGULATE_H

#include "scene/scene.h"

/* Makes the solids and the floor of a valid scene out of triangles (HD_GEOMETRY_TRIANGLES), as
   hd_triangulate_solid and hd_triangulate_floor do; the discs of edge lights have `disc_sides`
   sides. On failure the scene is as it was. */
HdStatus hd_scene_triangulate(HdScene *scene, int disc_sides, int divisions, HdError *error);

#endif
