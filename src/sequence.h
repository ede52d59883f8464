/* SPDX-License-Identifier: MIT */
/* Renders the frames of a scene and stores them. */
#ifndef HD_SEQUENCE_H
#define HD_SEQUENCE_H

#include "backend.h"
#include "frame_list.h"
#include "frame_store.h"
#include "outputs.h"
#include "scene.h"

typedef struct HdSequence {
    const HdScene *scene;
    const HdFrameList *frames; /* to be rendered: what is missing */
    const HdResume *resume;    /* all frames of the run, and which of them are finished */
    HdPrecision precision;
    const HdOutputPlan *outputs; /* one that hd_outputs_check accepted */
    /* Called once the scene is on the device, before the first frame. */
    void (*uploaded)(void *context, const HdSceneTables *tables);
    /* Called after each frame is stored, in their order, but on another thread, while later frames
       are rendered. Must return HD_OK to go on. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
} HdSequence;

/* Renders what is missing with an open renderer, NULL where nothing is, and makes films of all. The
   error is that of the first frame that failed; the frames before it are stored, those after it are
   not, though they may have been rendered. HD_INTERRUPTED after SIGINT, SIGTERM or SIGHUP: pictures
   that were finished stay, and so do films that were; the others are dropped. */
HdStatus hd_sequence_render(const HdSequence *sequence, HdRenderer *renderer, HdError *error);

#endif
