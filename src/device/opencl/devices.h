/* SPDX-License-Identifier: MIT */
/* The OpenCL devices of this machine and what they can do. */
#ifndef HD_DEVICE_OPENCL_DEVICES_H
#define HD_DEVICE_OPENCL_DEVICES_H

#include "device/gpu/driver.h"
#include "device/opencl/error.h"

/* Of what a driver says; one that claims more lies. */
enum { HD_OPENCL_MOST_BYTES = 1 << 26 };

/* As HdBackend's; all devices of all platforms, in the order in which they are reported. */
HdStatus hd_opencl_enumerate(HdDevice *devices, int capacity, int *count, HdError *error);

/* The device with that number. Fails with HD_UNAVAILABLE where no kernel can run on it at all. */
HdStatus hd_opencl_find(cl_device_id *device, int index, HdGpuFacts *facts, HdError *error);

#endif
