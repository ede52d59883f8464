/* SPDX-License-Identifier: MIT */
/* The used part of NVIDIA's driver interface and run-time compiler, declared here and loaded at run
   time, so that any machine can build it. If a toolkit is installed, tests/cuda_headers_check.c
   compares the declarations with NVIDIA's. */
#ifndef HD_DEVICE_CUDA_API_H
#define HD_DEVICE_CUDA_API_H

#include <stddef.h>

#include "base/error.h"

typedef unsigned int HdCuResult; /* enumerations have this width and sign */
typedef unsigned int HdCuAttribute;
typedef unsigned int HdCuJitOption;
typedef int HdCuDevice;
typedef unsigned long long HdCuPointer; /* address in device memory */
typedef struct CUctx_st *HdCuContext;
typedef struct CUmod_st *HdCuModule;
typedef struct CUfunc_st *HdCuFunction;
typedef struct CUstream_st *HdCuStream;
typedef struct CUevent_st *HdCuEvent;

/* X(name, number): errors after which no call of this program succeeds on the device. */
#define HD_CUDA_LOSSES(X)                                                                          \
    X(ECC_UNCORRECTABLE, 214)                                                                      \
    X(NVLINK_UNCORRECTABLE, 220)                                                                   \
    X(ILLEGAL_ADDRESS, 700)                                                                        \
    X(LAUNCH_TIMEOUT, 702)                                                                         \
    X(CONTEXT_IS_DESTROYED, 709)                                                                   \
    X(HARDWARE_STACK_ERROR, 714)                                                                   \
    X(ILLEGAL_INSTRUCTION, 715)                                                                    \
    X(MISALIGNED_ADDRESS, 716)                                                                     \
    X(INVALID_ADDRESS_SPACE, 717)                                                                  \
    X(INVALID_PC, 718)                                                                             \
    X(LAUNCH_FAILED, 719)

#define HD_CUDA_ERROR(name, number) HD_CU_ERROR_##name = (number),
enum { HD_CUDA_LOSSES(HD_CUDA_ERROR) };
#undef HD_CUDA_ERROR

enum {
    HD_CU_SUCCESS = 0,
    HD_CU_ERROR_OUT_OF_MEMORY = 2,
    HD_CU_ERROR_DEVICE_UNAVAILABLE = 46,
    HD_CU_ERROR_NO_DEVICE = 100,
    HD_CU_ERROR_UNKNOWN = 999,
    HD_CU_DEVICE_CLOCK_KHZ = 13,
    HD_CU_DEVICE_MULTIPROCESSOR_COUNT = 16,
    HD_CU_DEVICE_KERNEL_EXEC_TIMEOUT = 17,
    HD_CU_DEVICE_CAPABILITY_MAJOR = 75,
    HD_CU_DEVICE_CAPABILITY_MINOR = 76,
    HD_CU_FUNCTION_MAX_THREADS = 0,
    HD_CU_FUNCTION_LOCAL_BYTES = 3,
    HD_CU_FUNCTION_REGISTERS = 4,
    HD_CU_EVENT_BLOCKING_SYNC = 1,
    HD_CU_EVENT_DISABLE_TIMING = 2,
    HD_CU_STREAM_NON_BLOCKING = 1,
    HD_CU_JIT_MAX_REGISTERS = 0
};

/* X(function, version, parameters); all return HdCuResult. The version belongs to the symbol: the
   names without it are older functions with other types. */
#define HD_CUDA_FUNCTIONS(X)                                                                       \
    X(cuInit, , (unsigned int flags))                                                              \
    X(cuDriverGetVersion, , (int *version))                                                        \
    X(cuGetErrorName, , (HdCuResult code, const char **text))                                      \
    X(cuGetErrorString, , (HdCuResult code, const char **text))                                    \
    X(cuDeviceGetCount, , (int *count))                                                            \
    X(cuDeviceGet, , (HdCuDevice * device, int index))                                             \
    X(cuDeviceGetName, , (char *name, int capacity, HdCuDevice device))                            \
    X(cuDeviceGetAttribute, , (int *value, HdCuAttribute attribute, HdCuDevice device))            \
    X(cuDevicePrimaryCtxRetain, , (HdCuContext * context, HdCuDevice device))                      \
    X(cuDevicePrimaryCtxRelease, _v2, (HdCuDevice device))                                         \
    X(cuCtxSetCurrent, , (HdCuContext context))                                                    \
    X(cuModuleLoadDataEx, ,                                                                        \
      (HdCuModule * module, const void *image, unsigned int count, HdCuJitOption *options,         \
       void **values))                                                                             \
    X(cuModuleUnload, , (HdCuModule module))                                                       \
    X(cuModuleGetFunction, , (HdCuFunction * function, HdCuModule module, const char *name))       \
    X(cuModuleGetGlobal, _v2,                                                                      \
      (HdCuPointer * pointer, size_t * bytes, HdCuModule module, const char *name))                \
    X(cuFuncGetAttribute, , (int *value, HdCuAttribute attribute, HdCuFunction function))          \
    X(cuMemGetInfo, _v2, (size_t * available, size_t * total))                                     \
    X(cuMemAlloc, _v2, (HdCuPointer * pointer, size_t bytes))                                      \
    X(cuMemFree, _v2, (HdCuPointer pointer))                                                       \
    X(cuMemHostAlloc, , (void **data, size_t bytes, unsigned int flags))                           \
    X(cuMemFreeHost, , (void *data))                                                               \
    X(cuMemcpyHtoDAsync, _v2, (HdCuPointer to, const void *from, size_t bytes, HdCuStream stream)) \
    X(cuMemcpyDtoHAsync, _v2, (void *to, HdCuPointer from, size_t bytes, HdCuStream stream))       \
    X(cuCtxSynchronize, , (void))                                                                  \
    X(cuStreamCreate, , (HdCuStream * stream, unsigned int flags))                                 \
    X(cuStreamSynchronize, , (HdCuStream stream))                                                  \
    X(cuStreamWaitEvent, , (HdCuStream stream, HdCuEvent event, unsigned int flags))               \
    X(cuStreamDestroy, _v2, (HdCuStream stream))                                                   \
    X(cuLaunchKernel, ,                                                                            \
      (HdCuFunction function, unsigned int grid_x, unsigned int grid_y, unsigned int grid_z,       \
       unsigned int block_x, unsigned int block_y, unsigned int block_z,                           \
       unsigned int shared_bytes, HdCuStream stream, void **arguments, void **extra))              \
    X(cuEventCreate, , (HdCuEvent * event, unsigned int flags))                                    \
    X(cuEventRecord, , (HdCuEvent event, HdCuStream stream))                                       \
    X(cuEventSynchronize, , (HdCuEvent event))                                                     \
    X(cuEventElapsedTime, , (float *milliseconds, HdCuEvent start, HdCuEvent end))                 \
    X(cuEventDestroy, _v2, (HdCuEvent event))

#define HD_CUDA_MEMBER(function, version, parameters) HdCuResult(*function) parameters;
typedef struct HdCudaDriver {
    HD_CUDA_FUNCTIONS(HD_CUDA_MEMBER)
} HdCudaDriver;
#undef HD_CUDA_MEMBER

/* Loads and initialises the driver, which stays loaded. HD_UNAVAILABLE if it is missing or knows no
   device, HD_FAILED if it does not start; the message adds advice. */
HdStatus hd_cuda_load_driver(HdCudaDriver *driver, HdError *error);

/* Fails with the names of the function and of the error, and the driver's description.
   HD_UNAVAILABLE (hd_fail_lost) if the device is lost: `code` is in HD_CUDA_LOSSES, or is
   DEVICE_UNAVAILABLE from any function but cuDevicePrimaryCtxRetain. Otherwise HD_FAILED. `code`
   must be an error. */
HdStatus hd_cuda_fail(const HdCudaDriver *driver, const char *function, HdCuResult code,
                      HdError *error);

/* Returns the error's name: "CUDA_ERROR_OUT_OF_MEMORY". */
const char *hd_cuda_error_name(const HdCudaDriver *driver, HdCuResult code);

typedef unsigned int HdNvrtcResult;
typedef struct _nvrtcProgram *HdNvrtcProgram;

/* X(type, member, symbol, parameters) */
#define HD_NVRTC_FUNCTIONS(X)                                                                      \
    X(const char *, error_string, nvrtcGetErrorString, (HdNvrtcResult code))                       \
    X(HdNvrtcResult, version, nvrtcVersion, (int *major, int *minor))                              \
    X(HdNvrtcResult, arch_count, nvrtcGetNumSupportedArchs, (int *count))                          \
    X(HdNvrtcResult, list_archs, nvrtcGetSupportedArchs, (int *archs))                             \
    X(HdNvrtcResult, create_program, nvrtcCreateProgram,                                           \
      (HdNvrtcProgram * program, const char *source, const char *name, int header_count,           \
       const char *const *headers, const char *const *header_names))                               \
    X(HdNvrtcResult, destroy_program, nvrtcDestroyProgram, (HdNvrtcProgram * program))             \
    X(HdNvrtcResult, compile_program, nvrtcCompileProgram,                                         \
      (HdNvrtcProgram program, int option_count, const char *const *options))                      \
    X(HdNvrtcResult, log_size, nvrtcGetProgramLogSize, (HdNvrtcProgram program, size_t * size))    \
    X(HdNvrtcResult, log, nvrtcGetProgramLog, (HdNvrtcProgram program, char *log))                 \
    X(HdNvrtcResult, ptx_size, nvrtcGetPTXSize, (HdNvrtcProgram program, size_t * size))           \
    X(HdNvrtcResult, ptx, nvrtcGetPTX, (HdNvrtcProgram program, char *ptx))                        \
    X(HdNvrtcResult, cubin_size, nvrtcGetCUBINSize, (HdNvrtcProgram program, size_t * size))       \
    X(HdNvrtcResult, cubin, nvrtcGetCUBIN, (HdNvrtcProgram program, char *cubin))

#define HD_NVRTC_MEMBER(type, member, symbol, parameters) type(*member) parameters;
typedef struct HdNvrtcFunctions {
    HD_NVRTC_FUNCTIONS(HD_NVRTC_MEMBER)
} HdNvrtcFunctions;
#undef HD_NVRTC_MEMBER

#endif
