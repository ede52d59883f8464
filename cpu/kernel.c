/* SPDX-License-Identifier: MIT */
/* Entry point for plain C, named by HD_KERNEL_NAME. */
#include "kernel.h"

#include "../kernels/common/render.h"

#define TABLE_FROM_SCENE(type, name) const type *name = scene[HD_TABLE_##name].data;
#define TABLE_FROM_FRAME(type, name) const type *name = frame[HD_TABLE_##name].data;

HdCpuKernel HD_KERNEL_NAME;

void HD_KERNEL_NAME(const HdTable *scene, const HdTable *frame, int item, float *pixels,
                    HdRayCounts *counts) {
    HD_SCENE_TABLES(TABLE_FROM_SCENE)
    HD_FRAME_TABLES(TABLE_FROM_FRAME)
    RayCounts counted;
    render_item(SCENE_ARGUMENTS item, pixels, &counted);
    counts[item] =
        (HdRayCounts){counted.mirrored, counted.transmitted, counted.shadow_tests, counted.clamps};
}
