/* SPDX-License-Identifier: MIT */
/* What the backends with a device of their own share: how a frame is cut into launches, and how the
   counts of its work items come together. */
#ifndef HD_DEVICE_LAUNCH_H
#define HD_DEVICE_LAUNCH_H

#include <stddef.h>

#include "frame.h"

enum {
    HD_MAX_LAUNCH_ITEMS = 1 << 22,
    HD_SUM_WORKERS = 1024, /* work items of hedron_sum_counts; each writes one sum */
    HD_COUNTS_BYTES = 32   /* of the counts of one work item, and of one sum */
};

/* The kernels' RayCounts. */
typedef struct HdItemCounts {
    uint64_t rays, shadow_tests, clamps, unused;
} HdItemCounts;

/* How many work items one launch may have on a GPU. A launch on a device that drives a display is
   ended by its driver after some seconds: small devices get small launches, which still fill them
   several times over. */
int hd_gpu_launch_items(int compute_units);

/* Adds the workers' sums up into `frame`. */
void hd_frame_set_counts(HdFrame *frame, const HdItemCounts sums[HD_SUM_WORKERS]);

/* Seconds on a clock that only goes forward. */
double hd_monotonic_seconds(void);

#endif
