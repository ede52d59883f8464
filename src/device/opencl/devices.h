/* SPDX-License-Identifier: MIT */
/* Lists the OpenCL devices of this machine and their capabilities, and names OpenCL's errors. */
#ifndef HD_DEVICE_OPENCL_DEVICES_H
#define HD_DEVICE_OPENCL_DEVICES_H

#include "device/gpu/driver.h"
#include "device/opencl/api.h"
#include "system/path.h"

/* Size limit of a driver's answers; a larger claim is an error of the driver. */
enum { HD_OPENCL_MAX_BYTES = 1 << 26 };

/* Lists all devices of all platforms in the order of the driver, as HdBackend's `enumerate`. */
HdStatus hd_opencl_enumerate(HdDevice *devices, int capacity, int *count, HdError *error);

/* Finds the device with that number. HD_UNAVAILABLE if no kernel can run on it. */
HdStatus hd_opencl_find(const HdOpenclLibrary *cl, cl_device_id *device, int index,
                        HdGpuFacts *facts, HdError *error);

/* Returns whether the driver, whose description begins with its platform's name, is PoCL without a
   cache folder that it can write to; then writes a sentence about that. Makes the folder if it can.
   */
enum { HD_POCL_FAULT_SIZE = HD_MAX_PATH + 120 };
bool hd_pocl_lacks_cache(const char *driver, char fault[HD_POCL_FAULT_SIZE]);

/* Returns the name of an OpenCL 1.2 error, such as "CL_OUT_OF_RESOURCES", or
   CL_PLATFORM_NOT_FOUND_KHR; otherwise "an unknown error". The text is static. */
const char *hd_opencl_error_name(cl_int code);

/* Fails with the names of the function and of the error: HD_UNAVAILABLE if the device is lost
   (hd_fail_lost), otherwise HD_FAILED. */
HdStatus hd_opencl_fail(HdError *error, const char *function, cl_int code);

#endif
