/* SPDX-License-Identifier: MIT */
/* Kernels that were compiled to PTX while the program was built, where an NVRTC was there to do it:
   for users who have none. They are general, for one text in PTX is to serve most scenes. */
#ifndef HD_DEVICE_CUDA_PTX_H
#define HD_DEVICE_CUDA_PTX_H

#include <stdbool.h>
#include <stddef.h>

#include "device/kernel_source.h"

typedef struct HdCudaPtx {
    HdKernelShape shape;
    const char *maker; /* "NVRTC 12.6" */
    const unsigned char *text;
    size_t size; /* with the NUL */
} HdCudaPtx;

/* Made by cmake/embed_ptx.c: the kernels of the probe (verify/probe.h) and others, with strict
   arithmetic and all that a scene may need up to the bounds below; none where there was no NVRTC.
 */
extern const HdCudaPtx hd_cuda_ptx[];
extern const int hd_cuda_ptx_count;

enum {
    HD_CUDA_PTX_ARCH = 61,
    HD_CUDA_PTX_BLOCK = 128,
    HD_CUDA_PTX_PLANES = 128,
    HD_CUDA_PTX_DEPTH = 64,
    HD_CUDA_PTX_NODE_STACK = 32
};

/* True where some of it can run on a device of sm_`arch`. */
bool hd_cuda_ptx_suits(int arch);

/* What does all that kernels of that shape would; NULL: there is none. */
const HdCudaPtx *hd_cuda_ptx_find(const HdKernelShape *shape, int arch);

#endif
