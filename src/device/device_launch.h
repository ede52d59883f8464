/* SPDX-License-Identifier: MIT */
/* What the backends with a device of their own share: how a launch is laid out. */
#ifndef HD_DEVICE_DEVICE_LAUNCH_H
#define HD_DEVICE_DEVICE_LAUNCH_H

enum {
    HD_SUM_WORKERS = 1024,  /* work items of hedron_sum_counts; each writes one sum */
    HD_MIN_TABLE_BYTES = 16 /* of memory for a table: an empty one must point somewhere too */
};

/* Among how many threads of a group of `group_size` the samples of a pixel are shared: the greatest
   divisor of their number up to the group's size and 64, so that all of them have as many. */
int hd_gpu_sample_parts(int samples, int group_size);

#endif
