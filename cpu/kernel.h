/* SPDX-License-Identifier: MIT */
/* The shared kernels built for plain C: cmake/cpu_kernels.cmake compiles cpu/kernel.c for each
   instruction set, lane count and precision that it lists, and some once more for plain scenes:
   those without meshes, refraction and light from behind. */
#ifndef HD_CPU_KERNEL_H
#define HD_CPU_KERNEL_H

#include <stdint.h>

#include "tables/table.h"

/* The queue that a thread works off its rays with (kernels/common/wavefront.h). */
typedef struct HdCpuQueue {
    void *reals; /* of the kernel's precision */
    int *ints;
    int64_t *sums;
    int queue_stride, sum_stride;
    int compact;
} HdCpuQueue;

/* Renders one work item: its pixels, and number `item` of `counts`, which are HdRayCounts. Without
   a queue (NULL) a packet follows its whole tree of rays, with one the tree is traced level by
   level. */
typedef void HdCpuKernel(const HdTable *scene, const HdTable *frame, int item,
                         const HdCpuQueue *queue, float *pixels, void *counts);

/* Finds what is met first in the pixels of an item, `floats` numbers of each (HdFrame.first). */
typedef void HdCpuFirstHits(const HdTable *scene, const HdTable *frame, int item, int floats,
                            float *hits);

/* The best instruction set of which this processor can run builds: "avx512", "avx2" or "generic".
 */
const char *hd_cpu_best_instruction_set(void);

#endif
