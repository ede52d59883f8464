/* SPDX-License-Identifier: MIT */
/* OpenCL's errors in words. */
#ifndef HD_DEVICE_OPENCL_ERROR_H
#define HD_DEVICE_OPENCL_ERROR_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include "base/error.h"

/* "CL_OUT_OF_RESOURCES"; for codes that the standard does not have, "an unknown error". */
const char *hd_opencl_error_name(cl_int code);

/* Fails with the name of the function and of the error: HD_UNAVAILABLE where that means that the
   device is lost (hd_fail_lost), else HD_FAILED. */
HdStatus hd_opencl_fail(HdError *error, const char *function, cl_int code);

#endif
