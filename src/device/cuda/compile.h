/* SPDX-License-Identifier: MIT */
/* The kernels, compiled to the machine code of one NVIDIA architecture. Needs no device. */
#ifndef HD_DEVICE_CUDA_COMPILE_H
#define HD_DEVICE_CUDA_COMPILE_H

#include <stddef.h>

#include "device/cuda/nvrtc.h"
#include "device/kernel_source.h"

typedef struct HdCudaCode {
    char *cubin; /* owned */
    size_t size;
    char *log; /* owned; what the compiler had to say, "" at least */
} HdCudaCode;

/* The compiler's options for sm_`arch`, a space between two. */
void hd_cuda_options(char *options, size_t capacity, int arch, const HdKernelShape *shape);

/* Compiles the embedded text with these options, for sm_`arch`. On failure the whole log is in the
   message and there is nothing to free. */
HdStatus hd_cuda_compile(HdCudaCode *code, const HdNvrtc *nvrtc, int arch, const char *options,
                         HdError *error);

void hd_cuda_code_free(HdCudaCode *code);

#endif
