/* SPDX-License-Identifier: MIT */
/* How much work one launch of a kernel gets, on GPUs and on OpenCL's CPUs, learned from how long
   earlier ones took. On a GPU a launch keeps a display that the device drives from being drawn, and
   after some seconds its driver ends it. */
#ifndef HD_DEVICE_LAUNCH_SIZE_H
#define HD_DEVICE_LAUNCH_SIZE_H

#include <stdbool.h>

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

enum { HD_MOST_LAUNCH_WORK = 1 << 28 };

/* For kernels that nothing is known of, on a device with so many compute units: a first launch that
   gives each of the device's threads about one piece of work. `longest` is in seconds, one
   of the two times above unless somebody asks for another. */
HdLaunchSize hd_launch_size_start(int compute_units, double longest);

/* Launches of so much work, whatever they take. */
HdLaunchSize hd_launch_size_fixed(int work);

/* Call before the launches of a frame. Lets the limit grow again, by a quarter a frame, where a
   launch took too long once: the costly part of a picture comes back in each frame, after parts
   that cost nothing. */
void hd_launch_size_begin_frame(HdLaunchSize *size);

/* How many of the `left` items (at least 1) the next launch gets, each of `work` pieces: all of
   them, or one of equal parts, in whole multiples of `grain`, which run together in a group of
   threads. Not fewer than all compute units have room for. */
int hd_launch_size_items(const HdLaunchSize *size, int left, int work, int grain);

/* A launch of so much work took so long: the next ones take at most double that work, or less where
   it took too long. Where a much smaller one of the frame takes about as long, it is the slowest
   threads that last, and cutting is no help: launches may then be half as long again as those. Much
   smaller ones than the limit only tell the latter, and the smallest nothing. */
void hd_launch_size_note(HdLaunchSize *size, double work, double seconds);

#endif
