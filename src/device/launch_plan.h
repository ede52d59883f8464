/* SPDX-License-Identifier: MIT */
/* How a frame becomes launches of kernels: how much work each gets, and how a wavefront
   (kernels/common/wavefront.h) fits into memory and is traced level by level. */
#ifndef HD_DEVICE_LAUNCH_PLAN_H
#define HD_DEVICE_LAUNCH_PLAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/limits.h"
#include "kernels/host/shared.h"
#include "tables/table.h"

/* ---- how much work one launch gets, on GPUs and on OpenCL's CPUs, learned from how long earlier
   ones took. On a GPU a launch keeps a display that the device drives from being drawn, and after
   some seconds its driver ends it. ---- */

/* What launches should stay below on a device that may be drawing a display, whose driver ends
   those that take too long, and on others, where only the program itself waits. */
#define HD_LAUNCH_SECONDS      0.05
#define HD_LAUNCH_SECONDS_FREE 0.5

/* What launches grow to, of that: between them there is room for noise. */
#define HD_LAUNCH_AIM 0.8

/* Work is counted in what the kernel goes through one by one: samples, or rays of a wavefront. */
typedef struct HdLaunchSize {
    int limit;         /* of the next launch */
    int least, most;   /* of the limit; smaller launches would not take less time */
    int ceiling;       /* of the limit, since a launch took too long; `most` before */
    int fewest_groups; /* of threads, of a launch: fewer would leave units idle */
    double longest;    /* seconds that launches should stay below */
    double tail;   /* seconds of the slowest threads, in whatever launch they are; 0: not seen */
    bool too_long; /* a launch of this frame was */
    bool has_tail; /* and a smaller one took about as long */
    double slow_work, slow_seconds; /* of a launch that was too long, to compare others with */
} HdLaunchSize;

enum { HD_MAX_LAUNCH_WORK = 1 << 28 };

/* Of kernels that nothing is known of: gives each thread of a device with so many compute units
   about one piece of work at first. `longest` is in seconds. */
HdLaunchSize hd_launch_size_start(int compute_units, double longest);

/* Launches of so much work, whatever they take. */
HdLaunchSize hd_launch_size_fixed(int work);

/* Call before the launches of a frame. Lets the limit grow again, by a quarter a frame, after a
   launch that took too long: a picture's costly part comes back in each frame. */
void hd_launch_size_begin_frame(HdLaunchSize *size);

/* Returns how many of the `left` items (at least 1), each of `work` pieces, the next launch gets:
   all or one of equal parts, whole multiples of the `grain` of a group of threads, and not fewer
   than all compute units have room for. */
int hd_launch_size_items(const HdLaunchSize *size, int left, int work, int grain);

/* Learns from a launch: the next ones take at most double its work, or less if it took too long. If
   a much smaller one of the frame takes about as long, the slowest threads last, and cutting is no
   help: launches may then be half as long again as those. Launches much smaller than the limit only
   tell the latter, and the smallest nothing. */
void hd_launch_size_note(HdLaunchSize *size, double work, double seconds);

/* ---- the queue of a wavefront, and in which order a device with groups of threads traces its
   levels ---- */

enum { HD_WAVE_PACKET = 16 }; /* a multiple of every number of lanes */

typedef struct HdWaveNeeds {
    size_t bytes; /* to be used at most, unless the least that works is more */
    HdPrecision precision;
    int depth;
    int grain;           /* rays of a packet or of a group of threads */
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

HdWavePlan hd_wave_plan(const HdWaveNeeds *needs);

/* Halves the bytes that a queue may use, for a device that refused it; false where these are
   HD_WAVE_MIN_BYTES already. */
enum { HD_WAVE_MIN_BYTES = 1 << 20 };
bool hd_wave_halve(HdWaveNeeds *needs);

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
    WaveChunk chunk;            /* that a launch traces: as many rays as there is room for */
    unsigned taken_before;      /* what the counter of taken places is as yet */
    bool is_first;              /* of the frame */
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
