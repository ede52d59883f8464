/* SPDX-License-Identifier: MIT */
/* Parts of the renderer over a GPU driver, for its own files and their tests. */
#ifndef HD_DEVICE_GPU_GPU_H
#define HD_DEVICE_GPU_GPU_H

#include "device/gpu/driver.h"
#include "device/kernel_cache.h"
#include "device/launch_plan.h"

/* ---- an open GPU and its memory ---- */

typedef struct HdGpu {
    const HdGpuDriver *driver;
    void *handle;
    const char *name; /* the device's name, for messages */
    HdGpuFacts facts;
} HdGpu;

/* Grows the memory to at least `bytes`, losing its contents; it never shrinks, since an allocation
   takes as long as a small frame. `what` is for messages: "pixels". */
HdStatus hd_gpu_reserve(const HdGpu *gpu, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                        const char *what, HdError *error);

/* Fails with a message about the refusal. */
HdStatus hd_gpu_refuse(const HdGpu *gpu, HdGpuPlace place, size_t bytes, const char *what,
                       const HdGpuRefusal *refusal, HdError *error);

/* Reserves memory for a table and queues the copy. An empty table needs memory too. */
HdStatus hd_gpu_write_table(const HdGpu *gpu, HdGpuMemory *memory, const void *data, size_t bytes,
                            const char *what, HdError *error);

void hd_gpu_release(const HdGpu *gpu, HdGpuMemory *memory);

/* ---- a wavefront's queue ---- */

typedef struct HdGpuWaveQueue {
    HdGpuMemory buffers[HD_WAVE_BUFFERS];
    HdGpuMemory taken;    /* counter of used places */
    HdGpuMemory reported; /* host memory into which the counter is read */
    HdWavePlan plan;
    size_t bytes; /* limit for each of its workers */
    bool is_cut;  /* the device refused more */
} HdGpuWaveQueue;

/* Reserves memory for each worker's needs, or for less if the device refuses. */
HdStatus hd_gpu_wave_queue_reserve(HdGpuWaveQueue *queue, const HdGpu *gpu, HdWaveNeeds *needs,
                                   int workers, HdError *error);

/* Queues a reset of the counter. */
HdStatus hd_gpu_wave_queue_empty(HdGpuWaveQueue *queue, const HdGpu *gpu, HdError *error);

/* Waits, and reads the counter of used places. */
HdStatus hd_gpu_wave_queue_read(const HdGpuWaveQueue *queue, const HdGpu *gpu, unsigned *taken,
                                HdError *error);

void hd_gpu_wave_queue_release(HdGpuWaveQueue *queue, const HdGpu *gpu);

/* ---- its kernels: from the cache, or compiled for a scene ---- */

typedef struct HdGpuProgram {
    HdKernelCache cache;
    bool is_built;      /* whether the kernels of the cache's shape exist */
    bool probes_by_fma; /* the probe's kernel, if built, divides by fma */
    int block;          /* threads of a group as requested; 0: as many as the kernels allow */
    int registers;      /* registers of a thread as requested; 0: automatic */
    int nvidia_arch;    /* as in HdDevice */
    int group_size;     /* threads of a group in a launch; 1: no groups */
} HdGpuProgram;

/* Provides kernels for a scene's needs. The cache reads them later: `gpu` must stay in place. */
HdStatus hd_gpu_build(HdGpuProgram *program, const HdGpu *gpu, const HdKernelNeeds *needs,
                      HdError *error);

/* Provides the kernel of the arithmetic probe for the same shape, replacing those for a scene. */
HdStatus hd_gpu_build_probe(HdGpuProgram *program, const HdGpu *gpu, HdError *error);

/* Computes a batch with the kernel of hd_gpu_build_probe, and waits for it. */
HdStatus hd_gpu_run_probe(const HdGpuProgram *program, const HdGpu *gpu, const HdProbeBatch *batch,
                          HdProbeResults *results, HdError *error);

/* ---- frames in flight: copied to the host while the next one is traced ---- */

enum { HD_SUM_WORKERS = 1024 }; /* work items of hedron_sum_counts; each writes one sum */

typedef struct HdGpuFrameInFlight {
    HdGpuMemory pixels, sums; /* radiance, and HD_SUM_WORKERS sums of the counts */
    HdGpuMemory image;        /* 8-bit pixels, if the frame is encoded */
    HdGpuMemory tables;       /* host memory: tables on their way to the device */
    HdGpuMemory copy;         /* host memory: the sums, then the pixels or the image */
    bool encodes;
    const HdFrameTables *of; /* tables of the frame */
    int items, reported;     /* items of the frame, and how many were reported as done */
    double submitted;        /* time of submission, by hd_monotonic_seconds */
    int launches;            /* launches of the tracing kernel */
    HdGpuEvent first, later; /* events of the first launch and of the last of the others */
    HdGpuEvent *untimed;     /* event of the launch not timed yet; NULL: none */
    double work;             /* of that launch */
    double launched;         /* time of that launch, by hd_monotonic_seconds */
    bool is_alone;           /* everything queued before that launch is over */
    double longest_launch;   /* seconds, of the timed launches; negative: none */
    HdGpuEvent summed, encoded, copied;
} HdGpuFrameInFlight;

typedef struct HdGpuFramesInFlight {
    HdGpuFrameInFlight list[HD_FRAMES_IN_FLIGHT];
    int oldest, count;
    double collected;  /* time of the last collection */
    HdLaunchSize size; /* for the launches of the tracing kernel */
} HdGpuFramesInFlight;

/* ---- the renderer ---- */

typedef struct HdGpuRenderer {
    HdGpu gpu;
    HdDevice device;
    HdRenderOptions options;
    bool has_groups; /* threads work in groups, as on GPUs */
    int depth;       /* ray depth of the scene */
    HdGpuProgram program;
    HdGpuMemory scene[HD_SCENE_TABLE_COUNT];
    HdGpuMemory frame[HD_FRAME_TABLE_COUNT];
    HdGpuMemory counts;
    HdGpuMemory first_hits;
    HdGpuEvent first_hits_found;
    HdGpuMemory thresholds; /* of `curve`, if it has any */
    HdCurve curve;
    HdGpuWaveQueue queue;
    HdGpuFramesInFlight frames_in_flight;
} HdGpuRenderer;

/* Closes all frames; none may be in flight. */
void hd_gpu_frames_in_flight_close(HdGpuRenderer *renderer);

/* Returns the next frame in flight, with memory for that many items. */
HdStatus hd_gpu_frame_begin(HdGpuRenderer *renderer, const HdFrameTables *tables, int items,
                            bool encodes, HdGpuFrameInFlight **in_flight, HdError *error);

/* Queues a launch of the tracing kernel that does so much work. */
HdStatus hd_gpu_frame_launch(const HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                             const HdGpuLaunch *launch, double work, HdError *error);

/* Adapts the size of the next launches to the last one, which is over. If the device does not time
   it, uses the host's clock: `waited` is when the host began to wait, by hd_monotonic_seconds. */
HdStatus hd_gpu_frame_time_launch(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                                  double waited, HdError *error);

/* Reports the items before number `end` as done. */
void hd_gpu_frame_report(HdGpuFrameInFlight *in_flight, int end);

/* Queues the copies, after all kernels: the frame is in flight. */
HdStatus hd_gpu_frame_send(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, HdError *error);

/* Blocks on the oldest frame in flight, fills `frame` and retires it, even on failure. */
HdStatus hd_gpu_frame_collect(HdGpuRenderer *renderer, HdFrame *frame, HdError *error);

/* Queues all kernels of the frame, without its copies. */
HdStatus hd_gpu_launch_frame(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, HdCurve curve,
                             HdError *error);

/* Fills the frame's `first` and waits for it. */
HdStatus hd_gpu_find_first_hits(HdGpuRenderer *renderer, const HdFrameTables *tables,
                                HdFrame *frame, HdError *error);

/* ---- arguments of a launch from the lists of kernels/common/kernel_arguments.h ---- */

static inline void hd_gpu_add(HdGpuLaunch *launch, const void *value, size_t bytes) {
    launch->arguments[launch->argument_count++] = (HdGpuArgument){value, bytes};
}

static inline void hd_gpu_add_memory(HdGpuLaunch *launch, const HdGpuMemory *memory) {
    hd_gpu_add(launch, &memory->handle, sizeof memory->handle);
}

#define HD_MEMBER_INPUT(type, name)  const HdGpuMemory *name;
#define HD_MEMBER_BUFFER(type, name) const HdGpuMemory *name;
#define HD_MEMBER_NUMBER(type, name) type name;
#define HD_MEMBER(kind, type, name)  HD_MEMBER_##kind(type, name)
#define HD_ADD_INPUT(name)           hd_gpu_add_memory(launch, from->name);
#define HD_ADD_BUFFER(name)          hd_gpu_add_memory(launch, from->name);
#define HD_ADD_NUMBER(name)          hd_gpu_add(launch, &from->name, sizeof from->name);
#define HD_ADD(kind, type, name)     HD_ADD_##kind(name)

/* Defines a struct with a member for each argument of a list, and a function that adds all of them
   in the kernel's order. The struct must live until the launch. */
#define HD_GPU_ARGUMENTS(Struct, function, LIST)                                                   \
    typedef struct Struct {                                                                        \
        LIST(HD_MEMBER, HD_MEMBER)                                                                 \
    } Struct;                                                                                      \
    static void function(HdGpuLaunch *launch, const Struct *from) {                                \
        LIST(HD_ADD, HD_ADD)                                                                       \
    }

#endif
