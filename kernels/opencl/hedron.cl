/* SPDX-License-Identifier: MIT */
/* Entry points for OpenCL. Arguments: the tables in the order of scene_tables.h, then as listed. */
#include "../common/render.h"

__kernel void hedron_render(SCENE_PARAMETERS int first_item, int item_count, __global float *pixels,
                            __global RayCounts *counts) {
    int item = (int)get_global_id(0);
    if (item < item_count)
        render_item(SCENE_ARGUMENTS first_item + item, pixels, counts + first_item + item);
}

__kernel void hedron_sum_counts(__global const RayCounts *counts, int count,
                                __global RayCounts *sums) {
    sum_counts(counts, count, (int)get_global_id(0), (int)get_global_size(0), sums);
}
