/* SPDX-License-Identifier: MIT */
/* Entry points for CUDA. Arguments: the tables in the order of scene_tables.h, then as listed. */
#include "../common/render.h"

extern "C" __global__ void hedron_render(SCENE_PARAMETERS int first_item, int item_count, int parts,
                                         float *__restrict__ pixels,
                                         RayCounts *__restrict__ counts) {
    __shared__ Gathered group[HD_GROUP_SIZE];
    render_by_group(SCENE_ARGUMENTS first_item, item_count, parts, (int)blockIdx.x,
                    (int)threadIdx.x, (int)blockDim.x, group, pixels, counts);
}

extern "C" __global__ void hedron_sum_counts(const RayCounts *__restrict__ counts, int count,
                                             RayCounts *__restrict__ sums) {
    int worker = (int)(blockIdx.x * blockDim.x + threadIdx.x);
    sum_counts(counts, count, worker, (int)(gridDim.x * blockDim.x), sums);
}
