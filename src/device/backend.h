/* SPDX-License-Identifier: MIT */
/* Devices that render, behind one table of functions for each backend. */
#ifndef HD_DEVICE_BACKEND_H
#define HD_DEVICE_BACKEND_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "device/options.h"
#include "image/frame.h"
#include "kernels/common/kernel_arguments.h"
#include "tables/table.h"

/* Maximum number of frames in flight: submitted, not yet collected. */
enum { HD_FRAMES_IN_FLIGHT = 2 };

/* Devices that may share a sequence, at most. */
enum { HD_MAX_WORKERS = 64 };

typedef struct HdBackend HdBackend;
typedef struct HdKernelCache HdKernelCache;

typedef struct HdDevice {
    const HdBackend *backend;
    int index; /* number within the backend */
    char name[256];
    char driver[256];  /* platform, driver and versions, for people */
    bool is_cpu;       /* a CPU, which may have several lanes */
    int lanes[2];      /* of a CPU, by HdPrecision: the sum of the counts it offers; 0: any */
    int compute_units; /* with clock_mhz a rough measure of speed, to choose among devices */
    int clock_mhz;
    int nvidia_arch; /* 61 for sm_61, whose kernels can have a register limit; 0: not NVIDIA */
    bool has_double;
    bool has_wide_atomics; /* its groups of threads, if any, add 64-bit integers atomically */
    bool has_timeout; /* its driver may end long kernels, for example because it drives a display */
    char unusable[1024];  /* reason why no kernel can run, such as no compiler; or empty */
    bool is_measured;     /* its arithmetic is known: plain C's, or remembered (kernel_cache.h) */
    char not_strict[640]; /* reason why a measured device is not strict; or empty */
} HdDevice;

/* ---- the arithmetic probe: operands of its primitives and their results, in the layout of
   HD_PROBE_ARGUMENTS (kernels/common/kernel_arguments.h) ---- */

#define HD_PROBE_NUMBER_NAME(name, words)  HD_PROBE_NUMBER_##name,
#define HD_PROBE_INTEGER_NAME(name, words) HD_PROBE_INTEGER_##name,
enum { HD_PROBE_NUMBERS(HD_PROBE_NUMBER_NAME) HD_PROBE_NUMBER_COUNT };
enum { HD_PROBE_INTEGERS(HD_PROBE_INTEGER_NAME) HD_PROBE_INTEGER_COUNT };
enum { HD_PROBE_BATCH = 1 << 13 /* tuples of a batch, at most */ };

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

/* ---- backends ---- */

/* Functions of a backend's renderers, which are opaque to callers. "Must" states what callers rely
   on. Messages do not name the backend: the caller adds its name. */
typedef struct HdRendererFunctions {
    /* Opens a device that supports the options (hd_device_unsupported_reason), with a pipeline
       other than HD_PIPELINE_AUTO. Must fail with HD_UNAVAILABLE if the device is unusable. */
    HdStatus (*open)(const HdDevice *device, const HdRenderOptions *options, void **renderer,
                     HdError *error);

    /* Copies the tables to the device, replacing earlier ones, and builds the kernels for them. The
       tables need not outlive the call. */
    HdStatus (*upload)(void *renderer, const HdSceneTables *tables, HdError *error);

    /* Begins a frame of the uploaded scene without waiting; may defer the work to `collect`. Fewer
       than HD_FRAMES_IN_FLIGHT are in flight. The tables live until the frame is collected or
       dropped. After a failure, also HD_INTERRUPTED, the tables are unused and earlier frames stay
       in flight. */
    HdStatus (*submit)(void *renderer, const HdFrameTables *tables, const HdFrameRequest *request,
                       HdError *error);

    /* Blocks on the oldest frame in flight, that of `tables`, and retires it, even on failure.
       Fills every pixel as requested at submission, is_encoded, the counts, trace_seconds and
       longest_launch of `frame`. HD_INTERRUPTED after a signal (interrupt.h): `frame` is undefined.
       Reports progress to `tables->watched`, which may cancel. */
    HdStatus (*collect)(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                        HdError *error);

    /* Fills the frame's `first` with the first hits of the frame of `tables`, in flight or not, and
       waits. The renderer was opened with `first_hits`. HD_INTERRUPTED as above. */
    HdStatus (*first_hits)(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                           HdError *error);

    /* Waits until the device has finished all frames in flight, and discards them. */
    void (*drop)(void *renderer);

    /* Returns the kernels that uploads compile (kernel_cache.h). The member and the next one are
       NULL if the kernels are compiled ahead. */
    HdKernelCache *(*kernels)(void *renderer);

    /* Computes a batch of the arithmetic probe with kernels of the same shape. A scene must be
       uploaded again afterwards. */
    HdStatus (*probe)(void *renderer, const HdProbeBatch *batch, HdProbeResults *results,
                      HdError *error);

    /* Returns the lanes of the kernels' packets. */
    int (*lanes)(const void *renderer);

    /* Writes one line for people: lanes, threads, instruction set, registers. */
    void (*describe)(const void *renderer, char *text, int capacity);

    /* Closes the renderer. No frame may be in flight. */
    void (*close)(void *renderer);
} HdRendererFunctions;

struct HdBackend {
    const char *name;       /* name on the command line */
    bool needs_no_driver;   /* available on every machine, and starts at once */
    bool uses_host_threads; /* uses the program's own threads (HdRenderOptions) */
    const HdRendererFunctions *functions;
    const void *driver; /* driver's table, for backends that share functions */

    /* Must fill at most `capacity` devices, numbered from 0, without their backend, and their
       count. With no device it must fail: with HD_UNAVAILABLE if a library or driver is missing,
       with HD_FAILED if one does not start. */
    HdStatus (*enumerate)(HdDevice *devices, int capacity, int *count, HdError *error);
};

enum { HD_MAX_DEVICES = 64 }; /* devices of a backend, at most */

/* Lists the backend's devices; fills in their backend and their remembered arithmetic. */
HdStatus hd_backend_enumerate(const HdBackend *backend, HdDevice *devices, int capacity, int *count,
                              HdError *error);

/* ---- the choice for a device ---- */

/* Returns the reason why the device does not support the options (strict arithmetic, double
   precision, several lanes, a wavefront); NULL if it does. The text lives as long as the device. */
const char *hd_device_unsupported_reason(const HdDevice *device, const HdRenderOptions *options);

/* Returns the pipeline of `options`, resolving HD_PIPELINE_AUTO. That is the wavefront on a CPU if
   shading dominates (docs/performance.md), and on a GPU with 64-bit atomics if deep trees need
   short launches (docs/development/backends.md, Pipelines); otherwise the megakernel. `scene` may
   be NULL: unknown. */
HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options,
                              const HdScene *scene);

/* Returns the limit of a launch on a GPU in seconds. */
double hd_longest_launch(const HdDevice *device, const HdRenderOptions *options);

/* Returns whether the megakernel could block the device, which may drive a display, for too long:
   it traces a whole ray tree in one launch, which cannot be cut. */
bool hd_megakernel_is_too_long(const HdDevice *device, const HdRenderOptions *options);

/* ---- lost devices ---- */

/* Fails with HD_UNAVAILABLE: `what` failed because the device is lost. The message adds advice. */
HdStatus hd_fail_lost(HdError *error, const char *what);

/* Returns whether the error is that of hd_fail_lost. It is temporary: the device may return. */
bool hd_is_loss(const HdError *error);

#endif
