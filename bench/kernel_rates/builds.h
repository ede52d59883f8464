/* SPDX-License-Identifier: MIT */
/* The builds of a tool's kernels, which bench/CMakeLists.txt names in HD_BUILDS. Whoever includes
   this says before what they are: HD_BUILD_TYPE has an instruction_set and lanes. */
#ifndef HD_BENCH_BUILDS_H
#define HD_BENCH_BUILDS_H

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/instruction_set.h"

#define X(build) extern const HD_BUILD_TYPE build;
HD_BUILDS
#undef X

/* The one for this processor, with the lanes that it takes by itself or with one; where there is
   none, the program ends with a sentence. */
static inline const HD_BUILD_TYPE *find_build(bool one_lane) {
    static const HD_BUILD_TYPE *const builds[] = {
#define X(build) &build,
        HD_BUILDS
#undef X
    };
    const char *best = hd_cpu_best_instruction_set();
    if (one_lane && strcmp(best, "avx512") == 0)
        best = "avx2";
    for (size_t i = 0; i < sizeof builds / sizeof *builds; i++)
        if (strcmp(builds[i]->instruction_set, best) == 0 && (!one_lane || builds[i]->lanes == 1))
            return builds[i];
    fprintf(stderr, "the kernels were built for another processor than one with %s\n", best);
    exit(1);
}

#endif
