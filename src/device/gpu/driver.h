/* SPDX-License-Identifier: MIT */
/* Interface of a GPU driver: CUDA and OpenCL fill in this table, and one renderer uses it. */
#ifndef HD_DEVICE_GPU_DRIVER_H
#define HD_DEVICE_GPU_DRIVER_H

#include "device/backend.h"
#include "device/kernel_source.h"

/* Location of a memory. */
typedef enum HdGpuPlace {
    HD_GPU_DEVICE,
    HD_GPU_DEVICE_AT_ONCE, /* allocated at once: drivers may defer the other kind */
    HD_GPU_HOST            /* pinned host memory, which the device copies from and to by itself */
} HdGpuPlace;

typedef struct HdGpuMemory {
    void *handle; /* kernel argument; NULL: no memory */
    void *data;   /* host address of host memory */
    size_t bytes;
    bool is_constant; /* part of the kernels, never released */
} HdGpuMemory;

/* Begin and end of a queued command; zeroed first, then the driver's. */
typedef struct HdGpuEvent {
    void *begin, *end;
} HdGpuEvent;

/* Filled in if memory is refused, since the caller may recover. */
typedef struct HdGpuRefusal {
    bool lacks_memory;
    const char *function, *reason; /* "cuMemAlloc", and the name of its error */
    bool knows_free;
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
    void *to; /* host memory */
    size_t bytes;
} HdGpuCopy;

/* Properties of a device that HdDevice lacks. */
typedef struct HdGpuFacts {
    uint64_t memory;     /* bytes in all; 0: unknown */
    uint64_t at_once;    /* bytes of one memory, at most; 0: unknown */
    int native_lanes[2]; /* lanes of a CPU's register, by HdPrecision */
} HdGpuFacts;

/* Functions that fail report the name of the driver's function and of its error. */
typedef struct HdGpuDriver {
    const char *groups;      /* the driver's term for groups of threads: "blocks" */
    int group_size;          /* threads of a group by default */
    bool counts_host_memory; /* host memory counts as the device's */
    const unsigned char *source;
    const size_t *source_size;

    size_t bytes; /* size of an open device, the functions' `gpu`; zeroed before it is opened */
    /* On failure nothing needs closing. */
    HdStatus (*open)(void *gpu, const HdDevice *device, HdGpuFacts *facts, HdError *error);
    void (*close)(void *gpu);

    /* Precedes all calls but open and close, on a thread that may have used another GPU; or NULL.
     */
    HdStatus (*enter)(void *gpu, HdError *error);

    /* Allocates the empty memory. Fails with `refusal` instead of `error` if memory is lacking;
       HD_GPU_DEVICE_AT_ONCE does not mistake an earlier launch's failure for that. */
    HdStatus (*allocate)(void *gpu, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                         HdGpuRefusal *refusal, HdError *error);
    /* Waits for commands that may still use it. */
    void (*release)(void *gpu, HdGpuMemory *memory);

    /* Queues a copy to the device, in the order of the launches. The data must live until then. */
    HdStatus (*write)(void *gpu, const HdGpuMemory *memory, const void *data, size_t bytes,
                      HdGpuRefusal *refusal, HdError *error);
    /* Copies to host memory in the order of the launches, and waits. */
    HdStatus (*read)(void *gpu, const HdGpuMemory *memory, void *to, size_t bytes, HdError *error);

    /* Write the compiler's options for the shape, and the other versions that the binary depends
       on, without the device. */
    void (*write_options)(void *gpu, const HdKernelShape *shape, char *text, size_t capacity);
    void (*write_version)(void *gpu, char *text, size_t capacity);
    /* Make the kernels, from the text or from what `binary` returned for the same options. `maker`
       is the compiler: `compile` writes it, "" if unknown; `load` gets it. */
    HdStatus (*compile)(void *gpu, const HdKernelShape *shape, const char *options, char *maker,
                        size_t capacity, HdError *error);
    HdStatus (*load)(void *gpu, const HdKernelShape *shape, const char *options,
                     const unsigned char *binary, size_t size, const char *maker, HdError *error);
    unsigned char *(*binary)(const void *gpu, size_t *size); /* as HdKernelReader */
    void (*unload)(void *gpu);                               /* without kernels does nothing */
    /* Finds the kernels' constant memory for a table; false: none. NULL: no table has one. */
    bool (*constant)(void *gpu, const char *table, HdGpuMemory *memory);
    /* Reports how many threads a group of the tracing kernel may have. */
    HdStatus (*max_threads)(void *gpu, size_t *threads, HdError *error);

    /* Queues a launch; `event`, unless NULL, records its times. */
    HdStatus (*launch)(void *gpu, const HdGpuLaunch *launch, HdGpuEvent *event, HdError *error);
    /* Queues copies to the host after the event `after`, concurrent with later launches. `done` is
       the event of the last one. */
    HdStatus (*copy_back)(void *gpu, const HdGpuEvent *after, const HdGpuCopy *copies, int count,
                          HdGpuEvent *done, HdError *error);
    /* Wait for a launch, or for copies to the host, without keeping a core busy. */
    HdStatus (*wait_for_launch)(void *gpu, const HdGpuEvent *launch, HdError *error);
    HdStatus (*wait_for_copies)(void *gpu, const HdGpuEvent *done, HdError *error);
    /* Waits for all launches and copies to the device. */
    HdStatus (*finish)(void *gpu, HdError *error);
    /* Waits for everything and ignores errors. */
    void (*drain)(void *gpu);
    /* Measures from the begin of one event to the end of another, both over; negative: unknown. */
    HdStatus (*seconds)(void *gpu, const HdGpuEvent *from, const HdGpuEvent *to, double *seconds,
                        HdError *error);
    void (*forget)(void *gpu, HdGpuEvent *event);

    /* Writes one line for people about the device and its kernels. `maker` as above. */
    int (*describe)(const void *gpu, const HdKernelShape *shape, int group_size,
                    const char *pipeline, const char *maker, char *text, int capacity);
} HdGpuDriver;

/* Renderer over the GPU driver of the backend. */
extern const HdRendererFunctions hd_gpu_functions;

#endif
