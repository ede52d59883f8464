/* SPDX-License-Identifier: MIT */
/* Renders the frames of a scene and stores them. */
#ifndef HD_SEQUENCE_H
#define HD_SEQUENCE_H

#include "backend.h"
#include "frame_list.h"
#include "scene.h"

typedef struct HdSequence {
    const HdScene *scene;
    const HdFrameList *frames;
    HdPrecision precision;
    const char *output;    /* a film's name, a sequence's pattern, or one picture's name */
    int frames_per_second; /* of a film */
    /* Called after each frame is stored; `done` counts from 1. Must return HD_OK to go on. */
    HdStatus (*stored)(void *context, int number, int done, const HdFrame *frame, double seconds,
                       HdError *error);
    void *context;
} HdSequence;

/* Checks that the output suits the number of frames. */
HdStatus hd_sequence_check(const HdSequence *sequence, HdError *error);

/* Renders with an open renderer. HD_INTERRUPTED after SIGINT or SIGTERM: pictures that were
   finished stay, a film is dropped. */
HdStatus hd_sequence_render(const HdSequence *sequence, HdRenderer *renderer, HdError *error);

#endif
