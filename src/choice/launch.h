/* SPDX-License-Identifier: MIT */
/* What a renderer may choose without changing a picture, and what was once found the best. */
#ifndef HD_CHOICE_LAUNCH_H
#define HD_CHOICE_LAUNCH_H

#include <stdbool.h>

#include "choice/trial.h"

/* As in HdRenderOptions: 0 and HD_PIPELINE_AUTO stand for what suits the device. */
typedef struct HdLaunch {
    HdPipeline pipeline;
    int lanes, block, grid, registers;
} HdLaunch;

/* What the options say. */
HdLaunch hd_launch_of(const HdRenderOptions *options);

/* The options with that choice instead of their own. */
HdRenderOptions hd_launch_options(const HdRenderOptions *options, const HdLaunch *launch);

/* For people: "mega, groups of 64, at most 96 registers"; "as it suits the device" where nothing is
   chosen. */
void hd_launch_describe(const HdLaunch *launch, char *text, int capacity);

/* Remembers the choice (record.h) for later jobs alike on such a device, with the same driver, that
   leave the same open. */
HdStatus hd_launch_remember(const HdDevice *device, const HdRenderOptions *options,
                            const HdScene *scene, const HdLaunch *launch, HdError *error);

/* Takes the choice that was remembered. It keeps to what the options say. False where there is
   none, or one that makes no sense: then it is what the options say. */
bool hd_launch_recall(HdLaunch *launch, const HdDevice *device, const HdRenderOptions *options,
                      const HdScene *scene);

/* A device that renders, or that may. */
typedef struct HdTeamDevice {
    HdDevice device;
    HdRenderer *renderer; /* owned; NULL: it is not open */
    HdLaunch launch;      /* of an open device: what it was opened with */
    bool is_tuned;        /* that was remembered */
} HdTeamDevice;

/* Opens a device with these options, and with what is remembered for them, if anything is; with
   `gets_scene` the job's scene is on it then. */
HdStatus hd_launch_open(HdTeamDevice *member, const HdRenderOptions *options, const HdJob *job,
                        bool gets_scene, HdError *error);

/* A device that is not open may be closed. */
void hd_launch_close(HdTeamDevice *member);

#endif
