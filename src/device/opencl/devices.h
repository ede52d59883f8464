/* SPDX-License-Identifier: MIT */
/* The OpenCL devices of this machine and what they can do. */
#ifndef HD_DEVICE_OPENCL_DEVICES_H
#define HD_DEVICE_OPENCL_DEVICES_H

#include "device/backend.h"
#include "device/opencl/error.h"

typedef struct HdOpenclDevice {
    cl_device_id id;
    bool is_cpu;
    int nvidia_arch; /* as HdDevice's */
    int compute_units;
    int native_width[2]; /* lanes of a register, by HdPrecision */
    cl_ulong memory, max_allocation;
} HdOpenclDevice;

/* As HdBackend's; all devices of all platforms, in the order in which they are reported. */
HdStatus hd_opencl_enumerate(HdDevice *devices, int capacity, int *count, HdError *error);

/* The device with that number. Fails with HD_UNAVAILABLE where no kernel can run on it at all. */
HdStatus hd_opencl_find(HdOpenclDevice *device, int index, HdError *error);

#endif
