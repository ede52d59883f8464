/* SPDX-License-Identifier: MIT */
/* Memory of an NVIDIA device, and memory of the host that it copies to and from by itself. */
#ifndef HD_DEVICE_CUDA_MEMORY_H
#define HD_DEVICE_CUDA_MEMORY_H

#include <stddef.h>

#include "device/cuda/api.h"

/* Whose memory; its context is current in every call. */
typedef struct HdCudaOwner {
    const HdCudaDriver *driver;
    const char *name; /* of the device, for messages */
} HdCudaOwner;

typedef struct HdCudaMemory {
    HdCuPointer pointer; /* 0: there is none */
    size_t bytes;
} HdCudaMemory;

typedef struct HdCudaHostMemory {
    void *data; /* NULL: there is none */
    size_t bytes;
} HdCudaHostMemory;

/* Turns a result into a status, with the function's name in the message. */
HdStatus hd_cuda_check(const HdCudaDriver *driver, HdCuResult code, const char *function,
                       HdError *error);

/* Makes it memory of at least `bytes`, unless it is; its contents are lost if not, and the device
   is waited for, which may still use the old one. It never shrinks, for to take memory anew takes
   as long as a small frame. `what` is for messages: "pixels". */
HdStatus hd_cuda_reserve(const HdCudaOwner *owner, HdCudaMemory *memory, size_t bytes,
                         const char *what, HdError *error);

/* The same with what the driver says of it, HD_CU_ERROR_OUT_OF_MEMORY for one, and the message to
   that. */
HdCuResult hd_cuda_try(const HdCudaOwner *owner, HdCudaMemory *memory, size_t bytes);
HdStatus hd_cuda_refuse(const HdCudaOwner *owner, size_t bytes, const char *what, HdCuResult code,
                        HdError *error);

void hd_cuda_release(const HdCudaOwner *owner, HdCudaMemory *memory);

/* The same with memory of the host. */
HdStatus hd_cuda_reserve_host(const HdCudaOwner *owner, HdCudaHostMemory *memory, size_t bytes,
                              const char *what, HdError *error);
void hd_cuda_release_host(const HdCudaOwner *owner, HdCudaHostMemory *memory);

#endif
