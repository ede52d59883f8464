/* SPDX-License-Identifier: MIT */
/* The kernels, compiled by an OpenCL driver. */
#ifndef HD_DEVICE_OPENCL_PROGRAM_H
#define HD_DEVICE_OPENCL_PROGRAM_H

#include "device/kernel_cache.h"
#include "device/opencl/devices.h"

typedef struct HdOpenclProgram {
    cl_program program;           /* NULL: there is none */
    cl_kernel render, store, sum; /* hd_kernel_tracing, hd_kernel_storing, hedron_sum_counts */
    cl_kernel encode;             /* hedron_encode, of devices with groups of threads */
} HdOpenclProgram;

/* Takes the kernels from the cache or compiles the embedded text; then `program` must stay where it
   is, for `cache` to read it. `name` is the device's, for messages. On failure the compiler's log
   is in the message and there is nothing to free. */
HdStatus hd_opencl_build(HdOpenclProgram *program, cl_context context, const HdOpenclDevice *device,
                         const char *name, const HdKernelShape *shape, HdKernelCache *cache,
                         HdError *error);
void hd_opencl_program_free(HdOpenclProgram *program);

#endif
