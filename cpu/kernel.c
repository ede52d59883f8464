/* SPDX-License-Identifier: MIT */
/* Entry point for plain C, named by HD_KERNEL_NAME. */
#include "kernel.h"

#include "../kernels/common/wavefront.h"

#define TABLE_FROM_SCENE(type, name) const type *name = scene[HD_TABLE_##name].data;
#define TABLE_FROM_FRAME(type, name) const type *name = frame[HD_TABLE_##name].data;

HdCpuKernel HD_KERNEL_NAME;

void HD_KERNEL_NAME(const HdTable *scene, const HdTable *frame, int item, const HdCpuQueue *queue,
                    float *pixels, HdRayCounts *counts) {
    HD_SCENE_TABLES(TABLE_FROM_SCENE)
    HD_FRAME_TABLES(TABLE_FROM_FRAME)
    RayCounts counted;
    if (queue != NULL)
        render_item_by_waves(SCENE_ARGUMENTS queue->reals, queue->ints, queue->sums,
                             queue->queue_stride, queue->sum_stride, queue->compact, item, pixels,
                             &counted);
    else
        render_item(SCENE_ARGUMENTS item, pixels, &counted);
    counts[item] =
        (HdRayCounts){counted.mirrored, counted.transmitted, counted.shadow_tests, counted.clamps};
}
