/* SPDX-License-Identifier: MIT */
/* Entry points for OpenCL. Arguments: the tables in the order of scene_tables.h, then as listed.
   Without a group size every work item renders for itself, which suits CPUs. */
#include "../common/encode.h"
#include "../common/render.h"
#if HD_WAVEFRONT
#include "../common/wavefront.h"
#endif

#if HD_WAVEFRONT && HD_GROUP_SIZE

__kernel void hedron_trace_take(SCENE_PARAMETERS QUEUE_PARAMETERS int first_item, int level,
                                int first, int count, int to, uint taken_before,
                                int is_first_launch, __global uint *taken,
                                __global RayCounts *counts) {
    __local uint64 room[2 * HD_GROUP_SIZE];
    __local uint place;
    trace_take_by_group(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, level, first, count, to,
                        taken_before, is_first_launch, (int)get_group_id(0), (int)get_num_groups(0),
                        (int)get_local_id(0), (int)get_local_size(0), room, &place, taken, counts);
}

__kernel void hedron_store_batch(__global const Header *header, __global const View *view,
                                 __global const fixed64 *sums, int sum_stride, int first_item,
                                 int item_count, __global float *pixels) {
    store_batch(header, view, sums, sum_stride, first_item, item_count, (int)get_global_id(0),
                (int)get_global_size(0), pixels);
}

#elif HD_WAVEFRONT

__kernel void hedron_render_by_waves(SCENE_PARAMETERS QUEUE_PARAMETERS int item_count,
                                     __global float *pixels, __global RayCounts *counts) {
    render_items_by_waves(SCENE_ARGUMENTS QUEUE_ARGUMENTS item_count, (int)get_global_id(0),
                          (int)get_global_size(0), pixels, counts);
}

#else

__kernel void hedron_render(SCENE_PARAMETERS int first_item, int item_count, int parts,
                            __global float *pixels, __global RayCounts *counts) {
#if HD_GROUP_SIZE
    __local fixed64 room[GROUP_ROOM * HD_GROUP_SIZE];
    render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, (int)get_group_id(0),
                    (int)get_num_groups(0), (int)get_local_id(0), (int)get_local_size(0), room,
                    pixels, counts);
#else
    int item = (int)get_global_id(0);
    if (item < item_count)
        render_item(SCENE_ARGUMENTS first_item + item, pixels, counts + first_item + item);
#endif
}

#endif

__kernel void hedron_sum_counts(__global const RayCounts *counts, int count,
                                __global RayCounts *sums, int workers) {
    if ((int)get_global_id(0) < workers)
        sum_counts(counts, count, (int)get_global_id(0), workers, sums);
}

#if HD_GROUP_SIZE

__kernel void hedron_encode(__global const int *pixels, int count, __global const int *thresholds,
                            __global uint *image) {
    encode_pixels(pixels, count, thresholds, (int)get_global_id(0), (int)get_global_size(0), image);
}

#endif
