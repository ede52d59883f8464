/* SPDX-License-Identifier: MIT */
/* Operands of the arithmetic probe's primitives and their results, as a device takes and gives them
   (HD_PROBE_ARGUMENTS in kernels/common/kernel_arguments.h). */
#ifndef HD_DEVICE_PROBE_BATCH_H
#define HD_DEVICE_PROBE_BATCH_H

#include <stdint.h>

#include "device/options.h"
#include "kernels/common/kernel_arguments.h"

#define HD_PROBE_NUMBER_NAME(name, words)  HD_PROBE_NUMBER_##name,
#define HD_PROBE_INTEGER_NAME(name, words) HD_PROBE_INTEGER_##name,
enum { HD_PROBE_NUMBERS(HD_PROBE_NUMBER_NAME) HD_PROBE_NUMBER_COUNT };
enum { HD_PROBE_INTEGERS(HD_PROBE_INTEGER_NAME) HD_PROBE_INTEGER_COUNT };
enum { HD_PROBE_BATCH = 1 << 13 /* most tuples at a time */ };

typedef struct HdProbeBatch {
    HdPrecision precision;
    int count;         /* a multiple of HD_PROBE_GRAIN */
    void *operands[3]; /* numbers of that precision, `count` each */
    int64_t *bits;
} HdProbeBatch;

typedef struct HdProbeResults {
    void *numbers;     /* HD_PROBE_NUMBER_COUNT * count */
    int64_t *integers; /* HD_PROBE_INTEGER_COUNT * count */
    int64_t sums[HD_PROBE_SUMS];
    uint32_t counters[HD_PROBE_COUNTERS];
} HdProbeResults;

#endif
