/* SPDX-License-Identifier: MIT */
/* The camera's flight: from a frame number to an eye and an orthonormal view basis. */
#ifndef HD_SCENE_CAMERA_H
#define HD_SCENE_CAMERA_H

#include "base/error.h"
#include "scene/scene.h"

typedef struct HdCamera {
    HdVec3 eye;
    HdVec3 right, up, forward;  /* orthonormal, right-handed: right x up = -forward */
    double tangent_of_half_fov; /* horizontal */
} HdCamera;

/* The point of the path at t = 2 pi * frame / frame_count, in world space. */
HdVec3 hd_path_point(const HdPath *path, int frame, int frame_count);

/* The camera of one frame. Where it looks straight up or down, the picture's up is the horizontal
   direction in which that view would be left by tilting: towards the z axis (looking down) or away
   from it (looking up) at the eye's angle phi, which is that of a fixed eye's place, 0 on the axis.
   Fails with HD_BAD_INPUT when the eye is at the target. */
HdStatus hd_camera_at(HdCamera *camera, const HdScene *scene, int frame, HdError *error);

#endif
