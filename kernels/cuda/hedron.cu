/* SPDX-License-Identifier: MIT */
/* Entry points for CUDA; their parameters are those of kernel_arguments.h, by the names there. */
#include "dialect.h"

/* The text has each file once, where it is asked for first: what either part needs comes before. */
#include "../common/dialect.h"
#include "../common/scene_arguments.h"
#if HD_PROBE
#include "../common/probe.h"
#else
#include "../common/encode.h"
#include "../common/render.h"
#if HD_WAVEFRONT
#include "../common/wavefront.h"
#endif
#endif

#define KERNEL extern "C" __global__ void

#if HD_PROBE

KERNEL hedron_probe(HD_PROBE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    probe_tuples(first, second, third, bits, count, numbers, integers, sums, counters,
                 (int)(blockIdx.x * blockDim.x + threadIdx.x), (int)(gridDim.x * blockDim.x));
}

#elif HD_WAVEFRONT

KERNEL hedron_trace_take(
    SCENE_PARAMETERS QUEUE_PARAMETERS HD_TRACE_TAKE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    __shared__ uint64 room[2 * HD_GROUP_SIZE];
    __shared__ uint place;
    trace_take_by_group(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, level, first, count, to,
                        taken_before, is_first_launch, (int)blockIdx.x, (int)gridDim.x,
                        (int)threadIdx.x, (int)blockDim.x, room, &place, taken, counts);
}

KERNEL hedron_store_batch(HD_STORE_BATCH_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    store_batch(header, view, sums, sum_stride, first_item, item_count, worker,
                (int)(gridDim.x * blockDim.x), pixels);
}

#else

KERNEL hedron_render(SCENE_PARAMETERS HD_RENDER_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    __shared__ fixed64 room[GROUP_ROOM * HD_GROUP_SIZE];
    render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, (int)blockIdx.x, (int)gridDim.x,
                    (int)threadIdx.x, (int)blockDim.x, room, pixels, counts);
}

#endif

#if !HD_PROBE

KERNEL hedron_sum_counts(HD_SUM_COUNTS_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (worker < workers)
        sum_counts(counts, count, worker, workers, sums);
}

KERNEL hedron_encode(HD_ENCODE_ARGUMENTS(HD_PARAMETER, HD_LAST_PARAMETER)) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    encode_pixels(pixels, count, thresholds, worker, (int)(gridDim.x * blockDim.x), image);
}

#endif
