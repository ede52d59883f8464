/* SPDX-License-Identifier: MIT */
/* Renders the frames of a scene and stores them. */
#ifndef HD_SEQUENCE_H
#define HD_SEQUENCE_H

#include "backend.h"
#include "frame_list.h"
#include "outputs.h"
#include "scene.h"

/* Where the time of one frame went, in seconds. */
typedef struct HdFrameTimes {
    double prepare; /* the camera and its tables */
    double trace;   /* on the device */
    double copy;    /* the rest of the renderer's call */
    double convert; /* to 8 bits, where a film needs it */
    double store;   /* writing pictures, handing frames to FFmpeg */
} HdFrameTimes;

/* What is known once a frame is stored. */
typedef struct HdStoredFrame {
    int number;
    int done; /* frames stored so far, this one included */
    const HdFrame *frame;
    HdFrameTimes times;
} HdStoredFrame;

typedef struct HdSequence {
    const HdScene *scene;
    const HdFrameList *frames;
    HdPrecision precision;
    const HdOutputPlan *outputs; /* one that hd_outputs_check accepted */
    /* Called once the scene is on the device, before the first frame. */
    void (*uploaded)(void *context, const HdSceneTables *tables);
    /* Called after each frame is stored. Must return HD_OK to go on. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
} HdSequence;

/* Renders with an open renderer. HD_INTERRUPTED after SIGINT, SIGTERM or SIGHUP: pictures that were
   finished stay, and so do films that were; the others are dropped. */
HdStatus hd_sequence_render(const HdSequence *sequence, HdRenderer *renderer, HdError *error);

#endif
