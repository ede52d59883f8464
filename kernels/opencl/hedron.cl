/* SPDX-License-Identifier: MIT */
/* Entry points for OpenCL; their parameters are those of kernel_arguments.h, by the names there.
   Without a group size every work item renders for itself, which suits CPUs. */
#include "dialect.h"

/* The text has each file once, where it is asked for first: what either part needs comes before. */
#include "../common/division.h"
#include "../common/kernel_arguments.h"
#include "../common/scene_tables.h"
#if HD_PROBE
#include "../common/probe.h"
#else
#include "../common/render.h"
#if HD_WAVEFRONT
#include "../common/wavefront.h"
#endif
#endif

/* A kernel whose items are bundles already: Intel's compiler takes several times as long to find
   out that it cannot do many items at a time. */
#if HD_GROUP_SIZE
#define KERNEL __kernel
#else
#define KERNEL __kernel __attribute__((vec_type_hint(vreal)))
#endif

#if HD_PROBE

KERNEL void hedron_probe(HD_PROBE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    probe_tuples(first, second, third, bits, count, numbers, integers, sums, counters,
                 (int)get_global_id(0), (int)get_global_size(0));
}

#elif HD_WAVEFRONT && HD_GROUP_SIZE

__kernel void hedron_trace_take(
    SCENE_PARAMETERS QUEUE_PARAMETERS HD_TRACE_TAKE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    __local uint64 room[2 * HD_GROUP_SIZE];
    __local uint place;
    trace_take_by_group(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, level, first, count, to,
                        taken_before, is_first_launch, (int)get_group_id(0), (int)get_num_groups(0),
                        (int)get_local_id(0), (int)get_local_size(0), room, &place, taken, counts);
}

__kernel void hedron_store_batch(HD_STORE_BATCH_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    store_batch(header, view, sums, sum_stride, first_item, item_count, (int)get_global_id(0),
                (int)get_global_size(0), pixels);
}

#elif HD_WAVEFRONT

KERNEL void hedron_render_by_waves(SCENE_PARAMETERS QUEUE_PARAMETERS HD_RENDER_BY_WAVES_ARGUMENTS(
    HD_PARAMETER, HD_LAST_PARAMETER)) {
    render_items_by_waves(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, end_item,
                          (int)get_global_id(0), (int)get_global_size(0), pixels, counts);
}

#else

#if !HD_GROUP_SIZE
/* The item that is number `number` of `count`. Drivers for CPUs hand each thread hundreds of items
   in a row, and neighbours cost alike: so runs of neighbours, which share what is in caches, are
   read column by column of a table, and a rest comes last. */
FN int spread_item(int number, int count) {
    enum { RUN = 8, COLUMNS = 8 };
    int rows = count / (RUN * COLUMNS), run = number / RUN;
    if (number >= rows * RUN * COLUMNS)
        return number;
    return (run % COLUMNS * rows + run / COLUMNS) * RUN + number % RUN;
}
#endif

KERNEL void hedron_render(SCENE_PARAMETERS HD_RENDER_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
#if HD_GROUP_SIZE
    __local fixed64 room[GROUP_ROOM * HD_GROUP_SIZE];
    render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, (int)get_group_id(0),
                    (int)get_num_groups(0), (int)get_local_id(0), (int)get_local_size(0), room,
                    pixels, counts);
#else
    int number = (int)get_global_id(0);
    if (number < item_count) {
        int item = first_item + spread_item(number, item_count);
        render_item(SCENE_ARGUMENTS item, pixels, counts + item);
    }
#endif
}

#endif

#if !HD_PROBE

__kernel void hedron_sum_counts(HD_SUM_COUNTS_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    if ((int)get_global_id(0) < workers)
        sum_counts(counts, count, (int)get_global_id(0), workers, sums);
}

#endif

#if HD_FIRST_HITS && !HD_PROBE

KERNEL void hedron_first_hits(SCENE_PARAMETERS HD_FIRST_HITS_ARGUMENTS(HD_PARAMETER,
                                                                       HD_LAST_PARAMETER)) {
    int step = (int)get_global_size(0);
    for (int item = (int)get_global_id(0); item < item_count; item += step)
        find_first_hits(SCENE_ARGUMENTS first_item + item, floats, hits);
}

#endif

#if HD_GROUP_SIZE && !HD_PROBE

__kernel void hedron_encode(HD_ENCODE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    encode_pixels(pixels, count, thresholds, (int)get_global_id(0), (int)get_global_size(0), image);
}

#endif
