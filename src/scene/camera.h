/* SPDX-License-Identifier: MIT */
/* The camera path: from a frame number to an eye and an orthonormal view basis. */
#ifndef HD_SCENE_CAMERA_H
#define HD_SCENE_CAMERA_H

#include "base/error.h"
#include "scene/scene.h"

typedef struct HdCamera {
    HdVec3 eye;
    HdVec3 right, up, forward;  /* orthonormal, right-handed: right x up = -forward */
    double tangent_of_half_fov; /* tangent of half the horizontal field of view */
} HdCamera;

/* Returns the path's point at t = 2 pi * frame / frame_count, in world space. */
HdVec3 hd_path_point(const HdPath *path, int frame, int frame_count);

/* Computes the camera of one frame. If it looks straight up or down, the picture's up points away
   from the z axis (looking up) or towards it (looking down), at the eye's angle phi. A fixed eye's
   phi is that of its position, 0 on the axis. Fails with HD_BAD_INPUT if the eye is at the target.
   */
HdStatus hd_camera_at(HdCamera *camera, const HdScene *scene, int frame, HdError *error);

#endif
