/* SPDX-License-Identifier: MIT */
/* The parts of the one renderer over a driver of GPUs, for its own files and their tests. */
#ifndef HD_DEVICE_GPU_GPU_H
#define HD_DEVICE_GPU_GPU_H

#include "device/gpu/driver.h"
#include "device/kernel_cache.h"
#include "device/launch_plan.h"

/* ---- an open GPU and its memory ---- */

typedef struct HdGpu {
    const HdGpuDriver *driver;
    void *handle;
    const char *name; /* of the device, for messages */
    HdGpuFacts facts;
} HdGpu;

/* Makes it memory of at least `bytes`, unless it is; then its contents are lost. It never shrinks,
   for taking memory lasts as long as a small frame. `what` is for messages: "pixels". */
HdStatus hd_gpu_reserve(const HdGpu *gpu, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                        const char *what, HdError *error);

/* Fails, and makes a message of the refusal. */
HdStatus hd_gpu_refuse(const HdGpu *gpu, HdGpuPlace place, size_t bytes, const char *what,
                       const HdGpuRefusal *refusal, HdError *error);

/* Reserves room for a table and queues the copy. An empty one needs memory too. */
HdStatus hd_gpu_write_table(const HdGpu *gpu, HdGpuMemory *memory, const void *data, size_t bytes,
                            const char *what, HdError *error);

void hd_gpu_release(const HdGpu *gpu, HdGpuMemory *memory);

/* ---- a wavefront's queue in it ---- */

typedef struct HdGpuWaveQueue {
    HdGpuMemory buffers[HD_WAVE_BUFFERS];
    HdGpuMemory taken;    /* the counter of taken places */
    HdGpuMemory reported; /* of the host: what it reads of that */
    HdWavePlan plan;
    size_t bytes; /* that it may use, for each of its workers */
    bool is_cut;  /* the device refused more */
} HdGpuWaveQueue;

/* Takes memory for the needs of each worker, or for less if the device has too little left. */
HdStatus hd_gpu_wave_queue_reserve(HdGpuWaveQueue *queue, const HdGpu *gpu, HdWaveNeeds *needs,
                                   int workers, HdError *error);

/* Queues that no place is taken. */
HdStatus hd_gpu_wave_queue_empty(HdGpuWaveQueue *queue, const HdGpu *gpu, HdError *error);

/* Waits, and tells how many places are taken. */
HdStatus hd_gpu_wave_queue_read(const HdGpuWaveQueue *queue, const HdGpu *gpu, unsigned *taken,
                                HdError *error);

void hd_gpu_wave_queue_release(HdGpuWaveQueue *queue, const HdGpu *gpu);

/* ---- its kernels: from the cache, or compiled for a scene ---- */

typedef struct HdGpuProgram {
    HdKernelCache cache;
    bool is_built;      /* for the cache's shape */
    bool probes_by_fma; /* so is the probe's kernel, if there is one */
    int block;          /* threads of a group, as asked for; 0: as many as the kernels allow */
    int registers;      /* of a thread, as asked for; 0: what suits */
    int nvidia_arch;    /* as HdDevice has it */
    int group_size;     /* of a launch: 1 where threads do not work in groups */
} HdGpuProgram;

/* Has kernels that do what a scene needs. The cache reads them later: `gpu` must stay in place. */
HdStatus hd_gpu_build(HdGpuProgram *program, const HdGpu *gpu, const HdKernelNeeds *needs,
                      HdError *error);

/* Has the kernel of the arithmetic probe, for the same shape, in place of those for a scene. */
HdStatus hd_gpu_build_probe(HdGpuProgram *program, const HdGpu *gpu, HdError *error);

/* Computes a batch with the kernel of hd_gpu_build_probe, and waits for it. */
HdStatus hd_gpu_run_probe(const HdGpuProgram *program, const HdGpu *gpu, const HdProbeBatch *batch,
                          HdProbeResults *results, HdError *error);

/* ---- flights: frames on their way from the kernels to the host, while the next is traced ---- */

enum { HD_SUM_WORKERS = 1024 }; /* work items of hedron_sum_counts; each writes one sum */

typedef struct HdGpuFrameInFlight {
    HdGpuMemory pixels, sums; /* radiance, and HD_SUM_WORKERS sums of the counts */
    HdGpuMemory image;        /* 8 bits, where the frame is encoded */
    HdGpuMemory tables;       /* of the host: of the frame, on their way to the device */
    HdGpuMemory copy;         /* of the host: the sums, then the pixels or the image */
    bool encodes;
    const HdFrameTables *of; /* the frame */
    int items, reported;     /* of the frame, and how many of them are told to be done */
    double submitted;        /* by hd_monotonic_seconds */
    int launches;            /* of the tracing kernel */
    HdGpuEvent first, later; /* of its launches: the first one, and the last of others */
    HdGpuEvent *untimed;     /* which of them is not timed yet, if one is */
    double work;             /* of that launch */
    double launched;         /* by hd_monotonic_seconds, that launch */
    bool is_alone;           /* nothing was queued before that launch that may not be over */
    double longest_launch;   /* seconds, of those that are timed; negative: there is none */
    HdGpuEvent summed, encoded, copied;
} HdGpuFrameInFlight;

typedef struct HdGpuFramesInFlight {
    HdGpuFrameInFlight frames_in_flight[HD_FRAMES_IN_FLIGHT];
    int oldest, count;
    double collected;  /* when the last one was */
    HdLaunchSize size; /* of the tracing kernel's launches */
} HdGpuFramesInFlight;

/* ---- the renderer ---- */

typedef struct HdGpuRenderer {
    HdGpu gpu;
    HdDevice device;
    HdRenderOptions options;
    bool has_groups; /* of threads that work together, as GPUs have them */
    int depth;       /* of the scene */
    HdGpuProgram program;
    HdGpuMemory scene[HD_SCENE_TABLE_COUNT];
    HdGpuMemory frame[HD_FRAME_TABLE_COUNT];
    HdGpuMemory counts;
    HdGpuMemory first_hits;
    HdGpuEvent first_hits_found;
    HdGpuMemory thresholds; /* of `curve`, if there are any */
    HdCurve curve;
    HdGpuWaveQueue queue;
    HdGpuFramesInFlight frames_in_flight;
} HdGpuRenderer;

/* None is under way. */
void hd_gpu_frames_in_flight_close(HdGpuRenderer *renderer);

/* The next flight, with room for a frame of so many items. */
HdStatus hd_gpu_frame_begin(HdGpuRenderer *renderer, const HdFrameTables *tables, int items,
                            bool encodes, HdGpuFrameInFlight **in_flight, HdError *error);

/* A launch of the tracing kernel, with so much work. */
HdStatus hd_gpu_frame_launch(const HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                             const HdGpuLaunch *launch, double work, HdError *error);

/* Learns from the last of these launches, which is over, what the size of the next ones should be;
   if the device does not time it, by the host's clock: `waited` is when, by hd_monotonic_seconds,
   the host began to wait for it. */
HdStatus hd_gpu_frame_time_launch(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight,
                                  double waited, HdError *error);

/* The items before number `end` are done. */
void hd_gpu_frame_report(HdGpuFrameInFlight *in_flight, int end);

/* Queues the copies, all kernels being queued: the flight is under way. */
HdStatus hd_gpu_frame_send(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, HdError *error);

/* Waits for the oldest flight, which ends in any case, and fills the frame. */
HdStatus hd_gpu_frame_collect(HdGpuRenderer *renderer, HdFrame *frame, HdError *error);

/* Queues all that the frame needs, up to its copies. */
HdStatus hd_gpu_launch_frame(HdGpuRenderer *renderer, HdGpuFrameInFlight *in_flight, HdCurve curve,
                             HdError *error);

/* Fills the frame's `first` and waits for it. */
HdStatus hd_gpu_find_first_hits(HdGpuRenderer *renderer, const HdFrameTables *tables,
                                HdFrame *frame, HdError *error);

/* ---- from the lists of kernels/common/kernel_arguments.h to the arguments of a launch ---- */

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

/* A struct with a member for each entry of a list of arguments, and a function that adds them all
   in the kernel's order; it must live until the launch. */
#define HD_GPU_ARGUMENTS(Struct, function, LIST)                                                   \
    typedef struct Struct {                                                                        \
        LIST(HD_MEMBER, HD_MEMBER)                                                                 \
    } Struct;                                                                                      \
    static void function(HdGpuLaunch *launch, const Struct *from) {                                \
        LIST(HD_ADD, HD_ADD)                                                                       \
    }

#endif
