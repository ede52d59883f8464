/* SPDX-License-Identifier: MIT */
/* Short measurements on the user's own scene, a smaller picture of its first frame. */
#ifndef HD_CHOICE_TRIAL_H
#define HD_CHOICE_TRIAL_H

#include "device/renderer.h"
#include "scene/scene.h"

/* What is to be rendered. */
typedef struct HdJob {
    const HdScene *scene; /* valid */
    int first_frame;
    int frame_count;
} HdJob;

/* A renderer on which the job's scene is. */
HdStatus hd_trial_open(HdRenderer **renderer, const HdDevice *device,
                       const HdRenderOptions *options, const HdJob *job, HdError *error);

/* Each is the least of several. */
typedef struct HdTrialTime {
    double seconds;       /* of a picture, copies included */
    double trace_seconds; /* of tracing alone */
    int width, height;
    double share; /* of the pixels of a frame */
} HdTrialTime;

/* Renders about `share` of the pixels of a frame, more than 0 and at most 1, some times over. */
HdStatus hd_trial_measure(HdRenderer *renderer, const HdJob *job, double share, int times,
                          HdTrialTime *time, HdError *error);

/* About how many seconds a renderer takes for a whole frame, on which the job's scene is. Measures
   no longer than it must to know, some hundredths of a second, and stops early where `frame_count`
   of them take less than `enough` seconds. */
HdStatus hd_trial_estimate_on(HdRenderer *renderer, const HdJob *job, double enough,
                              double *frame_seconds, HdError *error);

/* The same of plain C. */
HdStatus hd_trial_estimate(const HdRenderOptions *options, const HdJob *job, double enough,
                           double *frame_seconds, HdError *error);

#endif
