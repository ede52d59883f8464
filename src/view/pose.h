/* SPDX-License-Identifier: MIT */
/* A view that people move: the eye, and the point about which it turns. */
#ifndef HD_VIEW_POSE_H
#define HD_VIEW_POSE_H

#include <stdio.h>

#include "scene/scene.h"

typedef struct HdPose {
    HdVec3 eye, target;
} HdPose;

/* Where the scene's own flight is at that frame. */
HdPose hd_pose_of_flight(const HdScene *scene, int frame);

/* Turns the eye about the target, in radians: to the right and upwards, but never over a pole. */
void hd_pose_orbit(HdPose *pose, double right, double up);

/* Moves both sideways and upwards, in shares of their distance. */
void hd_pose_pan(HdPose *pose, double right, double up);

/* Brings the eye so many times as far from the target. */
void hd_pose_dolly(HdPose *pose, double factor);

/* Makes it the scene's only view: one frame, from fixed points. */
void hd_pose_apply(const HdPose *pose, HdScene *scene);

/* The member "camera" of a scene file that has this view, in one line. It reads back as the same
   numbers. */
void hd_pose_print(FILE *out, const HdPose *pose, double field_of_view_degrees);

#endif
