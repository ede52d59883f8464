/* SPDX-License-Identifier: MIT */
#include "device/opencl/api.h"

#include <stddef.h>

#include "system/dynamic_library.h"

HdStatus hd_opencl_load_library(HdOpenclLibrary *cl, HdError *error) {
    static const HdLibrarySymbol symbols[] = {
#define SYMBOL(function) {#function, offsetof(HdOpenclLibrary, function)},
        HD_OPENCL_FUNCTIONS(SYMBOL)
#undef SYMBOL
    };
    void *library = hd_library_open_as_linked("libOpenCL.so.1");
    if (!library)
        return hd_fail(
            error, HD_UNAVAILABLE,
            "OpenCL's loader (libOpenCL.so.1) is not installed; a graphics driver or the "
            "package ocl-icd-libopencl1 brings it");
    const char *missing = hd_library_load(library, symbols, sizeof symbols / sizeof *symbols, cl);
    hd_library_close(library);
    if (missing)
        return hd_fail(error, HD_UNAVAILABLE,
                       "libOpenCL.so.1 is older than OpenCL 1.2: it has no function %s", missing);
    return HD_OK;
}
