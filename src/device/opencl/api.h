/* SPDX-License-Identifier: MIT */
/* OpenCL 1.2's functions, from the library that a machine has. */
#ifndef HD_DEVICE_OPENCL_API_H
#define HD_DEVICE_OPENCL_API_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#ifdef __ALTIVEC__ /* they include altivec.h, whose words in strict C are also macros */
#undef bool
#undef pixel
#undef vector
#define bool _Bool
#endif

#include "base/error.h"

#define HD_OPENCL_FUNCTIONS(X)                                                                     \
    X(clBuildProgram)                                                                              \
    X(clCreateBuffer)                                                                              \
    X(clCreateCommandQueue)                                                                        \
    X(clCreateContext)                                                                             \
    X(clCreateKernel)                                                                              \
    X(clCreateProgramWithBinary)                                                                   \
    X(clCreateProgramWithSource)                                                                   \
    X(clEnqueueMapBuffer)                                                                          \
    X(clEnqueueNDRangeKernel)                                                                      \
    X(clEnqueueReadBuffer)                                                                         \
    X(clEnqueueUnmapMemObject)                                                                     \
    X(clEnqueueWriteBuffer)                                                                        \
    X(clFinish)                                                                                    \
    X(clFlush)                                                                                     \
    X(clGetDeviceIDs)                                                                              \
    X(clGetDeviceInfo)                                                                             \
    X(clGetEventProfilingInfo)                                                                     \
    X(clGetKernelWorkGroupInfo)                                                                    \
    X(clGetPlatformIDs)                                                                            \
    X(clGetPlatformInfo)                                                                           \
    X(clGetProgramBuildInfo)                                                                       \
    X(clGetProgramInfo)                                                                            \
    X(clReleaseCommandQueue)                                                                       \
    X(clReleaseContext)                                                                            \
    X(clReleaseEvent)                                                                              \
    X(clReleaseKernel)                                                                             \
    X(clReleaseMemObject)                                                                          \
    X(clReleaseProgram)                                                                            \
    X(clSetKernelArg)                                                                              \
    X(clWaitForEvents)

#define HD_OPENCL_MEMBER(function) __typeof__(function) *function;
typedef struct HdOpenclLibrary {
    HD_OPENCL_FUNCTIONS(HD_OPENCL_MEMBER)
} HdOpenclLibrary;
#undef HD_OPENCL_MEMBER

/* Loads the library, which stays loaded. HD_UNAVAILABLE if it is missing or too old; the message
   adds advice. */
HdStatus hd_opencl_load_library(HdOpenclLibrary *cl, HdError *error);

#endif
