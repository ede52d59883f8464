/* SPDX-License-Identifier: MIT */
/* Entry points for CUDA; their parameters are those of kernel_arguments.h, by the names there. */
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

#define KERNEL extern "C" __global__ void

/* Where all of a scene's small tables fit, kernels read them from constant memory, and their
   parameters of the same names, which hold its addresses, are hidden. */
#if HD_SMALL_TABLES
#define SMALL_TABLES(X) HD_SMALL_SCENE_TABLES(X) HD_SMALL_FRAME_TABLES(X)
#else
#define SMALL_TABLES(X)
#endif
#define DEFINE_CONSTANT(type, name, rows)                                                          \
    extern "C" {                                                                                   \
    __constant__ type hedron_constant_##name[rows];                                                \
    }
#define USE_CONSTANT(type, name, rows) const type *const name = hedron_constant_##name;

#if HD_PROBE

KERNEL hedron_probe(HD_PROBE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    probe_tuples(first, second, third, bits, count, numbers, integers, sums, counters,
                 (int)(blockIdx.x * blockDim.x + threadIdx.x), (int)(gridDim.x * blockDim.x));
}

#else

SMALL_TABLES(DEFINE_CONSTANT)

#if HD_WAVEFRONT

KERNEL hedron_trace_take(
    SCENE_PARAMETERS QUEUE_PARAMETERS HD_TRACE_TAKE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    __shared__ uint64 room[2 * HD_GROUP_SIZE];
    __shared__ uint place;
    {
        SMALL_TABLES(USE_CONSTANT)
        trace_take_by_group(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, level, first, count, to,
                            taken_before, is_first_launch, (int)blockIdx.x, (int)gridDim.x,
                            (int)threadIdx.x, (int)blockDim.x, room, &place, taken, counts);
    }
}

KERNEL hedron_store_batch(HD_STORE_BATCH_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    store_batch(header, view, sums, sum_stride, first_item, item_count, worker,
                (int)(gridDim.x * blockDim.x), pixels);
}

#else

KERNEL hedron_render(SCENE_PARAMETERS HD_RENDER_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    __shared__ fixed64 room[GROUP_ROOM * HD_GROUP_SIZE];
    {
        SMALL_TABLES(USE_CONSTANT)
        render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, (int)blockIdx.x,
                        (int)gridDim.x, (int)threadIdx.x, (int)blockDim.x, room, pixels, counts);
    }
}

#endif

KERNEL hedron_sum_counts(HD_SUM_COUNTS_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (worker < workers)
        sum_counts(counts, count, worker, workers, sums);
}

#if HD_FIRST_HITS

KERNEL hedron_first_hits(SCENE_PARAMETERS HD_FIRST_HITS_ARGUMENTS(HD_PARAMETER,
                                                                  HD_LAST_PARAMETER)) {
    int step = (int)(gridDim.x * blockDim.x);
    for (int item = (int)(blockIdx.x * blockDim.x + threadIdx.x); item < item_count; item += step) {
        SMALL_TABLES(USE_CONSTANT)
        find_first_hits(SCENE_ARGUMENTS first_item + item, floats, hits);
    }
}

#endif

KERNEL hedron_encode(HD_ENCODE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    encode_pixels(pixels, count, thresholds, worker, (int)(gridDim.x * blockDim.x), image);
}

#endif
