/* SPDX-License-Identifier: MIT */
/* Stands in for NVIDIA's driver (libcuda.so.1), to test the CUDA backend without a device: it runs
   the fake NVRTC's modules (nvrtc.c) on one processor. FAKE_CUDA_DRIVER is the version of CUDA that
   it reports, FAKE_CUDA_CAPABILITY its device's, 61 for sm_61; with FAKE_CUDA_TIMEOUT=0 it ends no
   long kernels. */
#include <stdio.h>

#include "fake.h"

HdCuResult cuInit(unsigned int flags) {
    FAKE_CALL_ANYWHERE(cuInit);
    return flags == 0 ? HD_CU_SUCCESS : FAKE_INVALID_VALUE;
}

HdCuResult cuDriverGetVersion(int *version) {
    FAKE_CALL_ANYWHERE(cuDriverGetVersion);
    *version = (int)fake_number("FAKE_CUDA_DRIVER", 12080);
    return HD_CU_SUCCESS;
}

/* The errors that tests cause. */
static const struct {
    HdCuResult code;
    const char *name, *text;
} errors[] = {
    {HD_CU_ERROR_OUT_OF_MEMORY, "CUDA_ERROR_OUT_OF_MEMORY", "out of memory"},
    {HD_CU_ERROR_NO_DEVICE, "CUDA_ERROR_NO_DEVICE", "no CUDA-capable device is detected"},
    {HD_CU_ERROR_UNKNOWN, "CUDA_ERROR_UNKNOWN", "unknown error"},
    {(HdCuResult)FAKE_NO_BINARY_FOR_GPU, "CUDA_ERROR_NO_BINARY_FOR_GPU",
     "no kernel image is available for execution on the device"},
    {0, "CUDA_ERROR_FAKE", "told to fail"},
};

static int find_error(HdCuResult code) {
    int i = 0;
    while (errors[i].code != 0 && errors[i].code != code)
        i++;
    return i;
}

HdCuResult cuGetErrorName(HdCuResult code, const char **text) {
    *text = errors[find_error(code)].name;
    return HD_CU_SUCCESS;
}

HdCuResult cuGetErrorString(HdCuResult code, const char **text) {
    *text = errors[find_error(code)].text;
    return HD_CU_SUCCESS;
}

HdCuResult cuDeviceGetCount(int *count) {
    FAKE_CALL_ANYWHERE(cuDeviceGetCount);
    *count = 1;
    return HD_CU_SUCCESS;
}

HdCuResult cuDeviceGet(HdCuDevice *device, int index) {
    FAKE_CALL_ANYWHERE(cuDeviceGet);
    *device = index;
    return index == 0 ? HD_CU_SUCCESS : fake_misuse(FAKE_INVALID_VALUE, "there is 1 device");
}

HdCuResult cuDeviceGetName(char *name, int capacity, HdCuDevice device) {
    FAKE_CALL_ANYWHERE(cuDeviceGetName);
    snprintf(name, (size_t)capacity, "Fake device %d", device);
    return HD_CU_SUCCESS;
}

HdCuResult cuDeviceGetAttribute(int *value, HdCuAttribute attribute, HdCuDevice device) {
    (void)device;
    FAKE_CALL_ANYWHERE(cuDeviceGetAttribute);
    switch (attribute) {
    case HD_CU_DEVICE_CLOCK_KHZ:
        *value = 1000;
        return HD_CU_SUCCESS;
    case HD_CU_DEVICE_MULTIPROCESSOR_COUNT:
        *value = (int)fake_number("FAKE_CUDA_UNITS", 200);
        return HD_CU_SUCCESS;
    case HD_CU_DEVICE_KERNEL_EXEC_TIMEOUT:
        *value = (int)fake_number("FAKE_CUDA_TIMEOUT", 1.0);
        return HD_CU_SUCCESS;
    case HD_CU_DEVICE_CAPABILITY_MAJOR:
        *value = fake_capability() / 10;
        return HD_CU_SUCCESS;
    case HD_CU_DEVICE_CAPABILITY_MINOR:
        *value = fake_capability() % 10;
        return HD_CU_SUCCESS;
    default:
        return fake_misuse(FAKE_INVALID_VALUE, "attribute %u of a device", attribute);
    }
}
