/* SPDX-License-Identifier: MIT */
/* What is measured against what the program does by itself. */
#ifndef HD_BENCH_GPU_SWITCHES_H
#define HD_BENCH_GPU_SWITCHES_H

#include <stdbool.h>
#include <stddef.h>

#include "device/options.h"

typedef struct Switch {
    const char *name;
    HdPipeline pipeline;
    int registers, block; /* 0: what suits */
    size_t queue_bytes;   /* of the wavefront; 0: what suits */
    bool is_surveyed;     /* for surveyed scenes only */
    bool is_cuda;         /* for CUDA only */
} Switch;

extern const Switch switches[];
extern const int switch_count;

#endif
