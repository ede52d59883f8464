/* SPDX-License-Identifier: MIT */
/* How a wavefront (kernels/common/wavefront.h) fits into memory, and in which order a device with
   groups of threads traces its levels. */
#ifndef HD_DEVICE_WAVE_PLAN_H
#define HD_DEVICE_WAVE_PLAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/limits.h"
#include "device/launch_size.h"
#include "kernels/host/shared.h"
#include "tables/tables.h"

enum { HD_WAVE_BUNDLE = 16 }; /* a multiple of every number of lanes */

typedef struct HdWaveNeeds {
    size_t bytes; /* to be used at most, unless the least that works is more */
    HdPrecision precision;
    int depth;
    int grain;           /* rays of a bundle or of a group of threads */
    int samples;         /* of a frame, or of all that one queue is used for at a time */
    int samples_at_once; /* a batch has whole multiples of this; divides `samples` */
} HdWaveNeeds;

/* Of the rays' reals, their integers, and the samples' sums. */
enum { HD_WAVE_BUFFERS = 3 };

typedef struct HdWavePlan {
    int queue_stride; /* rays that the queue has room for */
    int sum_stride;   /* samples of a batch */
    size_t bytes[HD_WAVE_BUFFERS];
} HdWavePlan;

/* What a device with that much memory should give to its queue: an eighth, at most a GiB. */
size_t hd_wave_budget(uint64_t device_memory);

HdWavePlan hd_wave_plan(const HdWaveNeeds *needs);

/* Halves the bytes that a queue may use, for a device that refused it; false where these are
   HD_WAVE_LEAST_BYTES already. */
enum { HD_WAVE_LEAST_BYTES = 1 << 20 };
bool hd_wave_halve(HdWaveNeeds *needs);

/* For the line about a renderer: that the queue was cut to so many bytes. */
void hd_wave_tell_cut(size_t bytes, char *text, int capacity);

/* The samples of so many items, or as many of them as can be counted. */
int hd_wave_samples(int items, int samples_per_item);

/* The groups of threads of the largest launch; `grid` is the most there may be, 0: what suits. Each
   has counts of its own. The first launch of a frame must have them all. */
int hd_wave_groups(const HdWavePlan *plan, int group_size, int grid);

typedef enum HdWaveAction {
    HD_WAVE_TRACES, /* a launch: rays of a level, or samples of the batch for level 0 */
    HD_WAVE_STORES, /* the pixels of the batch, which is finished */
    HD_WAVE_IS_DONE
} HdWaveAction;

/* What a device does, one step after the other. */
typedef struct HdWaveStep {
    HdWaveAction action;
    int first_item, item_count; /* of the batch */
    int level, first, count, to;
    unsigned taken_before; /* what the counter of taken places is as yet */
    bool is_first;         /* of the frame */
} HdWaveStep;

/* The way through a frame, a batch at a time; the rest is 0 at first. */
typedef struct HdWaveRun {
    const HdWavePlan *plan;
    int items, samples_per_item;
    int depth, grain; /* as the plan was made for */
    HdWaveStep step;  /* the present one */
    WaveSegment stack[WAVE_STACK_SIZE(HD_MAX_DEPTH)];
    int top;
} HdWaveRun;

/* Goes on to the next step, where the counter of taken places has come to `taken`, which is 0
   before the first one; `size` is that of launches, in rays. HD_INTERRUPTED where a signal came
   before a launch. */
HdStatus hd_wave_next(HdWaveRun *run, unsigned taken, const HdLaunchSize *size, HdError *error);

#endif
