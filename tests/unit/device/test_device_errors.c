/* SPDX-License-Identifier: MIT */
/* What the errors of drivers are called, and which of them mean that a device is lost. */
#include <stdbool.h>

#include "device/backend.h"
#include "device/cuda/api.h"
#include "device/opencl/error.h"
#include "unit_test.h"

static HdCuResult name_error(HdCuResult code, const char **text) {
    *text = code == HD_CU_ERROR_OUT_OF_MEMORY ? "NO_ROOM" : "OTHER";
    return HD_CU_SUCCESS;
}

static HdCuResult know_nothing(HdCuResult code, const char **text) {
    (void)code;
    (void)text;
    return 1;
}

static const HdCudaDriver driver = {.cuGetErrorName = name_error, .cuGetErrorString = name_error};

static bool is_lost(const HdError *error) {
    return error->status == HD_UNAVAILABLE && hd_is_loss(error);
}

TEST(cuda_errors_have_their_names) {
    const HdCudaDriver silent = {.cuGetErrorName = know_nothing, .cuGetErrorString = know_nothing};
    HdError error;
    assert_int_equal(hd_cuda_fail(&driver, "cuMemAlloc", HD_CU_ERROR_OUT_OF_MEMORY, &error),
                     HD_FAILED);
    assert_string_equal(error.message, "cuMemAlloc failed with NO_ROOM (2: NO_ROOM)");
    hd_cuda_fail(&silent, "cuInit", 999, &error);
    assert_string_equal(error.message, "cuInit failed with an unknown error (999: no description)");
}

TEST(cuda_tells_a_lost_device) {
    static const HdCuResult fatal[] = {46, 214, 220, 700, 702, 709, 714, 715, 716, 717, 718, 719};
    static const HdCuResult others[] = {1, 2, 3, 101, 201, 701, 999};
    HdError error;
    for (size_t i = 0; i < sizeof fatal / sizeof *fatal; i++) {
        hd_cuda_fail(&driver, "cuEventSynchronize", fatal[i], &error);
        assert_true(is_lost(&error));
    }
    hd_cuda_fail(&driver, "cuCtxSynchronize", fatal[0], &error);
    assert_true(is_lost(&error));
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        hd_cuda_fail(&driver, "cuEventSynchronize", others[i], &error);
        assert_false(is_lost(&error));
    }
}

TEST(opencl_tells_a_lost_device) {
    HdError error;
    hd_opencl_fail(&error, "clFinish", CL_OUT_OF_RESOURCES);
    assert_non_null(strstr(error.message, "clFinish failed with CL_OUT_OF_RESOURCES (-5)"));
    assert_true(is_lost(&error));
    hd_opencl_fail(&error, "clWaitForEvents", CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST);
    assert_true(is_lost(&error));
    hd_opencl_fail(&error, "clEnqueueReadBuffer", CL_INVALID_COMMAND_QUEUE);
    assert_true(is_lost(&error));
    hd_opencl_fail(&error, "clEnqueueNDRangeKernel", CL_DEVICE_NOT_AVAILABLE);
    assert_true(is_lost(&error));
    /* A lack of memory, which may pass. */
    hd_opencl_fail(&error, "clEnqueueNDRangeKernel", CL_OUT_OF_RESOURCES);
    assert_false(is_lost(&error));
    hd_opencl_fail(&error, "clFinish", CL_INVALID_VALUE);
    assert_string_equal(error.message, "clFinish failed with CL_INVALID_VALUE (-30)");
}

/* From the first to the last that OpenCL 1.2 has, but for those between its two groups. */
TEST(opencl_errors_have_their_names) {
    for (int code = -68; code <= 1; code++) {
        const bool is_none = code >= 0 || (code > CL_INVALID_VALUE && code < -19);
        const char *name = hd_opencl_error_name(code);
        if (strncmp(name, is_none ? "an unknown" : "CL_", 3) != 0)
            fail_msg("the error %d is called %s", code, name);
    }
    assert_string_equal(hd_opencl_error_name(CL_INVALID_ARG_INDEX), "CL_INVALID_ARG_INDEX");
    assert_string_equal(hd_opencl_error_name(-1001), "CL_PLATFORM_NOT_FOUND_KHR");
    assert_string_equal(hd_opencl_error_name(-1002), "an unknown error");
    assert_string_equal(hd_opencl_error_name(-2000000), "an unknown error");
}
