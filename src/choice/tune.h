/* SPDX-License-Identifier: MIT */
/* Measures on the user's own scene which way of launching a device's kernels is the fastest. */
#ifndef HD_CHOICE_TUNE_H
#define HD_CHOICE_TUNE_H

#include "choice/measure.h"

enum { HD_TUNING_CANDIDATES = 24 };

typedef struct HdTuningCandidate {
    HdRenderOptions options; /* their pipeline is not HD_PIPELINE_AUTO */
    double seconds;          /* of tracing a picture, the least of several; 0: it failed */
    char failure[512];       /* why it failed, else "" */
} HdTuningCandidate;

typedef struct HdTuning {
    HdTuningCandidate candidates[HD_TUNING_CANDIDATES]; /* the first is what suits the device */
    int count;
    int best;
    int width, height; /* of the pictures */
} HdTuning;

/* Measures what the options leave open: first pipelines, on NVIDIA devices each with several limits
   of registers; then, with the best of those, lanes on CPUs, the size of groups and how many there
   are at most on GPUs. The fastest are measured several times, in turn. Another candidate must be
   clearly faster to be the best. One that cannot be used is told with the reason; the first one
   must work. A scene's frame is rendered whole where
   that takes less than a fifth of a second, else a smaller picture of it. */
HdStatus hd_tune(HdTuning *tuning, const HdDevice *device, const HdRenderOptions *options,
                 const HdJob *job, HdError *error);

/* Remembers the best for later jobs alike on such a device, with the same driver, that leave the
   same open. Errors as hd_measured_put. */
HdStatus hd_tuning_remember(const HdTuning *tuning, const HdDevice *device,
                            const HdRenderOptions *options, const HdScene *scene, HdError *error);

#endif
