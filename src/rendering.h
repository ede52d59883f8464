/* SPDX-License-Identifier: MIT */
/* What the commands that render share: options applied to a scene, frames rendered and stored. */
#ifndef HD_RENDERING_H
#define HD_RENDERING_H

#include "device_choice.h"
#include "options.h"
#include "sequence.h"

/* Lays size, samples, depth and cut-off of the command line over the scene, and checks the result.
 */
HdStatus hd_apply_scene_options(HdScene *scene, const HdOptions *options, HdError *error);

typedef struct HdRendering {
    const HdScene *scene; /* one that hd_apply_scene_options accepted */
    const char *output;   /* as HdSequence's */
    HdDeviceKind device_kind;
    /* Called after each frame is stored; NULL: not wanted. Must return HD_OK to go on. */
    HdStatus (*stored)(int number, const HdFrame *frame, double seconds, HdError *error);
} HdRendering;

/* Renders the frames that the options name, all of them if they name none, and stores them. The
   output is checked against the number of frames first, then a device is chosen by the options and
   `device_kind` and opened. Progress goes to standard error, where that is a terminal, and so does
   a sentence if a GPU was preferred and none was found. */
HdStatus hd_render(const HdRendering *rendering, const HdOptions *options, HdError *error);

#endif
