/* SPDX-License-Identifier: MIT */
/* The golden frames with meshes. */
#ifndef HD_VERIFY_GOLDEN_MESH_SCENES_H
#define HD_VERIFY_GOLDEN_MESH_SCENES_H

#include "scene/camera.h"
#include "scene/scene.h"

void bumpy_sphere(HdScene *scene, HdCamera *camera);
void many_instances(HdScene *scene, HdCamera *camera);
void triangulated_solids(HdScene *scene, HdCamera *camera);
void mesh_edges_and_corners(HdScene *scene, HdCamera *camera);
void mesh_far_from_origin(HdScene *scene, HdCamera *camera);

#endif
