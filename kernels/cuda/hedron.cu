/* SPDX-License-Identifier: MIT */
/* Entry points for CUDA. Arguments: the tables in the order of scene_tables.h, then as listed. */
#include "../common/encode.h"
#include "../common/render.h"
#if HD_WAVEFRONT
#include "../common/wavefront.h"
#endif

#if HD_WAVEFRONT

extern "C" __global__ void hedron_trace_take(SCENE_PARAMETERS QUEUE_PARAMETERS int first_item,
                                             int level, int first, int count, int to,
                                             uint taken_before, int is_first_launch,
                                             uint *__restrict__ taken,
                                             RayCounts *__restrict__ counts) {
    __shared__ uint64 room[2 * HD_GROUP_SIZE];
    __shared__ uint place;
    trace_take_by_group(SCENE_ARGUMENTS QUEUE_ARGUMENTS first_item, level, first, count, to,
                        taken_before, is_first_launch, (int)blockIdx.x, (int)gridDim.x,
                        (int)threadIdx.x, (int)blockDim.x, room, &place, taken, counts);
}

extern "C" __global__ void hedron_store_batch(const Header *__restrict__ header,
                                              const View *__restrict__ view,
                                              const fixed64 *__restrict__ sums, int sum_stride,
                                              int first_item, int item_count,
                                              float *__restrict__ pixels) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    store_batch(header, view, sums, sum_stride, first_item, item_count, worker,
                (int)(gridDim.x * blockDim.x), pixels);
}

#else

extern "C" __global__ void hedron_render(SCENE_PARAMETERS int first_item, int item_count, int parts,
                                         float *__restrict__ pixels,
                                         RayCounts *__restrict__ counts) {
    __shared__ fixed64 room[GROUP_ROOM * HD_GROUP_SIZE];
    render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, (int)blockIdx.x, (int)gridDim.x,
                    (int)threadIdx.x, (int)blockDim.x, room, pixels, counts);
}

#endif

extern "C" __global__ void hedron_sum_counts(const RayCounts *__restrict__ counts, int count,
                                             RayCounts *__restrict__ sums, int workers) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    if (worker < workers)
        sum_counts(counts, count, worker, workers, sums);
}

extern "C" __global__ void hedron_encode(const int *__restrict__ pixels, int count,
                                         const int *__restrict__ thresholds,
                                         uint *__restrict__ image) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    encode_pixels(pixels, count, thresholds, worker, (int)(gridDim.x * blockDim.x), image);
}
