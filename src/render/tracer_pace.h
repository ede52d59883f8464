/* SPDX-License-Identifier: MIT */
/* Which of several tracers takes the next frame, so that slow ones do not keep fast ones waiting.
 */
#ifndef HD_RENDER_TRACER_PACE_H
#define HD_RENDER_TRACER_PACE_H

#include <stdbool.h>

#include "device/renderer.h"

/* What is known of a tracer. Times are seconds of one clock. */
typedef struct HdTracerPace {
    bool is_gone;      /* takes no more frames */
    bool is_cpu;       /* or else a GPU */
    double seconds;    /* for a frame; 0: not known yet */
    int in_flight;     /* frames under way */
    double busy_until; /* when those will be finished */
} HdTracerPace;

/* Whether tracer `number` is to take a frame now, if `left` frames, 1 or more, are left: if one of
   them would be finished last by others. One whose pace is not known takes a single frame. CPUs
   wait until the pace of every GPU is known, for theirs may be hundreds of times slower. */
bool hd_tracer_pace_wants(const HdTracerPace *paces, int count, int number, int left, double now);

/* A frame was begun. */
void hd_tracer_pace_begun(HdTracerPace *pace, double now);

/* A frame was finished for which the tracer took so long. */
void hd_tracer_pace_finished(HdTracerPace *pace, double seconds, double now);

/* A frame that was begun is given back. */
void hd_tracer_pace_given_back(HdTracerPace *pace, double now);

#endif
