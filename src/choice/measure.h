/* SPDX-License-Identifier: MIT */
/* The one way to measure a device: trials, short renderings of the user's own scene, a smaller
   picture of its first frame. And what was measured once, remembered for jobs alike. */
#ifndef HD_CHOICE_MEASURE_H
#define HD_CHOICE_MEASURE_H

#include "device/renderer.h"
#include "scene/scene.h"

/* What is to be rendered. */
typedef struct HdJob {
    const HdScene *scene; /* valid */
    int first_frame;
    int frame_count;
} HdJob;

/* A device that renders, or that may. */
typedef struct HdTeamDevice {
    HdDevice device;
    HdRenderer *renderer;    /* owned; NULL: it is not open */
    HdRenderOptions options; /* of an open device, and of what is remembered */
    bool is_tuned;           /* they are remembered ones */
    double seconds;          /* of the picture it was measured with; infinite: it failed */
} HdTeamDevice;

/* For people, what a renderer may choose without changing a picture, which is how it launches its
   kernels: "mega, groups of 64, at most 96 registers"; "as it suits the device" where nothing is
   chosen. */
void hd_launch_describe(const HdRenderOptions *options, char *text, int capacity);

/* ---- trials ---- */

typedef struct HdTrialRequest {
    double
        share;       /* of a frame's pixels, more than 0 and at most 1; 0: starts with 4096 samples,
                        and takes four times as many until it is a whole frame or the following holds */
    double believed; /* a picture takes longer than so many seconds, which can be believed */
    double enough;   /* all frames of the job take at most so many, by the last picture */
    int times;       /* that each picture is rendered */
} HdTrialRequest;

/* Each is the least of several, of the last picture. */
typedef struct HdTrial {
    double seconds;       /* of a picture, copies included */
    double frame_seconds; /* so many would a whole frame take */
    double trace_seconds; /* of tracing alone */
    int width, height;
    double share; /* about that of the pixels of a frame */
} HdTrial;

/* A renderer on which the job's scene is. */
HdStatus hd_trial_open(HdRenderer **renderer, const HdDevice *device,
                       const HdRenderOptions *options, const HdJob *job, HdError *error);

/* Renders about that share of the job's first frame. The job's scene is on the renderer. */
HdStatus hd_trial(HdRenderer *renderer, const HdJob *job, const HdTrialRequest *selection,
                  HdTrial *trial, HdError *error);

/* The wish of who wants to know how long a frame takes, as soon as it can be known, some hundredths
   of a second; no matter how long where the job takes less than `enough` seconds. */
HdTrialRequest hd_trial_request(double enough);

/* ---- results ---- */

/* Remembers in the cache folder (cache_folder.h) how long devices took, and by which launches, that
   is their own options, where these options leave them open. It serves the same devices, by name
   and driver, and jobs alike: those of the same version of the program, with the same options,
   whose scenes have as many planes, triangles, instances, lights, lights that no distance ends and
   samples, and are as deep, rounded to powers of two, a floor or none, and deep trees or not.
   Errors as hd_cache_put. */
HdStatus hd_measured_put(const HdTeamDevice *devices, int count, const HdRenderOptions *options,
                         const HdScene *scene, HdError *error);

/* Fills `seconds` and `options` in. False where nothing is remembered, or nonsense. */
bool hd_measured_get(HdTeamDevice *devices, int count, const HdRenderOptions *options,
                     const HdScene *scene);

/* ---- devices ---- */

/* Opens a device with these options, and with the best launch that is remembered for it alone, if
   any is and it keeps to them; with `gets_scene` the job's scene is on it then. */
HdStatus hd_team_device_open(HdTeamDevice *member, const HdRenderOptions *options, const HdJob *job,
                             bool gets_scene, HdError *error);

/* A device that is not open may be closed. */
void hd_team_device_close(HdTeamDevice *member);

/* ---- tuning: which way of launching a device's kernels is the fastest ---- */

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
   must work. A scene's frame is rendered whole where that takes less than a fifth of a second, else
   a smaller picture of it. */
HdStatus hd_tune(HdTuning *tuning, const HdDevice *device, const HdRenderOptions *options,
                 const HdJob *job, HdError *error);

/* Remembers the best for later jobs alike on such a device, with the same driver, that leave the
   same open. Errors as hd_measured_put. */
HdStatus hd_tuning_remember(const HdTuning *tuning, const HdDevice *device,
                            const HdRenderOptions *options, const HdScene *scene, HdError *error);

#endif
