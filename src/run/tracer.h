/* SPDX-License-Identifier: MIT */
/* Traces frames of a sequence on one device, and gives them to the store; which of several tracers
   takes the next frame. */
#ifndef HD_RUN_TRACER_H
#define HD_RUN_TRACER_H

#include <pthread.h>
#include <stdbool.h>

#include "device/renderer.h"
#include "output/frame_store.h"
#include "scene/frame_list.h"
#include "scene/scene.h"

/* ---- turns: slow tracers do not keep fast ones waiting ---- */

/* What is known of a tracer. Times are seconds of one clock. */
typedef struct HdTurn {
    bool is_gone;      /* takes no more frames */
    bool is_cpu;       /* or else a GPU */
    double seconds;    /* for a frame; 0: not known yet */
    int in_flight;     /* frames under way */
    double busy_until; /* when those will be finished */
} HdTurn;

/* The functions below may be called on any thread. */
typedef struct HdTurns {
    pthread_mutex_t mutex; /* of what follows */
    HdTurn list[HD_MOST_TRACERS];
    int count;
} HdTurns;

/* Whether tracer `number` is to take a frame now, if `left` frames, 1 or more, are left: if one of
   them would be finished last by others. One whose pace is not known takes a single frame. CPUs
   wait until the pace of every GPU is known, for theirs may be hundreds of times slower. The only
   tracer that there is takes what it gets. */
bool hd_turns_want(HdTurns *turns, int number, int left, double now);

/* The tracer is known to take so long for a frame; it takes no more frames. */
void hd_turns_estimate(HdTurns *turns, int number, double seconds);
void hd_turns_leave(HdTurns *turns, int number);

/* A frame was begun; one was finished, for which the tracer took so long; one that was begun is
   given back. */
void hd_turns_begun(HdTurns *turns, int number, double now);
void hd_turns_finished(HdTurns *turns, int number, double seconds, double now);
void hd_turns_given_back(HdTurns *turns, int number, double now);

/* ---- tracers ---- */

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
