/* SPDX-License-Identifier: MIT */
/* Entry points for plain C, named by HD_KERNEL_NAME. With HD_PLAIN they render only plain scenes:
   code for others takes registers even if it never runs. */
#include "cpu/kernel.h"

#include "cpu/dialect.h"
#include "kernels/common/wavefront.h"

HdCpuKernel HD_KERNEL_NAME;

/* Separate functions, as compilers make slower code of a joint one. */
FN_NOINLINE RayCounts render_by_trees(const HdTable *scene, const HdTable *frame, int item,
                                      float *pixels) {
    HD_DECLARE_TABLES(scene, frame)
    RayCounts counted;
    render_item(SCENE_ARGUMENTS item, pixels, &counted);
    return counted;
}

FN_NOINLINE RayCounts render_by_waves(const HdTable *scene, const HdTable *frame, int item,
                                      const HdCpuQueue *queue, float *pixels) {
    HD_DECLARE_TABLES(scene, frame)
    RayCounts counted;
    render_item_by_waves(SCENE_ARGUMENTS queue->reals, queue->ints, queue->sums,
                         queue->queue_stride, queue->sum_stride, queue->compact, item, pixels,
                         &counted);
    return counted;
}

void HD_KERNEL_NAME(const HdTable *scene, const HdTable *frame, int item, const HdCpuQueue *queue,
                    float *pixels, void *counts) {
    ((RayCounts *)counts)[item] = queue == NULL
                                      ? render_by_trees(scene, frame, item, pixels)
                                      : render_by_waves(scene, frame, item, queue, pixels);
}

#if !HD_PLAIN
HdCpuFirstHits HD_PASTE(HD_KERNEL_NAME, _first_hits);

void HD_PASTE(HD_KERNEL_NAME, _first_hits)(const HdTable *scene, const HdTable *frame, int item,
                                           int floats, float *hits) {
    HD_DECLARE_TABLES(scene, frame)
    find_first_hits(SCENE_ARGUMENTS item, floats, hits);
}

#endif
