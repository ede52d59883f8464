/* SPDX-License-Identifier: MIT */
#include "device/cuda/api.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "device/backend.h"
#include "system/dynamic_library.h"

static HdStatus load_functions(HdCudaDriver *driver, void *library, HdError *error) {
    static const HdLibrarySymbol symbols[] = {
#define SYMBOL(function, version, parameters)                                                      \
    {#function #version, offsetof(HdCudaDriver, function)},
        HD_CUDA_FUNCTIONS(SYMBOL)
#undef SYMBOL
    };
    const char *missing =
        hd_library_load(library, symbols, sizeof symbols / sizeof *symbols, driver);
    if (missing)
        return hd_fail(error, HD_UNAVAILABLE,
                       "the NVIDIA driver is too old: libcuda.so.1 has no function %s", missing);
    return HD_OK;
}

HdStatus hd_cuda_load_driver(HdCudaDriver *driver, HdError *error) {
    memset(driver, 0, sizeof *driver);
    void *library = hd_library_open("libcuda.so.1");
    if (!library)
        return hd_fail(error, HD_UNAVAILABLE, "the NVIDIA driver (libcuda.so.1) is not installed");
    HdStatus status = load_functions(driver, library, error);
    hd_library_close(library);
    if (status != HD_OK)
        return status;
    HdCuResult code = driver->cuInit(0);
    if (code != HD_CU_SUCCESS)
        return hd_fail(error, HD_UNAVAILABLE,
                       "the NVIDIA driver does not start: cuInit failed with %s",
                       hd_cuda_error_name(driver, code));
    return HD_OK;
}

const char *hd_cuda_error_name(const HdCudaDriver *driver, HdCuResult code) {
    const char *name = NULL;
    if (driver->cuGetErrorName(code, &name) != HD_CU_SUCCESS || !name)
        return "an unknown error";
    return name;
}

/* A device that another program has for itself alone is unavailable from the begin. */
static bool is_lost(const char *function, HdCuResult code) {
    switch (code) {
    case HD_CU_ERROR_DEVICE_UNAVAILABLE:
        return strcmp(function, "cuDevicePrimaryCtxRetain") != 0;
#define CASE(name, number) case HD_CU_ERROR_##name:
        HD_CUDA_LOSSES(CASE)
#undef CASE
        return true;
    default:
        return false;
    }
}

HdStatus hd_cuda_fail(const HdCudaDriver *driver, const char *function, HdCuResult code,
                      HdError *error) {
    const char *text = NULL;
    char what[512];
    if (driver->cuGetErrorString(code, &text) != HD_CU_SUCCESS || !text)
        text = "no description";
    snprintf(what, sizeof what, "%s failed with %s (%u: %s)", function,
             hd_cuda_error_name(driver, code), code, text);
    return is_lost(function, code) ? hd_fail_lost(error, what)
                                   : hd_fail(error, HD_FAILED, "%s", what);
}
