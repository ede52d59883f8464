/* SPDX-License-Identifier: MIT */
/* The kernels, compiled for one NVIDIA architecture. Needs no device. */
#ifndef HD_DEVICE_CUDA_COMPILE_H
#define HD_DEVICE_CUDA_COMPILE_H

#include <stdbool.h>
#include <stddef.h>

#include "device/cuda/nvrtc.h"
#include "device/kernel_source.h"

typedef struct HdCudaCode {
    char *image; /* owned; machine code, or PTX with its NUL */
    size_t size;
    char *log; /* owned; what the compiler had to say, "" at least */
} HdCudaCode;

typedef struct HdCudaTarget {
    int arch;    /* 61 */
    bool is_ptx; /* PTX for compute_61, otherwise the machine code of sm_61 */
} HdCudaTarget;

/* What the shape is compiled to for a device of sm_`arch`. */
HdCudaTarget hd_cuda_target(const HdKernelShape *shape, int arch);

/* The compiler's options for that target, a space between two. With PTX the limit of registers
   is the driver's business, and here for whoever compares options. */
void hd_cuda_options(char *options, size_t capacity, HdCudaTarget target,
                     const HdKernelShape *shape);

/* Compiles the embedded text with these options, for that target. On failure the whole log is in
   the message and there is nothing to free. */
HdStatus hd_cuda_compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdCudaTarget target,
                         const char *options, HdError *error);

void hd_cuda_code_free(HdCudaCode *code);

#endif
