/* SPDX-License-Identifier: MIT */
/* Measures devices by trials: short renderings of the user's scene, as a smaller picture of its
   first frame. Remembers results for similar jobs. */
#ifndef HD_CHOICE_MEASURE_H
#define HD_CHOICE_MEASURE_H

#include "device/renderer.h"
#include "scene/scene.h"

/* A rendering job. */
typedef struct HdJob {
    const HdScene *scene; /* valid */
    int first_frame;
    int frame_count;
} HdJob;

/* A device of a team, or a candidate. */
typedef struct HdTeamDevice {
    HdDevice device;
    HdRenderer *renderer;    /* owned; NULL: not open */
    HdRenderOptions options; /* options of an open device, or remembered ones */
    bool is_tuned;           /* options are remembered ones */
    double seconds;          /* time of the measured picture; infinite: it failed */
} HdTeamDevice;

/* Describes, for people, how a renderer launches its kernels, which affects no picture: "mega,
   groups of 64, at most 96 registers"; "as it suits the device" if all is automatic. */
void hd_launch_describe(const HdRenderOptions *options, char *text, int capacity);

/* ---- trials ---- */

typedef struct HdTrialRequest {
    double share; /* part of a frame's pixels, above 0, at most 1; 0: grow from 4096 samples, times
                     four, to a whole frame or to one of these */
    double trusted; /* picture time, in s, long enough to trust */
    double enough;  /* estimated time of the whole job, in s, short enough to stop */
    int times;      /* repetitions of each picture */
} HdTrialRequest;

/* Result of the last picture; each time is the least of its repetitions. */
typedef struct HdTrial {
    double seconds;       /* time of a picture, copies included */
    double frame_seconds; /* estimate for a whole frame */
    double trace_seconds; /* time of tracing without copies */
    int width, height;
    double share; /* approximate part of a frame's pixels */
} HdTrial;

/* Opens a renderer and uploads the job's scene. */
HdStatus hd_trial_open(HdRenderer **renderer, const HdDevice *device,
                       const HdRenderOptions *options, const HdJob *job, HdError *error);

/* Renders about that share of the job's first frame on a renderer that has its scene. */
HdStatus hd_trial(HdRenderer *renderer, const HdJob *job, const HdTrialRequest *selection,
                  HdTrial *trial, HdError *error);

/* Returns a request that estimates the time per frame within some hundredths of a second; any
   estimate will do if the job takes less than `enough` seconds. */
HdTrialRequest hd_trial_request(double enough);

/* ---- results ---- */

/* Stores in the cache folder (cache_folder.h) the devices' times, and their launches as far as
   `options` leave them open. The key is the program's version, the devices' names and drivers, the
   options, and properties of the scene. These are numbers of planes, triangles, instances, lights,
   endless lights and samples, and the depth, all rounded to powers of two; a floor; deep trees.
   Errors as hd_cache_put. */
HdStatus hd_measured_put(const HdTeamDevice *devices, int count, const HdRenderOptions *options,
                         const HdScene *scene, HdError *error);

/* Fills `seconds` and `options`. Returns false if nothing valid is stored. */
bool hd_measured_get(HdTeamDevice *devices, int count, const HdRenderOptions *options,
                     const HdScene *scene);

/* ---- devices ---- */

/* Opens a device with these options and its stored best launch, if any agrees with them; with
   `gets_scene` uploads the job's scene. */
HdStatus hd_team_device_open(HdTeamDevice *member, const HdRenderOptions *options, const HdJob *job,
                             bool gets_scene, HdError *error);

/* Closes a device, which need not be open. */
void hd_team_device_close(HdTeamDevice *member);

/* ---- tuning: the fastest launch of a device's kernels ---- */

enum { HD_TUNING_CANDIDATES = 24 };

typedef struct HdTuningCandidate {
    HdRenderOptions options; /* options with a definite pipeline */
    double seconds;          /* time to trace a picture, least of several; 0: it failed */
    char failure[512];       /* reason for a failure, or "" */
} HdTuningCandidate;

typedef struct HdTuning {
    HdTuningCandidate candidates[HD_TUNING_CANDIDATES]; /* the first is the device's default */
    int count;
    int best;
    int width, height; /* size of the pictures */
} HdTuning;

/* Measures launches that the options leave open. First come pipelines, on NVIDIA devices with
   several register limits. Then, with the best of those, come lanes on CPUs, and group size and
   number of groups on GPUs. Measures the fastest several times, alternating. Another candidate must
   be clearly faster to replace the best. One that fails is kept with its reason; the first one must
   work. Renders whole frames if they take less than a fifth of a second, else smaller pictures. */
HdStatus hd_tune(HdTuning *tuning, const HdDevice *device, const HdRenderOptions *options,
                 const HdJob *job, HdError *error);

/* Stores the best launch for later jobs of this kind on such a device and driver that leave the
   same options open. Errors as hd_measured_put. */
HdStatus hd_tuning_remember(const HdTuning *tuning, const HdDevice *device,
                            const HdRenderOptions *options, const HdScene *scene, HdError *error);

#endif
