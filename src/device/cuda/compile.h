/* SPDX-License-Identifier: MIT */
/* The kernels, compiled to the machine code of one NVIDIA architecture. Needs no device. */
#ifndef HD_DEVICE_CUDA_COMPILE_H
#define HD_DEVICE_CUDA_COMPILE_H

#include <stdbool.h>

#include "device/cuda/nvrtc.h"
#include "device/kernel_cache.h"

typedef struct HdCudaCode {
    char *cubin; /* owned */
    size_t size;
    char *log; /* owned; what the compiler had to say, "" at least */
} HdCudaCode;

enum { HD_CUDA_OPTIONS_LENGTH = 1024 };

/* The compiler's options for sm_`arch`, a space between two. */
void hd_cuda_options(char options[HD_CUDA_OPTIONS_LENGTH], int arch, const HdKernelShape *shape);

/* Compiles the embedded text for sm_`arch`. With `verbose` the log tells each kernel's registers
   and spills. On failure the whole log is in the message and there is nothing to free. */
HdStatus hd_cuda_compile(HdCudaCode *code, const HdNvrtc *nvrtc, int arch,
                         const HdKernelShape *shape, bool verbose, HdError *error);

/* The same from the cache, without a compiler; false where it is not there. */
bool hd_cuda_find_cached(HdCudaCode *code, HdKernelCache *cache, int arch,
                         const HdKernelShape *shape);

/* As HdKernelReader, of an HdCudaCode. */
unsigned char *hd_cuda_read_code(const void *code, size_t *size);

void hd_cuda_code_free(HdCudaCode *code);

#endif
