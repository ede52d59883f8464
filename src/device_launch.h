/* SPDX-License-Identifier: MIT */
/* What the backends with a device of their own share: how a frame is cut into launches. */
#ifndef HD_DEVICE_LAUNCH_H
#define HD_DEVICE_LAUNCH_H

enum {
    HD_MAX_LAUNCH_ITEMS = 1 << 22,
    HD_SUM_WORKERS = 1024,  /* work items of hedron_sum_counts; each writes one sum */
    HD_MIN_TABLE_BYTES = 16 /* of memory for a table: an empty one must point somewhere too */
};

/* How many work items one launch may have on a GPU. A launch on a device that drives a display is
   ended by its driver after some seconds: small devices get small launches, which still fill them
   several times over. */
int hd_gpu_launch_items(int compute_units);

/* Among how many threads of a group of `group_size` the samples of a pixel are shared: the greatest
   divisor of their number up to the group's size and 64, so that all of them have as many. */
int hd_gpu_sample_parts(int samples, int group_size);

#endif
