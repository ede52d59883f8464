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
#include "tables/tables.h"

/* Frames that were submitted and not collected yet. */
enum { HD_FRAMES_IN_FLIGHT = 2 };

/* Devices that may share a sequence. */
enum { HD_MOST_TRACERS = 64 };

typedef struct HdBackend HdBackend;
typedef struct HdKernelCache HdKernelCache;

typedef struct HdDevice {
    const HdBackend *backend;
    int index; /* within the backend */
    char name[256];
    char driver[256];  /* platform, driver and versions, for people */
    bool is_cpu;       /* takes several lanes */
    int most_lanes[2]; /* that it takes in each precision, where it is a CPU; 0: as many as are
                          asked for */
    int compute_units; /* with clock_mhz a rough measure of speed, to choose among devices */
    int clock_mhz;
    int nvidia_arch; /* where kernels can be built with a limit of registers, which is on NVIDIA
                        devices: 61 stands for sm_61; else 0 */
    bool has_double;
    bool
        has_wide_atomics; /* adds 64-bit integers atomically, where it works in groups of threads */
    bool has_timeout;     /* its driver may end long kernels, as where it draws a display; or does
                             not tell, and a display may be there */
    char unusable[1024];  /* why nothing can run there, say no compiler for it; empty: it can */
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

/* What a backend's renderers do. Arguments are checked before a function is called (renderer.c);
   "must" marks what the callers rely on. Renderers are opaque to everybody else. Messages do not
   name the backend: who calls it adds its name. */
typedef struct HdRendererFunctions {
    /* Opens one device that can do what the options ask (hd_device_obstacle); their pipeline is not
       HD_PIPELINE_AUTO. Must fail with HD_UNAVAILABLE where the device or its driver cannot be used
       after all. */
    HdStatus (*open)(const HdDevice *device, const HdRenderOptions *options, void **renderer,
                     HdError *error);

    /* Copies the tables to the device and builds the kernels for them. The tables need not outlive
       the call. A later upload replaces an earlier one. */
    HdStatus (*upload)(void *renderer, const HdSceneTables *tables, HdError *error);

    /* Begins a frame of the uploaded scene; fewer than HD_FRAMES_IN_FLIGHT are under way. The
       tables live until the frame is collected or dropped. The device should be given all there is
       to do, and not be waited for. On failure, also HD_INTERRUPTED as below, the tables are no
       longer used, and the earlier frames are still under way. Where nothing works by itself, a
       frame is rendered when it is collected. */
    HdStatus (*submit)(void *renderer, const HdFrameTables *tables, const HdFrameWish *wish,
                       HdError *error);

    /* Waits for the oldest frame under way, that of `tables`, which is so no longer in any case:
       fills every pixel as wished for at its submission, is_encoded, the counts, trace_seconds and
       longest_launch of `frame`. HD_INTERRUPTED where a signal came first (interrupt.h): then
       `frame` is worth nothing. From its submission on the work is told to whom `tables` names, as
       it gets done, who may end it as a signal does. */
    HdStatus (*collect)(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                        HdError *error);

    /* Fills the frame's `first` with what is met first in that of `tables`, which is not listed and
       may be under way or not; waits for it. The renderer was opened for that.
       HD_INTERRUPTED as above. */
    HdStatus (*first_hits)(void *renderer, const HdFrameTables *tables, HdFrame *frame,
                           HdError *error);

    /* Waits until the device is done with all frames under way, and forgets them. */
    void (*drop)(void *renderer);

    /* The kernels that uploads compile, and what the last one did to have them (kernel_cache.h).
       NULL instead of this function and the next one where they are compiled ahead. */
    HdKernelCache *(*kernels)(void *renderer);

    /* Computes a batch of the arithmetic probe with kernels of the same shape. The scene, if there
       is one, must be uploaded again. */
    HdStatus (*probe)(void *renderer, const HdProbeBatch *batch, HdProbeResults *results,
                      HdError *error);

    /* The lanes of the kernels' bundles. */
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

    /* Must fill at most `capacity` devices, numbered from 0, and their count; whose they are is
       filled in by hd_backend_enumerate. With none it must return HD_UNAVAILABLE and the reason:
       which library or driver is missing; or HD_FAILED where a driver is there that does not start.
     */
    HdStatus (*enumerate)(HdDevice *devices, int capacity, int *count, HdError *error);
};

enum { HD_MAX_DEVICES = 64 }; /* of a backend */

/* The backend's devices, with the backend and what is remembered of them filled in. */
HdStatus hd_backend_enumerate(const HdBackend *backend, HdDevice *devices, int capacity, int *count,
                              HdError *error);

/* ---- what suits a device ---- */

/* Why the device cannot do what the options ask (strict arithmetic, double precision, several
   lanes, a wavefront), in words; NULL: it can. The words live as long as the device. */
const char *hd_device_obstacle(const HdDevice *device, const HdRenderOptions *options);

/* What `options` come to on that device: never HD_PIPELINE_AUTO. Where they leave the choice, a CPU
   takes the wavefront for a scene whose shading has most of the time (docs/performance.md), a GPU
   with 64-bit atomics whose launches must be short for deep trees (docs/backends.md, Launches), and
   otherwise the megakernel is taken. `scene` may be NULL: not known. */
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
