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

/* Frames that were submitted and not collected yet. */
enum { HD_FRAMES_IN_FLIGHT = 2 };

/* Devices that may share a sequence. */
enum { HD_MAX_WORKERS = 64 };

typedef struct HdBackend HdBackend;
typedef struct HdKernelCache HdKernelCache;

typedef struct HdDevice {
    const HdBackend *backend;
    int index; /* within the backend */
    char name[256];
    char driver[256];  /* platform, driver and versions, for people */
    bool is_cpu;       /* takes several lanes */
    int max_lanes[2];  /* of a CPU, in each precision; 0: any number */
    int compute_units; /* with clock_mhz a rough measure of speed, to choose among devices */
    int clock_mhz;
    int nvidia_arch; /* 61: sm_61, whose kernels can have a limit of registers; 0: no NVIDIA */
    bool has_double;
    bool has_wide_atomics; /* its groups of threads, if any, add 64-bit integers atomically */
    bool has_timeout;      /* its driver may end long kernels, as one does that draws a display */
    char unusable[1024];   /* why nothing can run there, say no compiler for it; empty: it can */
    bool is_measured; /* its arithmetic is known, being plain C's or remembered (kernel_cache.h) */
    char not_strict[640]; /* then why it cannot do strict arithmetic; empty: it can */
} HdDevice;

/* ---- the arithmetic probe: operands of its primitives and their results, as a device takes and
   gives them (HD_PROBE_ARGUMENTS in kernels/common/kernel_arguments.h) ---- */

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

/* ---- backends ---- */

/* What a backend's renderers do, which are opaque to everybody else. Callers rely on what "must" be
   so. Messages do not name the backend: the caller adds its name. */
typedef struct HdRendererFunctions {
    /* Opens a device that can do what the options ask (hd_device_unsupported_reason), with a
       pipeline other than HD_PIPELINE_AUTO. Must fail with HD_UNAVAILABLE if it cannot be used
       after all. */
    HdStatus (*open)(const HdDevice *device, const HdRenderOptions *options, void **renderer,
                     HdError *error);

    /* Copies the tables to the device, in place of earlier ones, and builds the kernels for them.
       The tables need not outlive the call. */
    HdStatus (*upload)(void *renderer, const HdSceneTables *tables, HdError *error);

    /* Begins a frame of the uploaded scene, if need be when it is collected, and does not wait;
       fewer than HD_FRAMES_IN_FLIGHT are under way. The tables live until the frame is collected or
       dropped. After a failure, HD_INTERRUPTED too, the tables are no longer used, and earlier
       frames are still under way. */
    HdStatus (*submit)(void *renderer, const HdFrameTables *tables, const HdFrameRequest *request,
                       HdError *error);

    /* Waits for the oldest frame under way, that of `tables`, and retires it, even on failure.
       Fills every pixel as wished for at its submission, is_encoded, the counts, trace_seconds and
       longest_launch of `frame`. HD_INTERRUPTED after a signal (interrupt.h): `frame` is worth
       nothing then. Reports progress to `tables->watched`, which may end it too. */
    HdStatus (*collect)(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                        HdError *error);

    /* Fills the frame's `first` with what is met first in that of `tables`, under way or not, and
       waits for it. The renderer was opened for that. HD_INTERRUPTED as above. */
    HdStatus (*first_hits)(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                           HdError *error);

    /* Waits until the device is done with all frames under way, and forgets them. */
    void (*drop)(void *renderer);

    /* Returns the kernels that uploads compile (kernel_cache.h). NULL instead of this function and
       the next one if they are compiled ahead. */
    HdKernelCache *(*kernels)(void *renderer);

    /* Computes a batch of the arithmetic probe with kernels of the same shape. The scene, if there
       is one, must be uploaded again. */
    HdStatus (*probe)(void *renderer, const HdProbeBatch *batch, HdProbeResults *results,
                      HdError *error);

    /* The lanes of the kernels' packets. */
    int (*lanes)(const void *renderer);

    /* One line for people about what was chosen (lanes, threads, instruction set, registers). */
    void (*describe)(const void *renderer, char *text, int capacity);

    /* No frame is under way. */
    void (*close)(void *renderer);
} HdRendererFunctions;

struct HdBackend {
    const char *name;       /* as on the command line */
    bool needs_no_driver;   /* it is there on every machine, and starts at once */
    bool uses_host_threads; /* works with the program's own threads (HdRenderOptions) */
    const HdRendererFunctions *functions;
    const void *driver; /* what tells functions that several backends share one from another */

    /* Must fill at most `capacity` devices, numbered from 0, without their backend, and their
       count. With none it must fail: with HD_UNAVAILABLE if a library or driver is missing, with
       HD_FAILED if one does not start. */
    HdStatus (*enumerate)(HdDevice *devices, int capacity, int *count, HdError *error);
};

enum { HD_MAX_DEVICES = 64 }; /* of a backend */

/* The backend's devices, with the backend and what is remembered of them filled in. */
HdStatus hd_backend_enumerate(const HdBackend *backend, HdDevice *devices, int capacity, int *count,
                              HdError *error);

/* ---- what suits a device ---- */

/* Why the device cannot do what the options ask (strict arithmetic, double precision, several
   lanes, a wavefront), in words; NULL: it can. The words live as long as the device. */
const char *hd_device_unsupported_reason(const HdDevice *device, const HdRenderOptions *options);

/* Returns the pipeline of `options`, and in place of HD_PIPELINE_AUTO the wavefront on a CPU for a
   scene whose shading has most of the time (docs/performance.md), on a GPU with 64-bit atomics
   whose launches must be short for deep trees (docs/development/backends.md, Pipelines), and else
   the megakernel. `scene` may be NULL: not known. */
HdPipeline hd_choose_pipeline(const HdDevice *device, const HdRenderOptions *options,
                              const HdScene *scene);

/* Seconds that launches on a GPU should stay below. */
double hd_longest_launch(const HdDevice *device, const HdRenderOptions *options);

/* Whether the megakernel could keep that device, which may be drawing a display, for too long: it
   traces a whole tree in one launch, which nothing can cut. */
bool hd_megakernel_is_too_long(const HdDevice *device, const HdRenderOptions *options);

/* ---- devices that were there and are lost to the program ---- */

/* Fails with HD_UNAVAILABLE: `what` failed, since the device is lost; the message adds what to do.
 */
HdStatus hd_fail_lost(HdError *error, const char *what);

/* True for an error of the above, which is passing: another time the device may be there again. */
bool hd_is_loss(const HdError *error);

#endif
