/* SPDX-License-Identifier: MIT */
/* Schedules frames among several workers, so that slow ones do not delay fast ones. */
#ifndef HD_RUN_FRAME_SCHEDULER_H
#define HD_RUN_FRAME_SCHEDULER_H

#include <pthread.h>
#include <stdbool.h>

#include "device/backend.h"

/* State of a worker. Times are seconds of one clock. */
typedef struct HdScheduledWorker {
    bool is_gone;        /* claims no more frames */
    bool is_cpu;         /* otherwise a GPU */
    double seconds;      /* time per frame; 0: not known yet */
    int count_in_flight; /* frames in flight */
    double busy_until;   /* time when those will be finished */
} HdScheduledWorker;

/* All functions below are thread-safe. */
typedef struct HdFrameScheduler {
    pthread_mutex_t mutex; /* lock of the members below */
    HdScheduledWorker list[HD_MAX_WORKERS];
    int count;
} HdFrameScheduler;

/* Returns whether worker `number` should claim a frame now: whether it would finish one of the
   `left` remaining frames (1 or more) before the others finish them all. A worker of unknown speed
   claims one frame. CPUs wait until every GPU's speed is known, for they may be hundreds of times
   slower. A single worker claims all. */
bool hd_scheduler_wants(HdFrameScheduler *scheduler, int number, int left, double now);

/* Set a worker's time per frame; mark it as gone. */
void hd_scheduler_estimate(HdFrameScheduler *scheduler, int number, double seconds);
void hd_scheduler_leave(HdFrameScheduler *scheduler, int number);

/* Record a started frame; record a frame finished in `seconds`, or released if 0. */
void hd_scheduler_begun(HdFrameScheduler *scheduler, int number, double now);
void hd_scheduler_ended(HdFrameScheduler *scheduler, int number, double seconds, double now);

#endif
