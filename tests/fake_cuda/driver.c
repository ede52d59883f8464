/* SPDX-License-Identifier: MIT */
/* Stands in for NVIDIA's driver (libcuda.so.1), so that the CUDA backend can be tested without a
   device, up to what its kernels render: a device of sm_61 whose memory is the host's, with streams
   (streams.c), and much that does nothing (others.c). FAKE_CUDA_REFUSES is the number of modules
   that it does not load at first; FAKE_CUDA_MEMORY is how many
   bytes of memory it tells of. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/cuda/api.h"

/* A handle must point somewhere. */
static char anything;

#define DECLARE(member, symbol, parameters) HdCuResult symbol parameters;
HD_CUDA_FUNCTIONS(DECLARE)

HdCuResult cuDriverGetVersion(int *version) {
    *version = 12080;
    return HD_CU_SUCCESS;
}

HdCuResult cuGetErrorName(HdCuResult code, const char **text) {
    *text = code == HD_CU_SUCCESS ? "CUDA_SUCCESS" : "CUDA_ERROR_FAKE";
    return HD_CU_SUCCESS;
}

HdCuResult cuGetErrorString(HdCuResult code, const char **text) {
    return cuGetErrorName(code, text);
}

HdCuResult cuDeviceGetCount(int *count) {
    *count = 1;
    return HD_CU_SUCCESS;
}

HdCuResult cuDeviceGet(HdCuDevice *device, int index) {
    *device = index;
    return HD_CU_SUCCESS;
}

HdCuResult cuDeviceGetName(char *name, int capacity, HdCuDevice device) {
    snprintf(name, (size_t)capacity, "Fake device %d", device);
    return HD_CU_SUCCESS;
}

HdCuResult cuDeviceGetAttribute(int *value, HdCuAttribute attribute, HdCuDevice device) {
    (void)device;
    *value = 1000;
    if (attribute == HD_CU_DEVICE_MULTIPROCESSOR_COUNT)
        *value = 200;
    if (attribute == HD_CU_DEVICE_CAPABILITY_MAJOR)
        *value = 6;
    if (attribute == HD_CU_DEVICE_CAPABILITY_MINOR)
        *value = 1;
    return HD_CU_SUCCESS;
}

HdCuResult cuDevicePrimaryCtxRetain(HdCuContext *context, HdCuDevice device) {
    (void)device;
    *context = (HdCuContext)(void *)&anything;
    return HD_CU_SUCCESS;
}

/* Machine code is an ELF file. */
HdCuResult cuModuleLoadData(HdCuModule *module, const void *image) {
    static int count;
    const char *refused = getenv("FAKE_CUDA_REFUSES");
    if (memcmp(image, "\177ELF", 4) != 0 || (refused != NULL && count++ < atoi(refused)))
        return HD_CU_ERROR_OUT_OF_MEMORY;
    *module = (HdCuModule)(void *)&anything;
    return HD_CU_SUCCESS;
}

HdCuResult cuFuncGetAttribute(int *value, HdCuAttribute attribute, HdCuFunction function) {
    (void)function;
    *value = attribute == HD_CU_FUNCTION_MAX_THREADS ? 1024 : 64;
    return HD_CU_SUCCESS;
}

HdCuResult cuMemGetInfo_v2(size_t *available, size_t *total) {
    const char *memory = getenv("FAKE_CUDA_MEMORY");
    *available = *total = memory != NULL ? (size_t)atoll(memory) : 0;
    return HD_CU_SUCCESS;
}
