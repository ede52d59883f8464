/* SPDX-License-Identifier: MIT */
/* Renders the frames of a scene and stores them. */
#ifndef HD_RUN_SEQUENCE_H
#define HD_RUN_SEQUENCE_H

#include "choice/devices.h"
#include "output/frame_store.h"
#include "scene/scene.h"

typedef struct HdSequence {
    const HdScene *scene;
    HdResume *resume;            /* which frames there are, and which of them are finished */
    const HdOutputPlan *outputs; /* settled */
    const HdDeviceTeam *team;    /* open; may be empty where nothing is missing */
    /* Called once the scene is on the renderer of that number, before its first frame, for one
       renderer at a time. With several both this and the next function are called on other threads.
     */
    void (*uploaded)(void *context, int number, const HdSceneTables *tables);
    /* One of several renderers failed: others make its frames. */
    void (*dropped)(void *context, int number, const HdError *error);
    /* Called after each frame is stored, in their order, but on another thread, while later frames
       are rendered. Must return HD_OK to go on. */
    HdStatus (*stored)(void *context, const HdStoredFrame *stored, HdError *error);
    void *context;
    HdWatch *watch; /* counts the frames as they are traced; NULL: nobody looks */
} HdSequence;

/* Renders what is missing with one renderer, or with several together, and makes films of all:
   which renderer makes a frame makes no difference to its bytes. A renderer that fails ends the
   sequence only if it is the last one. The error is that of the first frame that failed; the frames
   before it are stored, those after it are not, though they may have been rendered. HD_INTERRUPTED
   after SIGINT, SIGTERM or SIGHUP: pictures that were finished stay, and so do films that were; the
   others are dropped. */
HdStatus hd_sequence_render(const HdSequence *sequence, HdError *error);

#endif
