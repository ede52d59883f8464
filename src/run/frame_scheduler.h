/* SPDX-License-Identifier: MIT */
/* Which of several tracers takes the next frame: slow ones do not keep fast ones waiting. */
#ifndef HD_RUN_FRAME_SCHEDULER_H
#define HD_RUN_FRAME_SCHEDULER_H

#include <pthread.h>
#include <stdbool.h>

#include "device/backend.h"

/* What is known of a tracer. Times are seconds of one clock. */
typedef struct HdScheduledWorker {
    bool is_gone;        /* takes no more frames */
    bool is_cpu;         /* or else a GPU */
    double seconds;      /* for a frame; 0: not known yet */
    int count_in_flight; /* frames under way */
    double busy_until;   /* when those will be finished */
} HdScheduledWorker;

/* The functions below may be called on any thread. */
typedef struct HdFrameScheduler {
    pthread_mutex_t mutex; /* of what follows */
    HdScheduledWorker list[HD_MAX_WORKERS];
    int count;
} HdFrameScheduler;

/* Whether tracer `number` is to take a frame now, if `left` frames, 1 or more, are left: if one of
   them would be finished last by others. One whose pace is not known takes a single frame. CPUs
   wait until the pace of every GPU is known, for theirs may be hundreds of times slower. The only
   tracer that there is takes what it gets. */
bool hd_scheduler_wants(HdFrameScheduler *scheduler, int number, int left, double now);

/* The tracer is known to take so long for a frame; it takes no more frames. */
void hd_scheduler_estimate(HdFrameScheduler *scheduler, int number, double seconds);
void hd_scheduler_leave(HdFrameScheduler *scheduler, int number);

/* A frame was begun; one was finished, for which the tracer took so long, or, `seconds` being 0,
   was given back. */
void hd_scheduler_begun(HdFrameScheduler *scheduler, int number, double now);
void hd_scheduler_ended(HdFrameScheduler *scheduler, int number, double seconds, double now);

#endif
