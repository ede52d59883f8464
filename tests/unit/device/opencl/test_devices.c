/* SPDX-License-Identifier: MIT */
/* Interpretation of OpenCL drivers' reports on their devices and errors. */
#define _POSIX_C_SOURCE 200809L
#include "device/opencl/devices.h"

#include <stdlib.h>

#include "device/backend.h"
#include "unit_test.h"
#include "wrapped.h"

enum { CAPABILITY_MAJOR = 0x4000, CAPABILITY_MINOR = 0x4001, TIMEOUT = 0x4005 };

typedef struct Said {
    const char *name, *version, *extensions;
    cl_device_type type;
    bool is_usable, is_nvidias;
} Said;

static const Said said[] = {
    {"  a GPU ", "OpenCL 3.0 CUDA", "cl_nv_compiler_options cl_khr_int64_base_atomics",
     CL_DEVICE_TYPE_GPU, true, true},
    {"a CPU", "OpenCL 1.2", "cl_khr_fp64", CL_DEVICE_TYPE_CPU, true, false},
    {"an old one", "OpenCL 1.1", "", CL_DEVICE_TYPE_GPU, true, false},
    {"a new one", "OpenCL 2.0", "", CL_DEVICE_TYPE_GPU, true, false},
    {"nothing", "unknown", "", CL_DEVICE_TYPE_GPU, false, false},
};
enum { COUNT = sizeof said / sizeof *said };

/* ---- in place of the library's ---- */

static cl_int list_platforms(cl_uint capacity, cl_platform_id *platforms, cl_uint *count) {
    assert_true(capacity >= 2);
    platforms[0] = platforms[1] = (cl_platform_id)said;
    *count = 2;
    return CL_SUCCESS;
}

static cl_int answer(const void *from, size_t bytes, size_t size, void *value, size_t *needed) {
    if (needed != NULL)
        *needed = bytes;
    if (value != NULL && size < bytes)
        return CL_INVALID_VALUE;
    if (value != NULL)
        memcpy(value, from, bytes);
    return CL_SUCCESS;
}

static cl_int name_platform(cl_platform_id platform, cl_platform_info what, size_t size,
                            void *value, size_t *needed) {
    (void)platform;
    assert_int_equal(what, CL_PLATFORM_NAME);
    return answer("a platform", sizeof "a platform", size, value, needed);
}

/* The second platform has none. */
static cl_int list_devices(cl_platform_id platform, cl_device_type types, cl_uint capacity,
                           cl_device_id *devices, cl_uint *count) {
    static int calls;
    (void)platform, (void)types;
    if (calls++ % 2 == 1)
        return CL_DEVICE_NOT_FOUND;
    assert_true(capacity >= COUNT);
    for (int i = 0; i < COUNT; i++)
        devices[i] = (cl_device_id)&said[i];
    *count = COUNT;
    return CL_SUCCESS;
}

static cl_int describe(cl_device_id device, cl_device_info what, size_t size, void *value,
                       size_t *needed) {
    const Said *is = (const Said *)device;
    const struct {
        cl_device_info what;
        const char *text; /* NULL: the number */
        size_t bytes;
        cl_ulong number;
    } answers[] = {{CL_DEVICE_NAME, is->name, 0, 0},
                   {CL_DEVICE_VERSION, is->version, 0, 0},
                   {CL_DEVICE_EXTENSIONS, is->extensions, 0, 0},
                   {CL_DRIVER_VERSION, "5.6", 0, 0},
                   {CL_DEVICE_TYPE, NULL, sizeof(cl_ulong), is->type},
                   {CL_DEVICE_GLOBAL_MEM_SIZE, NULL, sizeof(cl_ulong), 5000000000},
                   {CL_DEVICE_AVAILABLE, NULL, sizeof(cl_uint), is->is_usable},
                   {CL_DEVICE_COMPILER_AVAILABLE, NULL, sizeof(cl_uint), is->is_usable},
                   {CL_DEVICE_ENDIAN_LITTLE, NULL, sizeof(cl_uint), is->is_usable},
                   {CL_DEVICE_MAX_COMPUTE_UNITS, NULL, sizeof(cl_uint), 12},
                   {CAPABILITY_MAJOR, NULL, sizeof(cl_uint), 7},
                   {CAPABILITY_MINOR, NULL, sizeof(cl_uint), 5},
                   {is->is_nvidias ? TIMEOUT : 0, NULL, sizeof(cl_uint), 0}};
    for (size_t i = 0; i < sizeof answers / sizeof *answers; i++)
        if (answers[i].what == what)
            return answers[i].text != NULL
                       ? answer(answers[i].text, strlen(answers[i].text) + 1, size, value, needed)
                       : answer(&answers[i].number, answers[i].bytes, size, value, needed);
    return CL_INVALID_VALUE;
}

static const HdOpenclLibrary library = {.clGetPlatformIDs = list_platforms,
                                        .clGetPlatformInfo = name_platform,
                                        .clGetDeviceIDs = list_devices,
                                        .clGetDeviceInfo = describe};

static HdStatus load_library(HdOpenclLibrary *cl, HdError *error) {
    (void)error;
    *cl = library;
    return HD_OK;
}

REPLACE(hd_opencl_load_library, load_library)

static void hide_displays(void) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
}

AT_START(hide_displays)

static HdDevice devices[HD_MAX_DEVICES];
static HdError error;

TEST(devices_and_unsupported_reasons_are_described) {
    static const char all[] = "it is not available, its driver has no compiler, it is older than "
                              "OpenCL 1.2, it is not little-endian";
    static const char *const unsupported_reasons[COUNT] = {"", "", "it is older than OpenCL 1.2",
                                                           "", all};
    int count;
    assert_int_equal(hd_opencl_enumerate(devices, HD_MAX_DEVICES, &count, &error), HD_OK);
    assert_int_equal(count, COUNT);
    for (int i = 0; i < COUNT; i++)
        assert_string_equal(devices[i].unusable, unsupported_reasons[i]);
    assert_string_equal(devices[0].name, "a GPU");
    assert_string_equal(devices[0].driver, "a platform, OpenCL 3.0 CUDA, driver 5.6");
    assert_int_equal(devices[0].nvidia_arch, 75);
    assert_int_equal(devices[0].compute_units, 12);
    assert_true(devices[0].has_wide_atomics && !devices[0].is_cpu && !devices[0].has_double);
    assert_int_equal(devices[1].nvidia_arch, 0);
    assert_true(devices[1].is_cpu && !devices[1].has_wide_atomics && !devices[1].has_timeout);
    assert_true(devices[2].has_timeout); /* nobody reports it */
    assert_int_equal(hd_opencl_enumerate(devices, 2, &count, &error), HD_OK);
    assert_int_equal(count, 2);
}

TEST(devices_are_found_by_number) {
    cl_device_id device;
    HdGpuFacts facts;
    assert_int_equal(hd_opencl_find(&library, &device, 1, &facts, &error), HD_OK);
    assert_ptr_equal(device, &said[1]);
    assert_int_equal(facts.memory, 5000000000);
    assert_int_equal(facts.at_once, 0); /* unknown */
    assert_int_equal(hd_opencl_find(&library, &device, COUNT, &facts, &error), HD_UNAVAILABLE);
    assert_string_equal(error.message, "there is no device 5, only 0 to 4");
    assert_int_equal(hd_opencl_find(&library, &device, -1, &facts, &error), HD_UNAVAILABLE);
}

/* ---- errors ---- */

TEST(pocl_without_a_cache_folder_is_explained) {
    static const char pocl[] = "Portable Computing Language, OpenCL 3.0";
    static char fault[HD_POCL_FAULT_SIZE];
    setenv("POCL_CACHE_DIR", "/proc/x", 1);
    assert_false(hd_pocl_lacks_cache("a platform", fault));
    assert_true(hd_pocl_lacks_cache(pocl, fault));
    expect_contains(fault, "its cache folder /proc/x, expected POCL_CACHE_DIR");
    setenv("POCL_CACHE_DIR", "/tmp", 1);
    assert_false(hd_pocl_lacks_cache(pocl, fault));
    unsetenv("POCL_CACHE_DIR");
    setenv("XDG_CACHE_HOME", "/proc", 1);
    assert_true(hd_pocl_lacks_cache(pocl, fault));
    expect_contains(fault, " /proc/pocl/kcache, ");
    unsetenv("XDG_CACHE_HOME");
    setenv("HOME", "/dev/null", 1);
    assert_true(hd_pocl_lacks_cache(pocl, fault));
    expect_contains(fault, " /dev/null/.cache/pocl/kcache, ");
}

TEST(a_lost_device_is_reported) {
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

/* From the first to the last of OpenCL 1.2, except those between its two groups. */
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
