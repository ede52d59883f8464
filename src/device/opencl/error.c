/* SPDX-License-Identifier: MIT */
#include "device/opencl/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "device/backend.h"

#define NAME(code) [-(code)] = #code

static const char *const names[] = {NAME(CL_DEVICE_NOT_FOUND),
                                    NAME(CL_DEVICE_NOT_AVAILABLE),
                                    NAME(CL_COMPILER_NOT_AVAILABLE),
                                    NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE),
                                    NAME(CL_OUT_OF_RESOURCES),
                                    NAME(CL_OUT_OF_HOST_MEMORY),
                                    NAME(CL_PROFILING_INFO_NOT_AVAILABLE),
                                    NAME(CL_MEM_COPY_OVERLAP),
                                    NAME(CL_IMAGE_FORMAT_MISMATCH),
                                    NAME(CL_IMAGE_FORMAT_NOT_SUPPORTED),
                                    NAME(CL_BUILD_PROGRAM_FAILURE),
                                    NAME(CL_MAP_FAILURE),
                                    NAME(CL_MISALIGNED_SUB_BUFFER_OFFSET),
                                    NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST),
                                    NAME(CL_COMPILE_PROGRAM_FAILURE),
                                    NAME(CL_LINKER_NOT_AVAILABLE),
                                    NAME(CL_LINK_PROGRAM_FAILURE),
                                    NAME(CL_DEVICE_PARTITION_FAILED),
                                    NAME(CL_KERNEL_ARG_INFO_NOT_AVAILABLE),
                                    NAME(CL_INVALID_VALUE),
                                    NAME(CL_INVALID_DEVICE_TYPE),
                                    NAME(CL_INVALID_PLATFORM),
                                    NAME(CL_INVALID_DEVICE),
                                    NAME(CL_INVALID_CONTEXT),
                                    NAME(CL_INVALID_QUEUE_PROPERTIES),
                                    NAME(CL_INVALID_COMMAND_QUEUE),
                                    NAME(CL_INVALID_HOST_PTR),
                                    NAME(CL_INVALID_MEM_OBJECT),
                                    NAME(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR),
                                    NAME(CL_INVALID_IMAGE_SIZE),
                                    NAME(CL_INVALID_SAMPLER),
                                    NAME(CL_INVALID_BINARY),
                                    NAME(CL_INVALID_BUILD_OPTIONS),
                                    NAME(CL_INVALID_PROGRAM),
                                    NAME(CL_INVALID_PROGRAM_EXECUTABLE),
                                    NAME(CL_INVALID_KERNEL_NAME),
                                    NAME(CL_INVALID_KERNEL_DEFINITION),
                                    NAME(CL_INVALID_KERNEL),
                                    NAME(CL_INVALID_ARG_INDEX),
                                    NAME(CL_INVALID_ARG_VALUE),
                                    NAME(CL_INVALID_ARG_SIZE),
                                    NAME(CL_INVALID_KERNEL_ARGS),
                                    NAME(CL_INVALID_WORK_DIMENSION),
                                    NAME(CL_INVALID_WORK_GROUP_SIZE),
                                    NAME(CL_INVALID_WORK_ITEM_SIZE),
                                    NAME(CL_INVALID_GLOBAL_OFFSET),
                                    NAME(CL_INVALID_EVENT_WAIT_LIST),
                                    NAME(CL_INVALID_EVENT),
                                    NAME(CL_INVALID_OPERATION),
                                    NAME(CL_INVALID_GL_OBJECT),
                                    NAME(CL_INVALID_BUFFER_SIZE),
                                    NAME(CL_INVALID_MIP_LEVEL),
                                    NAME(CL_INVALID_GLOBAL_WORK_SIZE),
                                    NAME(CL_INVALID_PROPERTY),
                                    NAME(CL_INVALID_IMAGE_DESCRIPTOR),
                                    NAME(CL_INVALID_COMPILER_OPTIONS),
                                    NAME(CL_INVALID_LINKER_OPTIONS),
                                    NAME(CL_INVALID_DEVICE_PARTITION_COUNT)};

#undef NAME

const char *hd_opencl_error_name(cl_int code) {
    enum { COUNT = sizeof names / sizeof *names };
    enum { PLATFORM_NOT_FOUND_KHR = -1001 }; /* the ICD loader's own, in cl_ext.h */
    if (code == PLATFORM_NOT_FOUND_KHR)
        return "CL_PLATFORM_NOT_FOUND_KHR";
    bool is_known = code < 0 && code > -COUNT && names[-code] != NULL;
    return is_known ? names[-code] : "an unknown error";
}

/* Drivers report what became of a kernel to those who wait for it; NVIDIA's has no other words than
   a number of its own for one that crashed. */
static bool is_lost(const char *function, cl_int code) {
    enum { NVIDIA_ILLEGAL_ACCESS = -9999 };
    bool waits = strcmp(function, "clFinish") == 0 || strcmp(function, "clWaitForEvents") == 0 ||
                 strcmp(function, "clEnqueueReadBuffer") == 0;
    switch (code) {
    case CL_DEVICE_NOT_AVAILABLE:
    case CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST:
    case CL_INVALID_COMMAND_QUEUE:
    case CL_INVALID_CONTEXT:
    case CL_INVALID_DEVICE:
    case NVIDIA_ILLEGAL_ACCESS:
        return true;
    case CL_OUT_OF_RESOURCES: /* elsewhere a lack of memory */
        return waits;
    default:
        return false;
    }
}

HdStatus hd_opencl_fail(HdError *error, const char *function, cl_int code) {
    char what[256];
    snprintf(what, sizeof what, "%s failed with %s (%d)", function, hd_opencl_error_name(code),
             (int)code);
    return is_lost(function, code) ? hd_fail_lost(error, what)
                                   : hd_fail(error, HD_FAILED, "%s", what);
}
