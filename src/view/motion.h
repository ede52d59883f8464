/* SPDX-License-Identifier: MIT */
/* Moves the eye of a view, and chooses the detail of pictures during motion. */
#ifndef HD_VIEW_MOTION_H
#define HD_VIEW_MOTION_H

#include <stdio.h>

#include "scene/scene.h"

/* Eye, and the point that it orbits. */
typedef struct HdPose {
    HdVec3 eye, target;
} HdPose;

/* Returns the pose of the scene's own camera path at that frame. */
HdPose hd_pose_on_path(const HdScene *scene, int frame);

/* Turns the eye about the target, in radians: to the right and upwards, but never over a pole. */
void hd_pose_orbit(HdPose *pose, double right, double up);

/* Moves both sideways and upwards, in multiples of their distance. */
void hd_pose_pan(HdPose *pose, double right, double up);

/* Multiplies the eye's distance to the target. */
void hd_pose_dolly(HdPose *pose, double factor);

/* Makes the pose the scene's only view: one frame, from fixed points. */
void hd_pose_apply(const HdPose *pose, HdScene *scene);

/* Prints the member "camera" of a scene file for this view, in one line. It reads back as the same
   numbers. */
void hd_pose_print(FILE *out, const HdPose *pose, double field_of_view_degrees);

/* Seconds of a moving picture: 38 a second, since above 25 are wanted and times vary. */
#define HD_MOVING_SECONDS 0.026

/* Measured seconds of a sample, smoothed; 0: none yet. */
typedef struct HdPace {
    double seconds_per_sample;
    int depth; /* current ray depth, if less than the scene's; 0: the scene's */
} HdPace;

typedef struct HdDetail {
    int width, height;
    int samples; /* columns of samples */
    int sample_rows;
    int depth;
} HdDetail;

/* Learns the seconds of a picture of that detail. */
void hd_pace_note(HdPace *pace, const HdDetail *detail, double seconds);

/* Returns the most detail that is made in time, at most `full`. All pixels of the picture come
   before more samples. Depth is reduced last, if the picture would be too small to recognise. */
HdDetail hd_pace_choose(HdPace *pace, const HdDetail *full);

#endif
