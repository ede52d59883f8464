/* SPDX-License-Identifier: MIT */
/* The shared kernels built for plain C: cmake/cpu_kernels.cmake compiles cpu/kernel.c for each
   instruction set, lane count and precision in its list. It compiles some again for plain scenes,
   which have no meshes, refraction or light from behind. */
#ifndef HD_CPU_KERNEL_H
#define HD_CPU_KERNEL_H

#include <stdint.h>

#include "tables/table.h"

/* A thread's queue of rays (kernels/common/wavefront.h). */
typedef struct HdCpuQueue {
    void *reals; /* of the kernel's precision */
    int *ints;
    int64_t *sums;
    int queue_stride, sum_stride;
    int compact;
} HdCpuQueue;

/* Renders the pixels of one work item and sets counts[item], an HdRayCounts. Without a queue (NULL)
   each packet traces its whole ray tree; with one, the kernel traces one ray depth at a time. */
typedef void HdCpuKernel(const HdTable *scene, const HdTable *frame, int item,
                         const HdCpuQueue *queue, float *pixels, void *counts);

/* Stores the first hits of an item's pixels, `floats` numbers for each (HdFrame.first). */
typedef void HdCpuFirstHits(const HdTable *scene, const HdTable *frame, int item, int floats,
                            float *hits);

/* Returns the best instruction set with a build for this processor: "avx512", "avx2",
   "neon" or "generic". */
const char *hd_cpu_best_instruction_set(void);

#endif
