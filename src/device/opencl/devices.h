/* SPDX-License-Identifier: MIT */
/* The OpenCL devices of this machine, what they can do, and OpenCL's errors in words. */
#ifndef HD_DEVICE_OPENCL_DEVICES_H
#define HD_DEVICE_OPENCL_DEVICES_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include "device/gpu/driver.h"

/* Of what a driver says; one that claims more lies. */
enum { HD_OPENCL_MAX_BYTES = 1 << 26 };

/* As HdBackend's; all devices of all platforms, in the order in which they are reported. */
HdStatus hd_opencl_enumerate(HdDevice *devices, int capacity, int *count, HdError *error);

/* The device with that number. Fails with HD_UNAVAILABLE where no kernel can run on it at all. */
HdStatus hd_opencl_find(cl_device_id *device, int index, HdGpuFacts *facts, HdError *error);

/* "CL_OUT_OF_RESOURCES"; for codes that the standard does not have, "an unknown error". */
const char *hd_opencl_error_name(cl_int code);

/* Fails with the name of the function and of the error: HD_UNAVAILABLE where that means that the
   device is lost (hd_fail_lost), else HD_FAILED. */
HdStatus hd_opencl_fail(HdError *error, const char *function, cl_int code);

#endif
