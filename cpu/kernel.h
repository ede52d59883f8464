/* SPDX-License-Identifier: MIT */
/* The builds of the shared kernels for plain C: one for each instruction set, lane count, precision
   and arithmetic. cmake/cpu_kernels.cmake compiles cpu/kernel.c once for each of them. */
#ifndef HD_CPU_KERNEL_H
#define HD_CPU_KERNEL_H

#include "../src/compiled_scene.h"
#include "../src/frame.h"

/* Renders one work item: its pixels, and counts[item]. */
typedef void HdCpuKernel(const HdTable *scene, const HdTable *frame, int item, float *pixels,
                         HdRayCounts *counts);

/* X(instruction set, lanes), from the most to the least capable. */
#ifdef HD_CPU_X86
#define HD_CPU_BUILDS(X)                                                                           \
    X(avx512, 16)                                                                                  \
    X(avx512, 8)                                                                                   \
    X(avx2, 8)                                                                                     \
    X(avx2, 4)                                                                                     \
    X(avx2, 1)                                                                                     \
    X(generic, 16)                                                                                 \
    X(generic, 8)                                                                                  \
    X(generic, 4)                                                                                  \
    X(generic, 1)
#else
#define HD_CPU_BUILDS(X)                                                                           \
    X(generic, 16)                                                                                 \
    X(generic, 8)                                                                                  \
    X(generic, 4)                                                                                  \
    X(generic, 1)
#endif

#endif
