/* SPDX-License-Identifier: MIT */
/* Compiles only if src/device/cuda/api.h matches NVIDIA's headers. Built if a toolkit is installed;
   there is nothing to run. */
#include <cuda.h>
#include <nvrtc.h>

#include "device/cuda/api.h"

/* An enumeration is compatible with the integer type that the compiler chooses, so that ours
   match. */
#define CHECK(member_type, symbol)                                                                 \
    _Static_assert(_Generic(&symbol, member_type : 1, default : 0),                                \
                   #symbol " is not declared as in NVIDIA's header");

#define CHECK_DRIVER(function, version, parameters)                                                \
    CHECK(HdCuResult(*) parameters, function##version)
HD_CUDA_FUNCTIONS(CHECK_DRIVER)

#define CHECK_NVRTC(type, member, symbol, parameters) CHECK(type(*) parameters, symbol)
HD_NVRTC_FUNCTIONS(CHECK_NVRTC)

#define CHECK_VALUE(ours, theirs)                                                                  \
    _Static_assert((int)(ours) == (int)(theirs), #ours " is not " #theirs);
CHECK_VALUE(HD_CU_SUCCESS, CUDA_SUCCESS)
CHECK_VALUE(HD_CU_ERROR_OUT_OF_MEMORY, CUDA_ERROR_OUT_OF_MEMORY)
CHECK_VALUE(HD_CU_ERROR_DEVICE_UNAVAILABLE, CUDA_ERROR_DEVICE_UNAVAILABLE)
CHECK_VALUE(HD_CU_ERROR_NO_DEVICE, CUDA_ERROR_NO_DEVICE)
CHECK_VALUE(HD_CU_ERROR_UNKNOWN, CUDA_ERROR_UNKNOWN)
#define CHECK_LOSS(name, number) CHECK_VALUE(number, CUDA_ERROR_##name)
HD_CUDA_LOSSES(CHECK_LOSS)
CHECK_VALUE(HD_CU_DEVICE_CLOCK_KHZ, CU_DEVICE_ATTRIBUTE_CLOCK_RATE)
CHECK_VALUE(HD_CU_DEVICE_MULTIPROCESSOR_COUNT, CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT)
CHECK_VALUE(HD_CU_DEVICE_KERNEL_EXEC_TIMEOUT, CU_DEVICE_ATTRIBUTE_KERNEL_EXEC_TIMEOUT)
CHECK_VALUE(HD_CU_DEVICE_CAPABILITY_MAJOR, CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR)
CHECK_VALUE(HD_CU_DEVICE_CAPABILITY_MINOR, CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR)
CHECK_VALUE(HD_CU_FUNCTION_MAX_THREADS, CU_FUNC_ATTRIBUTE_MAX_THREADS_PER_BLOCK)
CHECK_VALUE(HD_CU_FUNCTION_LOCAL_BYTES, CU_FUNC_ATTRIBUTE_LOCAL_SIZE_BYTES)
CHECK_VALUE(HD_CU_FUNCTION_REGISTERS, CU_FUNC_ATTRIBUTE_NUM_REGS)
CHECK_VALUE(HD_CU_EVENT_BLOCKING_SYNC, CU_EVENT_BLOCKING_SYNC)
CHECK_VALUE(HD_CU_EVENT_DISABLE_TIMING, CU_EVENT_DISABLE_TIMING)
CHECK_VALUE(HD_CU_STREAM_NON_BLOCKING, CU_STREAM_NON_BLOCKING)
CHECK_VALUE(HD_CU_JIT_MAX_REGISTERS, CU_JIT_MAX_REGISTERS)
CHECK_VALUE(sizeof(HdNvrtcResult), sizeof(nvrtcResult))
CHECK_VALUE(0, NVRTC_SUCCESS)

int main(void) {
    return 0;
}
