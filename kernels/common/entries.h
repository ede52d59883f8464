/* SPDX-License-Identifier: MIT */
/* Entry points for devices, with the parameters of kernel_arguments.h. A language defines KERNEL,
   which begins each, SHARED for memory of a group, and the numbers of a thread (WORKER of WORKERS),
   of its group (GROUP of GROUPS) and within that (THREAD of THREADS). SMALL_TABLES lists the tables
   that DEFINE_CONSTANT and USE_CONSTANT put into constant memory. Without a group size each work
   item renders by itself, which suits CPUs. */
#ifndef HD_ENTRIES_H
#define HD_ENTRIES_H

/* The assembled source holds each file once, at its first include: files that both parts need come
   first. */
#include "division.h"
#include "kernel_arguments.h"
#include "scene_tables.h"
#if HD_PROBE
#include "probe.h"
#else
#include "render.h"
#if HD_WAVEFRONT
#include "wavefront.h"
#endif
#endif

#if HD_PROBE

KERNEL hedron_probe(HD_PROBE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    probe_tuples(first, second, third, bits, count, numbers, integers, sums, counters, WORKER,
                 WORKERS);
}

#else

SMALL_TABLES(DEFINE_CONSTANT)

#if HD_WAVEFRONT && HD_GROUP_SIZE

KERNEL hedron_trace_chunk(
    SCENE_PARAMETERS QUEUE_PARAMETERS HD_TRACE_CHUNK_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    SHARED uint64 scratch[2 * HD_GROUP_SIZE];
    SHARED uint place;
    {
        SMALL_TABLES(USE_CONSTANT)
        trace_chunk_by_group(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, level, first, count, to,
                             taken_before, is_first_launch, GROUP, GROUPS, THREAD, THREADS, scratch,
                             &place, taken, counts);
    }
}

KERNEL hedron_store_batch(HD_STORE_BATCH_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    store_batch(header, view, sums, sum_stride, first_item, item_count, WORKER, WORKERS, pixels);
}

#elif HD_WAVEFRONT

KERNEL hedron_render_by_waves(SCENE_PARAMETERS QUEUE_PARAMETERS
                                  HD_RENDER_BY_WAVES_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    render_items_by_waves(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, end_item, WORKER, WORKERS,
                          pixels, counts);
}

#elif HD_GROUP_SIZE

KERNEL hedron_render(SCENE_PARAMETERS HD_RENDER_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    SHARED fixed64 scratch[GROUP_STRIDE * HD_GROUP_SIZE];
    {
        SMALL_TABLES(USE_CONSTANT)
        render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, GROUP, GROUPS, THREAD,
                        THREADS, scratch, pixels, counts);
    }
}

#else

/* Maps `number` of `count` to an item. CPU drivers give each thread hundreds of items in a row, and
   neighbours cost alike: so runs of neighbours, which share caches, are read by columns of a table;
   a rest comes last. */
FN int spread_item(int number, int count) {
    enum { RUN = 8, COLUMNS = 8 };
    int rows = count / (RUN * COLUMNS), run = number / RUN;
    if (number >= rows * RUN * COLUMNS)
        return number;
    return (run % COLUMNS * rows + run / COLUMNS) * RUN + number % RUN;
}

KERNEL hedron_render(SCENE_PARAMETERS HD_RENDER_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    if (WORKER < item_count) {
        int item = first_item + spread_item(WORKER, item_count);
        render_item(SCENE_ARGUMENTS item, pixels, counts + item);
    }
}

#endif

KERNEL hedron_sum_counts(HD_SUM_COUNTS_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    if (WORKER < workers)
        sum_counts(counts, count, WORKER, workers, sums);
}

#if HD_FIRST_HITS

KERNEL hedron_first_hits(SCENE_PARAMETERS HD_FIRST_HITS_ARGUMENTS(HD_PARAMETER,
                                                                  HD_LAST_PARAMETER)) {
    int step = WORKERS;
    for (int item = WORKER; item < item_count; item += step) {
        SMALL_TABLES(USE_CONSTANT)
        find_first_hits(SCENE_ARGUMENTS first_item + item, floats, hits);
    }
}

#endif

#if HD_GROUP_SIZE

KERNEL hedron_encode(HD_ENCODE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    encode_pixels(pixels, count, thresholds, WORKER, WORKERS, image);
}

#endif

#endif

#endif
