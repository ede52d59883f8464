/* SPDX-License-Identifier: MIT */
/* Entry points for OpenCL. Arguments: the tables in the order of scene_tables.h, then as listed. */
#include "../common/render.h"

/* Without a group size every work item renders for itself, which suits CPUs. */
__kernel void hedron_render(SCENE_PARAMETERS int first_item, int item_count, int parts,
                            __global float *pixels, __global RayCounts *counts) {
#if HD_GROUP_SIZE
    __local Gathered group[HD_GROUP_SIZE];
    render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, (int)get_group_id(0),
                    (int)get_local_id(0), (int)get_local_size(0), group, pixels, counts);
#else
    int item = (int)get_global_id(0);
    if (item < item_count)
        render_item(SCENE_ARGUMENTS first_item + item, pixels, counts + first_item + item);
#endif
}

__kernel void hedron_sum_counts(__global const RayCounts *counts, int count,
                                __global RayCounts *sums) {
    sum_counts(counts, count, (int)get_global_id(0), (int)get_global_size(0), sums);
}
