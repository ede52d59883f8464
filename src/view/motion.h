/* SPDX-License-Identifier: MIT */
/* A view that people move: where the eye is, and how fine pictures may be meanwhile. */
#ifndef HD_VIEW_MOTION_H
#define HD_VIEW_MOTION_H

#include <stdio.h>

#include "scene/scene.h"

/* The eye, and the point about which it turns. */
typedef struct HdPose {
    HdVec3 eye, target;
} HdPose;

/* Where the scene's own flight is at that frame. */
HdPose hd_pose_on_path(const HdScene *scene, int frame);

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

/* Seconds for a moving picture: 38 in a second, for above 25 are wanted, and times vary. */
#define HD_MOVING_SECONDS 0.026

/* What was measured: seconds of a sample, smoothed; 0: nothing was yet. */
typedef struct HdPace {
    double seconds_per_sample;
    int depth; /* that pictures have for now, where it is less than the scene's; 0: the scene's */
} HdPace;

typedef struct HdDetail {
    int width, height;
    int samples; /* of a side */
    int depth;
} HdDetail;

/* A picture of that detail took so many seconds. */
void hd_pace_note(HdPace *pace, const HdDetail *detail, double seconds);

/* The most detail that is made in time, at most `full`. All of the picture's pixels come before
   more samples; depth is given up last, where a picture would be too small to tell anything. */
HdDetail hd_pace_choose(HdPace *pace, const HdDetail *full);

#endif
