/* SPDX-License-Identifier: MIT */
/* An open GPU and its memory. */
#ifndef HD_DEVICE_GPU_MEMORY_H
#define HD_DEVICE_GPU_MEMORY_H

#include "device/gpu/driver.h"

typedef struct HdGpu {
    const HdGpuDriver *driver;
    void *handle;
    const char *name; /* of the device, for messages */
    HdGpuFacts facts;
} HdGpu;

/* Makes it memory of at least `bytes`, unless it is; its contents are lost if not. It never
   shrinks, for to take memory anew takes as long as a small frame. `what` is for messages:
   "pixels". */
HdStatus hd_gpu_reserve(const HdGpu *gpu, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                        const char *what, HdError *error);

/* The same where `refusal` tells that there is too little memory, for hd_gpu_refuse to make a
   message of it, unless something else is done about it. */
HdStatus hd_gpu_try(const HdGpu *gpu, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                    HdGpuRefusal *refusal, HdError *error);
HdStatus hd_gpu_refuse(const HdGpu *gpu, HdGpuPlace place, size_t bytes, const char *what,
                       const HdGpuRefusal *refusal, HdError *error);

/* Reserves room for a table and queues the copy. An empty one needs memory too. */
HdStatus hd_gpu_write_table(const HdGpu *gpu, HdGpuMemory *memory, const void *data, size_t bytes,
                            const char *what, HdError *error);

void hd_gpu_release(const HdGpu *gpu, HdGpuMemory *memory);

#endif
