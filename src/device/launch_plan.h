/* SPDX-License-Identifier: MIT */
/* Splits a frame into kernel launches: how much work each gets, and how a wavefront
   (kernels/common/wavefront.h) fits into memory and traces one ray depth at a time. */
#ifndef HD_DEVICE_LAUNCH_PLAN_H
#define HD_DEVICE_LAUNCH_PLAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/limits.h"
#include "kernels/host/shared.h"
#include "tables/table.h"

/* ---- size of a launch, on GPUs and on OpenCL's CPUs, learned from the times of earlier ones. A
   launch on a GPU blocks the display that it drives, and after some seconds the driver ends it.
   ---- */

/* Limits of a launch in seconds: on a device that may drive a display, whose driver ends long
   launches, and on others, where only the program waits. */
#define HD_LAUNCH_SECONDS      0.05
#define HD_LAUNCH_SECONDS_FREE 0.5

/* Share of the limit that launches grow to; the rest absorbs noise. */
#define HD_LAUNCH_AIM 0.8

/* Work is counted in the kernel's units: samples, or rays of a wavefront. */
typedef struct HdLaunchSize {
    int limit;         /* maximum work of the next launch */
    int least, most;   /* bounds of the limit; smaller launches take no less time */
    int ceiling;       /* reduced upper bound after a launch that took too long; otherwise `most` */
    int fewest_groups; /* thread groups of a launch, at least: fewer leave units idle */
    double longest;    /* limit of a launch in seconds */
    double tail;       /* seconds of the slowest threads, whatever the launch; 0: not seen */
    bool too_long;     /* a launch of this frame took too long */
    bool has_tail;     /* a smaller one took about as long */
    double slow_work, slow_seconds; /* those of a launch that took too long, to compare */
} HdLaunchSize;

enum { HD_MAX_LAUNCH_WORK = 1 << 28 };

/* Returns the size for unknown kernels: about one unit of work for each thread of a device with so
   many compute units. `longest` is in seconds. */
HdLaunchSize hd_launch_size_start(int compute_units, double longest);

/* Returns a size that stays at so much work, whatever the time. */
HdLaunchSize hd_launch_size_fixed(int work);

/* Prepares for a frame; must precede its launches. After a launch that took too long the limit
   grows again, by a quarter a frame, since a picture's expensive part returns in each frame. */
void hd_launch_size_begin_frame(HdLaunchSize *size);

/* Returns how many of the `left` items (at least 1), each of `work` units, the next launch gets:
   all or one of equal parts. A part is a multiple of the `grain` of a thread group and keeps all
   compute units busy. */
int hd_launch_size_items(const HdLaunchSize *size, int left, int work, int grain);

/* Learns from a launch: the next ones have at most double its work, or less if it took too long. If
   a much smaller one takes about as long, the slowest threads dominate and cutting does not help:
   launches may then take half as long again. Launches much smaller than the limit serve only to
   detect that, the smallest not at all. */
void hd_launch_size_note(HdLaunchSize *size, double work, double seconds);

/* ---- the queue of a wavefront, and the order in which a device with thread groups traces ray
   depths ---- */

enum { HD_WAVE_PACKET = 16 }; /* a multiple of every number of lanes */

typedef struct HdWaveNeeds {
    size_t bytes; /* memory budget, unless the least that works is more */
    HdPrecision precision;
    int depth;
    int grain;           /* rays of a packet or of a thread group */
    int samples;         /* of a frame, or of the items that share one queue at a time */
    int samples_at_once; /* granularity of a batch; divides `samples` */
} HdWaveNeeds;

/* Buffers: the rays' reals, their integers, and the samples' sums. */
enum { HD_WAVE_BUFFERS = 3 };

typedef struct HdWavePlan {
    int queue_stride; /* rays of the queue, at most */
    int sum_stride;   /* samples of a batch */
    size_t bytes[HD_WAVE_BUFFERS];
} HdWavePlan;

HdWavePlan hd_wave_plan(const HdWaveNeeds *needs);

/* Halves the queue's budget after the device refused it; returns false at HD_WAVE_MIN_BYTES. */
enum { HD_WAVE_MIN_BYTES = 1 << 20 };
bool hd_wave_halve(HdWaveNeeds *needs);

/* Returns the samples of so many items, limited to the range of int. */
int hd_wave_samples(int items, int samples_per_item);

/* Returns the thread groups of the largest launch, at most `grid`; 0: automatic. Each has its own
   counts. The first launch of a frame must have them all. */
int hd_wave_groups(const HdWavePlan *plan, int group_size, int grid);

typedef enum HdWaveAction {
    HD_WAVE_TRACES, /* launch: rays of one depth, or samples of the batch for depth 0 */
    HD_WAVE_STORES, /* store of the pixels of the finished batch */
    HD_WAVE_IS_DONE
} HdWaveAction;

/* One step of a device. */
typedef struct HdWaveStep {
    HdWaveAction action;
    int first_item, item_count; /* items of the batch */
    WaveChunk chunk;            /* rays of the launch, as many as the queue's capacity allows */
    unsigned taken_before;      /* value of the counter of used places */
    bool is_first;              /* first step of the frame */
} HdWaveStep;

/* Progress through a frame, one batch at a time; other members start at 0. */
typedef struct HdWaveRun {
    const HdWavePlan *plan;
    int items, samples_per_item;
    int depth, grain; /* as in the plan */
    HdWaveStep step;  /* current step */
    WaveSegment stack[WAVE_STACK_SIZE(HD_MAX_DEPTH)];
    int top;
} HdWaveRun;

/* Advances to the next step. `taken` is the counter of used places, 0 before the first step; `size`
   is that of launches, in rays. HD_INTERRUPTED if a signal came before a launch. */
HdStatus hd_wave_next(HdWaveRun *run, unsigned taken, const HdLaunchSize *size, HdError *error);

#endif
