/* SPDX-License-Identifier: MIT */
/* What may be chosen about how a device renders. */
#ifndef HD_DEVICE_OPTIONS_H
#define HD_DEVICE_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "tables/table.h"

typedef enum HdMath { HD_MATH_STRICT, HD_MATH_FAST } HdMath;

/* How the tree of rays is traced: a packet follows its whole tree, or a level of many trees at a
   time. A picture and its counts do not depend on it. */
typedef enum HdPipeline {
    HD_PIPELINE_AUTO,
    HD_PIPELINE_MEGA,
    HD_PIPELINE_WAVEFRONT,
    HD_PIPELINE_WAVEFRONT_UNCOMPACTED, /* dead rays stay among the live ones; for comparison */
    HD_PIPELINE_COUNT
} HdPipeline;

enum {
    HD_MAX_THREADS = 1024,
    HD_BLOCK_STEP = 32,
    HD_MAX_BLOCK = 1024,
    HD_MAX_GRID = 1 << 20,
    HD_MIN_REGISTERS = 16,
    HD_MAX_REGISTERS = 255,
    HD_MIN_LAUNCH_MS = 1,
    HD_MAX_LAUNCH_MS = 10000
};

/* X(lanes): how many rays a packet may have; and the same in words. */
#define HD_LANE_COUNTS(X)       X(1) X(4) X(8) X(16)
#define HD_LANE_COUNTS_IN_WORDS "1, 4, 8 or 16"

typedef struct HdRenderOptions {
    int lanes;     /* one of HD_LANE_COUNTS; 0: what suits the device */
    int threads;   /* of the C backend, up to HD_MAX_THREADS; 0: one for each core */
    int block;     /* threads of a GPU's work group, a multiple of HD_BLOCK_STEP up to HD_MAX_BLOCK;
                      0: what suits the device */
    int grid;      /* work groups of one launch on a GPU, at most this; 0: what suits the device */
    int registers; /* of a thread on an NVIDIA device, at most this, HD_MIN_REGISTERS to
                      HD_MAX_REGISTERS; 0: what suits the device. No option of the command line */
    double launch_ms; /* milliseconds that OpenCL's and CUDA's launches should stay below,
                         HD_MIN_LAUNCH_MS to HD_MAX_LAUNCH_MS; 0: what suits the device */
    HdPrecision precision;
    HdMath math;
    HdPipeline pipeline;
    bool first_hits;     /* frames may be asked for what is met first (hd_renderer_first_hits). No
                            option of the command line */
    bool has_deep_trees; /* hd_scene_has_deep_trees of the scene, for a pipeline that is left open.
                            No option of the command line */
    struct {
        bool groups;        /* an OpenCL CPU is used as a GPU is: one lane, groups of threads */
        size_t queue_bytes; /* of a wavefront's queue, on CPUs of each thread's; 0: what suits the
                               device */
        int launch_work;    /* of each launch, in samples or rays; 0: by measurement */
        int ptx_arch; /* as in HdKernelShape: 61 compiles for a Pascal card on any newer one */
        bool keeps_pipeline; /* no other takes over where its kernels are wrong */
    } test;                  /* no option of the command line sets these */
} HdRenderOptions;

/* True for both kinds of wavefront. */
bool hd_pipeline_is_wavefront(HdPipeline pipeline);

/* As on the command line, by HdPipeline; NULL ends them. */
extern const char *const hd_pipeline_names[HD_PIPELINE_COUNT + 1];

/* Whether all numbers are some that a device can have. */
bool hd_render_options_are_possible(const HdRenderOptions *options);

#endif
