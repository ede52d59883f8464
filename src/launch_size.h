/* SPDX-License-Identifier: MIT */
/* How much work one launch of a GPU's kernel gets, learned from how long earlier ones took. A
   launch keeps a display that the device drives from being drawn, and after some seconds its driver
   ends it. */
#ifndef HD_LAUNCH_SIZE_H
#define HD_LAUNCH_SIZE_H

#include <stdbool.h>

/* What launches should stay below, and what they grow to: between them there is room for noise. */
#define HD_LAUNCH_SECONDS     0.05
#define HD_LAUNCH_AIM_SECONDS 0.04

/* Work is counted in what the kernel goes through one by one: samples, or rays of a wavefront. */
typedef struct HdLaunchSize {
    int limit;       /* of the next launch */
    int least, most; /* of the limit; smaller launches would not take less time */
    int ceiling;     /* of the limit, since a launch took too long; `most` before */
    bool too_long;   /* a launch of this frame was */
} HdLaunchSize;

enum { HD_MOST_LAUNCH_WORK = 1 << 28 };

/* For kernels that nothing is known of, on a device with so many compute units: a first launch that
   gives each of the device's threads about one piece of work. */
HdLaunchSize hd_launch_size_start(int compute_units);

/* Launches of so much work, whatever they take. */
HdLaunchSize hd_launch_size_fixed(int work);

/* Call before the launches of a frame. Lets the limit grow again, by a quarter a frame, where a
   launch took too long once: the costly part of a picture comes back in each frame, after parts
   that cost nothing. */
void hd_launch_size_begin_frame(HdLaunchSize *size);

/* How many of the `left` items (at least 1) the next launch gets, each of `work` pieces: all of
   them, or one of equal parts, in whole multiples of `grain`, which run together in a group of
   threads. */
int hd_launch_size_items(const HdLaunchSize *size, int left, int work, int grain);

/* A launch of so much work took so long: the next ones take at most double that work, or less where
   it took too long. Much smaller ones than the limit only tell the latter, and the smallest
   nothing: they last as long as their slowest thread. */
void hd_launch_size_note(HdLaunchSize *size, double work, double seconds);

#endif
