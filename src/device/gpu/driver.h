/* SPDX-License-Identifier: MIT */
/* What a driver of GPUs must be able to do: CUDA and OpenCL fill this table in, and one renderer
   does the rest. */
#ifndef HD_DEVICE_GPU_DRIVER_H
#define HD_DEVICE_GPU_DRIVER_H

#include "device/backend.h"
#include "device/kernel_source.h"

/* Where a memory is. */
typedef enum HdGpuPlace {
    HD_GPU_DEVICE,
    HD_GPU_DEVICE_AT_ONCE, /* drivers may put it off to take memory; not here */
    HD_GPU_HOST            /* where it stays, so that the device copies from and to it by itself */
} HdGpuPlace;

typedef struct HdGpuMemory {
    void *handle; /* what kernels take as an argument; NULL: there is none */
    void *data;   /* of memory of the host */
    size_t bytes;
    bool is_constant; /* a part of the kernels, which nobody releases */
} HdGpuMemory;

/* When something that was queued began and ended; all zero at first, then the driver's. */
typedef struct HdGpuEvent {
    void *begin, *end;
} HdGpuEvent;

/* Filled in where memory is refused, for that may be helped. */
typedef struct HdGpuRefusal {
    bool lacks_memory;
    const char *function, *reason; /* "cuMemAlloc", and the name of its error */
    bool tells_free;
    double free; /* bytes */
} HdGpuRefusal;

enum { HD_GPU_MAX_ARGUMENTS = 64 };

typedef struct HdGpuArgument {
    const void *value; /* a number, or the handle of a memory */
    size_t bytes;
} HdGpuArgument;

typedef struct HdGpuLaunch {
    HdKernel kernel;
    int groups, group_size;
    HdGpuArgument arguments[HD_GPU_MAX_ARGUMENTS];
    int argument_count;
} HdGpuLaunch;

typedef struct HdGpuCopy {
    const HdGpuMemory *from;
    void *to; /* in memory of the host */
    size_t bytes;
} HdGpuCopy;

/* What a device is, apart from what HdDevice tells. */
typedef struct HdGpuFacts {
    uint64_t memory;     /* bytes in all; 0: unknown */
    uint64_t at_once;    /* most bytes of one memory; 0: unknown */
    int native_lanes[2]; /* of a CPU's register, by HdPrecision */
} HdGpuFacts;

/* Functions that fail tell the name of the driver's function and of its error. */
typedef struct HdGpuDriver {
    const char *groups;      /* what its groups of threads are called: "blocks" */
    int group_size;          /* of them, where nothing else is asked for */
    bool counts_host_memory; /* as the device's */
    const unsigned char *source;
    const size_t *source_size;

    size_t bytes; /* of an open device, the functions' `gpu`; zeroed before it is opened */
    /* On failure there is nothing to close. */
    HdStatus (*open)(void *gpu, const HdDevice *device, HdGpuFacts *facts, HdError *error);
    void (*close)(void *gpu);

    /* Precedes all calls but open and close, on a thread that may have used another GPU; or NULL.
     */
    HdStatus (*enter)(void *gpu, HdError *error);

    /* Makes an empty memory one of so many bytes. Fails with `refusal` instead of `error` if memory
       is lacking, for which HD_GPU_DEVICE_AT_ONCE takes no earlier launch's failure. */
    HdStatus (*allocate)(void *gpu, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                         HdGpuRefusal *refusal, HdError *error);
    /* Waits for what may still use it. */
    void (*release)(void *gpu, HdGpuMemory *memory);

    /* Queues a copy to the device, in the order of the launches. The data must live until then. */
    HdStatus (*write)(void *gpu, const HdGpuMemory *memory, const void *data, size_t bytes,
                      HdGpuRefusal *refusal, HdError *error);
    /* Copies to memory of the host in the order of the launches, and waits. */
    HdStatus (*read)(void *gpu, const HdGpuMemory *memory, void *to, size_t bytes, HdError *error);

    /* The compiler's options for kernels of that shape, and what they depend on besides, apart from
       the device. */
    void (*write_options)(void *gpu, const HdKernelShape *shape, char *text, size_t capacity);
    void (*write_version)(void *gpu, char *text, size_t capacity);
    /* Make the kernels, from the text or from what `binary` handed out for such options. Whoever
       compiled is told in `maker`, "" where nobody knows; a binary was made by `maker`. */
    HdStatus (*compile)(void *gpu, const HdKernelShape *shape, const char *options, char *maker,
                        size_t capacity, HdError *error);
    HdStatus (*load)(void *gpu, const HdKernelShape *shape, const char *options,
                     const unsigned char *binary, size_t size, const char *maker, HdError *error);
    unsigned char *(*binary)(const void *gpu, size_t *size); /* as HdKernelReader */
    void (*unload)(void *gpu);                               /* there may be no kernels */
    /* The kernels' room for a table in constant memory; false: none. NULL: no driver's table is. */
    bool (*constant)(void *gpu, const char *table, HdGpuMemory *memory);
    /* The most threads of a group of the tracing kernel. */
    HdStatus (*max_threads)(void *gpu, size_t *threads, HdError *error);

    /* Queues a launch; `event`, if it is not NULL, tells its times. */
    HdStatus (*launch)(void *gpu, const HdGpuLaunch *launch, HdGpuEvent *event, HdError *error);
    /* Queues copies to the host, after what `after` marks, beside later launches. `done` marks the
       last one. */
    HdStatus (*copy_back)(void *gpu, const HdGpuEvent *after, const HdGpuCopy *copies, int count,
                          HdGpuEvent *done, HdError *error);
    /* Waits for a launch, and for copies to the host, without keeping a core busy. */
    HdStatus (*wait_for_launch)(void *gpu, const HdGpuEvent *launch, HdError *error);
    HdStatus (*wait_for_copies)(void *gpu, const HdGpuEvent *done, HdError *error);
    /* Waits for all launches and copies to the device. */
    HdStatus (*finish)(void *gpu, HdError *error);
    /* Waits for everything, whatever comes of it. */
    void (*drain)(void *gpu);
    /* From the begin of one to the end of another, both over; negative: the device does not tell.
     */
    HdStatus (*seconds)(void *gpu, const HdGpuEvent *from, const HdGpuEvent *to, double *seconds,
                        HdError *error);
    void (*forget)(void *gpu, HdGpuEvent *event);

    /* One line for people about the device and its kernels, as HdBackend's. `maker` as above. */
    int (*describe)(const void *gpu, const HdKernelShape *shape, int group_size,
                    const char *pipeline, const char *maker, char *text, int capacity);
} HdGpuDriver;

/* Renders on one device by the driver of its backend. */
extern const HdRendererFunctions hd_gpu_functions;

#endif
