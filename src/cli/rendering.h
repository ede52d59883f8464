/* SPDX-License-Identifier: MIT */
/* What the commands that render share: frames rendered and stored. */
#ifndef HD_CLI_RENDERING_H
#define HD_CLI_RENDERING_H

#include "choice/candidates.h"
#include "cli/options.h"
#include "input/scene_file.h"
#include "run/sequence.h"

typedef struct HdRendering {
    const char *name; /* of the scene, for people */
    const HdSceneFile *file;
    const HdFrameList *frames;
    HdOutputPlan *outputs; /* settled for these frames; is marked */
    HdDeviceKind device_kind;
    bool resumes;        /* frames that are finished are not rendered again */
    bool tells_progress; /* in plain lines, where standard error is no terminal */
    /* Called after each frame is stored; NULL: not wanted. Must return HD_OK to go on. */
    HdStatus (*stored)(const HdStoredFrame *stored, HdError *error);
} HdRendering;

/* Renders the frames that are missing (resume.h) and stores them. Unless nothing is
   missing, devices are chosen by the options and `device_kind` and opened first. Progress goes to
   standard error, and so does a sentence if a GPU was preferred and none was found, and what
   --verbose asks for; with --quiet nothing does. */
HdStatus hd_render(const HdRendering *rendering, const HdOptions *options, HdError *error);

#endif
