/* SPDX-License-Identifier: MIT */
/* Devices that render, behind one table of functions for each backend. */
#ifndef HD_DEVICE_RENDERER_H
#define HD_DEVICE_RENDERER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "image/frame.h"
#include "tables/tables.h"

typedef enum HdMath { HD_MATH_STRICT, HD_MATH_FAST } HdMath;

/* How the tree of rays is traced: a bundle follows its whole tree, or a level of many trees at a
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
    HD_MAX_REGISTERS = 255
};

/* Frames that were submitted and not collected yet. */
enum { HD_FRAMES_IN_FLIGHT = 2 };

/* Devices that may share a sequence. */
enum { HD_MOST_TRACERS = 64 };

/* X(lanes): how many rays a bundle may have; and the same in words. */
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
    HdPrecision precision;
    HdMath math;
    HdPipeline pipeline;
    bool has_deep_trees; /* hd_scene_has_deep_trees of the scene that is to be rendered; counts
                            where the pipeline is left open. No option of the command line */
    struct {
        bool groups;        /* an OpenCL CPU is used as a GPU is: one lane, groups of threads */
        size_t queue_bytes; /* of a wavefront's queue, on CPUs of each thread's; 0: what suits the
                               device */
        int launch_work;    /* of each launch on a GPU, in samples or rays; 0: by measurement */
    } test;                 /* no option of the command line sets these */
} HdRenderOptions;

typedef struct HdBackend HdBackend;
typedef struct HdKernelCache HdKernelCache;

typedef struct HdDevice {
    const HdBackend *backend;
    int index; /* within the backend */
    char name[256];
    char driver[256];  /* platform, driver and versions, for people */
    bool is_cpu;       /* takes several lanes */
    int compute_units; /* with clock_mhz a rough measure of speed, to choose among devices */
    int clock_mhz;
    int nvidia_arch; /* where kernels can be built with a limit of registers, which is on NVIDIA
                        devices: 61 stands for sm_61; else 0 */
    bool has_double;
    bool
        has_wide_atomics; /* adds 64-bit integers atomically, where it works in groups of threads */
    bool has_timeout;     /* its driver may end long kernels, as where it draws a display */
    char unusable[512];   /* why nothing can run there, say no compiler for it; empty: it can */
    char not_strict[256]; /* why the device cannot do strict arithmetic; empty: it can */
} HdDevice;

/* A backend. Arguments are checked before a function is called (backend.c); "must" marks what the
   callers rely on. Renderers are opaque to everybody else. Messages do not name the backend: who
   calls it adds its name. */
struct HdBackend {
    const char *name; /* as on the command line */

    /* Must fill at most `capacity` devices, numbered from 0, and their count. With none it must
       return HD_UNAVAILABLE and the reason: which library or driver is missing. */
    HdStatus (*enumerate)(HdDevice *devices, int capacity, int *count, HdError *error);

    /* Opens one device that can do what the options ask (hd_device_obstacle); their pipeline is not
       HD_PIPELINE_AUTO. Must fail with HD_UNAVAILABLE where the device or its driver cannot be used
       after all. */
    HdStatus (*open)(const HdDevice *device, const HdRenderOptions *options, void **renderer,
                     HdError *error);

    /* Copies the tables to the device and builds the kernels for them. The tables need not outlive
       the call. A later upload replaces an earlier one. */
    HdStatus (*upload)(void *renderer, const HdSceneTables *tables, HdError *error);

    /* Begins a frame of the uploaded scene; fewer than HD_FRAMES_IN_FLIGHT are under way. The
       tables live until the frame is collected or dropped. A device that works by itself should be
       given all there is to do, and not be waited for. On failure, also HD_INTERRUPTED as below,
       the tables are no longer used, and the earlier frames are still under way. */
    HdStatus (*submit)(void *renderer, const HdFrameTables *tables, const HdFrameWish *wish,
                       HdError *error);

    /* Waits for the oldest frame under way, which is so no longer in any case: fills every pixel as
       wished for at its submission, is_encoded, the counts and trace_seconds of `frame`.
       HD_INTERRUPTED where a signal came first (interrupt.h): then `frame` is worth nothing. */
    HdStatus (*collect)(void *renderer, HdFrame *frame, HdError *error);

    /* The seconds of the longest launch of the frame collected last; negative: not known. NULL
       instead of a function where the device drives no display. */
    double (*longest_launch)(const void *renderer);

    /* Waits until the device is done with all frames under way, and forgets them. */
    void (*drop)(void *renderer);

    /* What the last upload did to have its kernels (kernel_cache.h). NULL instead of a function
       where they are compiled ahead. */
    HdKernelCache *(*kernels)(void *renderer);

    /* What the last upload compiled computes wrongly: the next uploads must compile with little
       optimisation (HdKernelShape). False where they do so already. NULL instead of a function as
       above. */
    bool (*be_cautious)(void *renderer);

    /* The lanes of the kernels' bundles. NULL instead of a function: one. */
    int (*lanes)(const void *renderer);

    /* One line for people about what was chosen (lanes, threads, instruction set, registers). */
    void (*describe)(const void *renderer, char *text, int capacity);

    /* No frame is under way. */
    void (*close)(void *renderer);
};

enum { HD_BACKEND_COUNT = 3, HD_MAX_DEVICES = 64 };

/* All backends, the best first: cuda, opencl, c. The last one is always there. */
extern const HdBackend hd_backend_cuda, hd_backend_opencl, hd_backend_c;
extern const HdBackend *const hd_backends[HD_BACKEND_COUNT];

/* NULL where no backend has that name. */
const HdBackend *hd_backend_find(const char *name);

/* HD_BAD_INPUT where a number of the options is none that any device can have. */
HdStatus hd_render_options_check(const HdRenderOptions *options, HdError *error);

/* Why the device cannot do what the options ask (strict arithmetic, double precision, several
   lanes, a wavefront), in words; NULL: it can. The words live as long as the device. */
const char *hd_device_obstacle(const HdDevice *device, const HdRenderOptions *options);

/* An open device. Messages of the functions below begin with the backend's name where the backend
   failed: "cuda: ...". */
typedef struct HdRenderer HdRenderer;

/* HD_UNAVAILABLE where the device has an obstacle. */
HdStatus hd_renderer_open(HdRenderer **renderer, const HdDevice *device,
                          const HdRenderOptions *options, HdError *error);

/* Kernels that were compiled anew for the scene must first pass the self-test (self_test.h), with
   strict arithmetic: HD_UNAVAILABLE where they do not. Those that do are kept on disk. */
HdStatus hd_renderer_upload(HdRenderer *renderer, const HdSceneTables *tables, HdError *error);

/* Begins a frame, so that the device works on it while the caller does other things; at most
   HD_FRAMES_IN_FLIGHT are under way. The tables must live until the frame is collected or dropped;
   on failure they need not, and the earlier frames are still under way. */
HdStatus hd_renderer_submit(HdRenderer *renderer, const HdFrameTables *tables,
                            const HdFrameWish *wish, HdError *error);

/* Waits for the oldest frame under way; whatever comes of it, it is so no longer. `frame` must have
   its size, and `rgba` unless radiance was wished for. HD_INTERRUPTED where a signal came first
   (interrupt.h). */
HdStatus hd_renderer_collect(HdRenderer *renderer, HdFrame *frame, HdError *error);

/* Whether the backend failed in any of the functions above: that another device may do better,
   while other errors are due to what was asked for. */
bool hd_renderer_has_failed(const HdRenderer *renderer);

/* The seconds of the longest launch of the frames that were collected since the last call, or since
   the renderer was opened. Negative: not known, or nothing that would hold a display up. */
double hd_renderer_take_longest_launch(HdRenderer *renderer);

/* Waits until the device is done with the frames under way, and forgets them. */
void hd_renderer_drop(HdRenderer *renderer);

/* Submits a frame and collects its radiance. No other may be under way. */
HdStatus hd_renderer_render(HdRenderer *renderer, const HdFrameTables *tables, HdFrame *frame,
                            HdError *error);

/* The same with a backend's own renderer, whose arguments were checked. */
HdStatus hd_backend_render(const HdBackend *backend, void *renderer, const HdFrameTables *tables,
                           HdFrame *frame, HdError *error);

/* Lives as long as the renderer. */
const HdDevice *hd_renderer_device(const HdRenderer *renderer);

/* How many lanes the renderer's kernels have: what scenes are compiled for. */
int hd_renderer_lanes(const HdRenderer *renderer);

void hd_renderer_describe(const HdRenderer *renderer, char *text, int capacity);

/* Where the kernels came from and what became of them, for people; "" where nobody compiles. */
const char *hd_renderer_kernels_note(const HdRenderer *renderer);

/* Drops what is under way. NULL is allowed. */
void hd_renderer_close(HdRenderer *renderer);

#endif
