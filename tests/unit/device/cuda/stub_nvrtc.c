/* SPDX-License-Identifier: MIT */
/* Claims to be an NVRTC of the version at its file's name's end, "libnvrtc.so.12.3", for sm_7 and
   that of ten times the number before the point. Version 0 fails to report it, and minor number 99
   reports more architectures than there are. It compiles nothing. */
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "device/cuda/api.h"

HdNvrtcResult nvrtcVersion(int *major, int *minor) {
    static const char here;
    Dl_info own;
    if (dladdr(&here, &own) == 0 ||
        sscanf(strrchr(own.dli_fname, '/'), "/libnvrtc.so.%d.%d", major, minor) != 2)
        return 1;
    return *major > 0 ? 0 : 1;
}

HdNvrtcResult nvrtcGetNumSupportedArchs(int *count) {
    int major, minor;
    *count = nvrtcVersion(&major, &minor) == 0 && minor == 99 ? 257 : 2;
    return 0;
}

HdNvrtcResult nvrtcGetSupportedArchs(int *list) {
    int minor;
    list[0] = 7;
    nvrtcVersion(&list[1], &minor);
    list[1] *= 10;
    return 0;
}

/* Functions that nobody calls. */
#define STUB(symbol)                                                                               \
    HdNvrtcResult symbol(void);                                                                    \
    HdNvrtcResult symbol(void) {                                                                   \
        return 1;                                                                                  \
    }
STUB(nvrtcGetErrorString)
STUB(nvrtcCreateProgram)
STUB(nvrtcDestroyProgram)
STUB(nvrtcCompileProgram)
STUB(nvrtcGetProgramLogSize)
STUB(nvrtcGetProgramLog)
STUB(nvrtcGetPTXSize)
STUB(nvrtcGetPTX)
STUB(nvrtcGetCUBINSize)
STUB(nvrtcGetCUBIN)
