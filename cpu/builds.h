/* SPDX-License-Identifier: MIT */
/* Which builds of the kernels this processor can run. */
#ifndef HD_CPU_BUILDS_H
#define HD_CPU_BUILDS_H

#include "cpu/kernel.h"
#include "device/options.h"

typedef struct HdCpuBuild {
    const char *instruction_set; /* "avx512", "avx2" or "generic" */
    int lanes;
    HdPrecision precision;
    HdCpuKernel *kernel;
    HdCpuKernel *plain_kernel; /* the same for plain scenes; NULL: there is none */
    HdCpuFirstHits *first_hits;
} HdCpuBuild;

/* The best build with `lanes` lanes; 0: with as many as suit the processor. NULL: there is none,
   as for more lanes than hd_cpu_most_lanes. */
const HdCpuBuild *hd_cpu_find_build(int lanes, HdPrecision precision);

int hd_cpu_most_lanes(HdPrecision precision);

const char *hd_cpu_best_instruction_set(void);

/* The processor's name, for people. */
void hd_cpu_name(char *name, int capacity);

#endif
