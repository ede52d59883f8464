/* SPDX-License-Identifier: MIT */
#include "device/cuda/api.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "device/backend.h"
#include "system/dynamic_library.h"

static const char *advise_start(const HdCudaDriver *driver, HdCuResult code) {
    enum { BRANCH_590 = 13010 }; /* version of the first driver without cards before sm_75 */
    int version = 0;
    switch (code) {
    case HD_CU_ERROR_NO_DEVICE:
        return driver->cuDriverGetVersion(&version) == HD_CU_SUCCESS && version >= BRANCH_590
                   ? "; it is of branch 590 or newer, which drives no card before sm_75: the "
                     "branch "
                     "580 is the last for older ones, such as a GTX 1050"
                   : "; it finds no card that it supports, or CUDA_VISIBLE_DEVICES hides it";
    case HD_CU_ERROR_UNKNOWN:
        return "; after suspend, run: sudo rmmod nvidia_uvm && sudo modprobe "
               "nvidia_uvm, or restart";
    default:
        return "";
    }
}

HdStatus hd_cuda_load_driver(HdCudaDriver *driver, HdError *error) {
    static const HdLibrarySymbol symbols[] = {
#define SYMBOL(function, version, parameters)                                                      \
    {#function #version, offsetof(HdCudaDriver, function)},
        HD_CUDA_FUNCTIONS(SYMBOL)
#undef SYMBOL
    };
    memset(driver, 0, sizeof *driver);
    if (sizeof(void *) < sizeof(HdCuPointer)) /* a handle is passed to kernels as a pointer */
        return hd_fail(error, HD_UNAVAILABLE, "CUDA needs a program of 64 bits");
    void *library = hd_library_open("libcuda.so.1");
    if (!library)
        return hd_fail(error, HD_UNAVAILABLE, "the NVIDIA driver (libcuda.so.1) is not installed");
    const char *missing =
        hd_library_load(library, symbols, sizeof symbols / sizeof *symbols, driver);
    hd_library_close(library);
    if (missing)
        return hd_fail(error, HD_UNAVAILABLE,
                       "the NVIDIA driver is too old: libcuda.so.1 has no function %s", missing);
    HdCuResult code = driver->cuInit(0);
    if (code == HD_CU_SUCCESS)
        return HD_OK;
    return hd_fail(error, code == HD_CU_ERROR_NO_DEVICE ? HD_UNAVAILABLE : HD_FAILED,
                   "the NVIDIA driver does not start: cuInit failed with %s (%u)%s",
                   hd_cuda_error_name(driver, code), code, advise_start(driver, code));
}

const char *hd_cuda_error_name(const HdCudaDriver *driver, HdCuResult code) {
    const char *name = NULL;
    if (driver->cuGetErrorName(code, &name) != HD_CU_SUCCESS || !name)
        return "an unknown error";
    return name;
}

/* A device that another program uses exclusively is unavailable from the start, not lost. */
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
