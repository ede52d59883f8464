/* SPDX-License-Identifier: MIT */
/* Options of how a device renders. */
#ifndef HD_DEVICE_OPTIONS_H
#define HD_DEVICE_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "tables/table.h"

typedef enum HdMath { HD_MATH_STRICT, HD_MATH_FAST } HdMath;

/* Order of tracing: each packet traces its whole ray tree, or one ray depth of many trees at a
   time. Pictures and counts do not depend on it. */
typedef enum HdPipeline {
    HD_PIPELINE_AUTO,
    HD_PIPELINE_MEGA,
    HD_PIPELINE_WAVEFRONT,
    HD_PIPELINE_WAVEFRONT_UNCOMPACTED, /* without compaction, for comparison */
    HD_PIPELINE_COUNT
} HdPipeline;

enum {
    HD_MAX_THREADS = 1024,
    HD_BLOCK_STEP = 32,
    HD_MAX_BLOCK = 256, /* of 72 bytes a thread at most; a group has at least 32 KiB of memory */
    HD_MAX_GRID = 1 << 20,
    HD_MIN_REGISTERS = 16,
    HD_MAX_REGISTERS = 255,
    HD_MIN_LAUNCH_MS = 1,
    HD_MAX_LAUNCH_MS = 10000
};

/* X(lanes): possible rays of a packet, powers of two. */
#define HD_LANE_COUNTS(X) X(1) X(2) X(4) X(8) X(16)

typedef struct HdRenderOptions {
    int lanes;   /* one of HD_LANE_COUNTS; 0: automatic */
    int threads; /* of the C backend, up to HD_MAX_THREADS; 0: one for each core */
    int block; /* threads of a GPU's work group, a multiple of HD_BLOCK_STEP up to HD_MAX_BLOCK; 0:
                  automatic */
    int grid;  /* work groups of one launch on a GPU, at most; 0: automatic */
    int registers;    /* registers of a thread on an NVIDIA device, at most, HD_MIN_REGISTERS to
                         HD_MAX_REGISTERS; 0: automatic. No option of the command line */
    double launch_ms; /* limit of OpenCL's and CUDA's launches in ms, HD_MIN_LAUNCH_MS to
                         HD_MAX_LAUNCH_MS; 0: automatic */
    HdPrecision precision;
    HdMath math;
    HdPipeline pipeline;
    bool first_hits;     /* enables hd_renderer_first_hits. No option of the command line */
    bool has_deep_trees; /* hd_scene_has_deep_trees of the scene, for HD_PIPELINE_AUTO. No option of
                            the command line */
    struct {
        bool groups; /* use an OpenCL CPU like a GPU: one lane, thread groups */
        size_t
            queue_bytes; /* bytes of a wavefront's queue, on CPUs for each thread; 0: automatic */
        int launch_work; /* work of each launch, in samples or rays; 0: by measurement */
        int ptx_arch;    /* as in HdKernelShape: 61 compiles for a Pascal card on any newer one */
        bool keeps_pipeline; /* no fallback to another pipeline if its kernels are wrong */
    } test;                  /* none is an option of the command line */
} HdRenderOptions;

/* Returns true for both kinds of wavefront. */
bool hd_pipeline_is_wavefront(HdPipeline pipeline);

/* Names on the command line, by HdPipeline; ends with NULL. */
extern const char *const hd_pipeline_names[HD_PIPELINE_COUNT + 1];

/* Returns whether a device could have all these numbers. */
bool hd_render_options_are_possible(const HdRenderOptions *options);

#endif
