/* SPDX-License-Identifier: MIT */
/* Counting the instructions that a function executes, one by one. */
#ifndef HD_BENCH_STEPS_H
#define HD_BENCH_STEPS_H

#include <stdbool.h>
#include <stdint.h>

/* How often the instruction at each offset from a function's first one was executed. */
typedef struct HdSteps {
    uint32_t *times; /* owned */
    long size;       /* offsets from 0 to size - 1 are watched */
} HdSteps;

/* Runs work(context) in a child process, instruction by instruction, and counts those from `start`
   on. False where the system does not allow it. Free `steps->times` either way. */
bool hd_count_steps(HdSteps *steps, uintptr_t start, void (*work)(void *), void *context);

#endif
