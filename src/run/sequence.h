/* SPDX-License-Identifier: MIT */
/* Renders the frames of a scene and stores them. */
#ifndef HD_RUN_SEQUENCE_H
#define HD_RUN_SEQUENCE_H

#include "choice/devices.h"
#include "output/frame_store.h"
#include "scene/scene.h"

typedef struct HdSequence {
    const HdScene *scene;
    HdResume *resume;            /* frames of the run and their state */
    const HdOutputPlan *outputs; /* settled */
    const HdDeviceTeam *team;    /* open; may be empty if no frame is missing */
    /* Reports that renderer `number` has the scene, before its first frame, for one renderer at a
       time. With several renderers this and the next function are called on other threads. */
    void (*uploaded)(void *context, int number, const HdSceneTables *tables);
    /* Reports that one of several renderers failed; others render its frames. */
    void (*dropped)(void *context, int number, const HdError *error);
    /* Reports each stored frame, in order, on another thread, while later frames are rendered.
       Returns HD_OK to continue. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
    HdWatch *watch; /* counts traced frames; NULL: none */
} HdSequence;

/* Renders the missing frames with one or several renderers and completes all films; the choice of
   renderer does not affect a frame's bytes. A renderer's failure ends the sequence only if it is
   the last one. Returns the error of the first failed frame; frames before it are stored, later
   ones are not. Returns HD_INTERRUPTED after SIGINT, SIGTERM or SIGHUP: finished pictures and films
   stay, others are discarded. */
HdStatus hd_sequence_render(const HdSequence *sequence, HdError *error);

#endif
