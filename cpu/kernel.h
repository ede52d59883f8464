/* SPDX-License-Identifier: MIT */
/* The builds of the shared kernels for plain C: one for each instruction set, lane count, precision
   and arithmetic. cmake/cpu_kernels.cmake compiles cpu/kernel.c once for each of them. */
#ifndef HD_CPU_KERNEL_H
#define HD_CPU_KERNEL_H

#include "image/frame.h"
#include "tables/table.h"

/* The queue that a thread works off its rays with (kernels/common/wavefront.h). */
typedef struct HdCpuQueue {
    void *reals; /* of the kernel's precision */
    int *ints;
    int64_t *sums;
    int queue_stride, sum_stride;
    int compact;
} HdCpuQueue;

/* Renders one work item: its pixels, and counts[item]. Without a queue (NULL) a bundle follows its
   whole tree of rays, with one the tree is traced level by level. */
typedef void HdCpuKernel(const HdTable *scene, const HdTable *frame, int item,
                         const HdCpuQueue *queue, float *pixels, HdRayCounts *counts);

/* X(instruction set, lanes), from the most to the least capable. HD_CPU_FEW leaves out the bundles
   that processors with more instructions do not take. */
#define HD_CPU_WIDE_GENERIC_BUILDS(X)                                                              \
    X(generic, 16)                                                                                 \
    X(generic, 8)                                                                                  \
    X(generic, 4)
#define HD_CPU_X86_BUILDS(X)                                                                       \
    X(avx512, 16)                                                                                  \
    X(avx512, 8)                                                                                   \
    X(avx2, 8)                                                                                     \
    X(avx2, 4)                                                                                     \
    X(avx2, 1)
#ifndef HD_CPU_X86
#define HD_CPU_BUILDS(X) HD_CPU_WIDE_GENERIC_BUILDS(X) X(generic, 1)
#elif defined(HD_CPU_FEW)
#define HD_CPU_BUILDS(X) HD_CPU_X86_BUILDS(X) X(generic, 1)
#else
#define HD_CPU_BUILDS(X) HD_CPU_X86_BUILDS(X) HD_CPU_WIDE_GENERIC_BUILDS(X) X(generic, 1)
#endif

#endif
