/* SPDX-License-Identifier: MIT */
/* Traces frames of a sequence on one device, and gives them to the store. */
#ifndef HD_RUN_TRACER_H
#define HD_RUN_TRACER_H

#include "device/renderer.h"
#include "output/frame_store.h"
#include "run/turns.h"
#include "scene/frame_list.h"
#include "scene/scene.h"

/* The same for all that trace frames of a sequence. */
typedef struct HdTracerJob {
    const HdScene *scene;
    const HdFrameList *frames;
    HdFrameWish wish;
    HdWatch *watch; /* NULL: nobody looks */
    double start;   /* of the run, by hd_monotonic_seconds */
    HdFrameStore *store;
    HdStages *stages; /* of the store */
    HdTurns *turns;
} HdTracerJob;

/* Traces frames until the store has none left for tracer `number`, whose renderer has the scene.
   What a frame itself is to blame for, the store is told. Fails where the device fails
   (hd_renderer_has_failed), which is its fault as is all that fails before the first frame, and
   with HD_INTERRUPTED after a signal: what was under way is then given back to the store. */
HdStatus hd_trace_frames(const HdTracerJob *job, HdRenderer *renderer, int number,
                         bool *is_fault_of_device, HdError *error);

#endif
