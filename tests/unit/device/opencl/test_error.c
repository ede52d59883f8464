/* SPDX-License-Identifier: MIT */
/* What OpenCL's errors are called, and which of them mean that a device is lost. */
#include "device/opencl/error.h"

#include "device/backend.h"
#include "unit_test.h"

TEST(a_lost_device_is_told) {
    static const struct {
        const char *function;
        cl_int code;
        bool is_lost;
        const char *message;
    } cases[] = {
        {"clFinish", CL_OUT_OF_RESOURCES, true, "clFinish failed with CL_OUT_OF_RESOURCES (-5): "},
        {"clWaitForEvents", CL_OUT_OF_RESOURCES, true, ""},
        {"clEnqueueReadBuffer", CL_OUT_OF_RESOURCES, true, ""},
        /* A lack of memory, which may pass. */
        {"clEnqueueNDRangeKernel", CL_OUT_OF_RESOURCES, false, ""},
        {"clEnqueueNDRangeKernel", CL_DEVICE_NOT_AVAILABLE, true, ""},
        {"clWaitForEvents", CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, true, ""},
        {"clFlush", CL_INVALID_COMMAND_QUEUE, true, ""},
        {"clFlush", CL_INVALID_CONTEXT, true, ""},
        {"clFlush", CL_INVALID_DEVICE, true, ""},
        {"clFinish", -9999, true, "clFinish failed with an unknown error (-9999): "},
        {"clFinish", CL_INVALID_VALUE, false, "clFinish failed with CL_INVALID_VALUE (-30)"},
    };
    HdError error;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const HdStatus status = hd_opencl_fail(&error, cases[i].function, cases[i].code);
        expect_contains(error.message, cases[i].message);
        if (status != (cases[i].is_lost ? HD_UNAVAILABLE : HD_FAILED) ||
            hd_is_loss(&error) != cases[i].is_lost)
            fail_msg("it is not so that a loss is %d: %s", cases[i].is_lost, error.message);
    }
    hd_fail_lost(&error, "clFinish");
    error.status = HD_FAILED;
    assert_false(hd_is_loss(&error));
}

/* From the first to the last that OpenCL 1.2 has, but for those between its two groups. */
TEST(errors_have_their_names) {
    for (int code = -68; code <= 1; code++) {
        const bool is_none = code >= 0 || (code > CL_INVALID_VALUE && code < -19);
        const char *name = hd_opencl_error_name(code);
        if (strncmp(name, is_none ? "an unknown" : "CL_", 3) != 0)
            fail_msg("the error %d is called %s", code, name);
    }
    assert_string_equal(hd_opencl_error_name(CL_INVALID_ARG_INDEX), "CL_INVALID_ARG_INDEX");
    assert_string_equal(hd_opencl_error_name(-1001), "CL_PLATFORM_NOT_FOUND_KHR");
    assert_string_equal(hd_opencl_error_name(-2000000), "an unknown error");
}
