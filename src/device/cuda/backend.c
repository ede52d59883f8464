/* SPDX-License-Identifier: MIT */
/* CUDA as a GPU driver (device/gpu/driver.h). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/cuda/compile.h"
#include "device/gpu/driver.h"
#include "system/machine.h"

enum { BLOCK_THREADS = 128 };

/* Calls a function of the driver: CALL(device->driver, cuMemFree, (pointer), error). */
#define CALL(driver, function, arguments, error)                                                   \
    check(&(driver), (driver).function arguments, #function, error)

static HdStatus check(const HdCudaDriver *driver, HdCuResult code, const char *function,
                      HdError *error) {
    return code == HD_CU_SUCCESS ? HD_OK : hd_cuda_fail(driver, function, code, error);
}

/* ---- embedded PTX ---- */

bool hd_cuda_ptx_suits(int arch) {
    return hd_cuda_ptx_count > 0 && arch >= HD_CUDA_PTX_ARCH;
}

/* Pixels with an error bound have another layout; the probe has no pipelines and first hits. */
static bool does_all(const HdKernelShape *ptx, const HdKernelShape *shape) {
    return shape->is_probe == ptx->is_probe && !shape->rounds_by_fma &&
           (shape->is_probe ||
            (shape->wavefront == ptx->wavefront && (ptx->first_hits || !shape->first_hits))) &&
           shape->precision == ptx->precision && shape->math == ptx->math &&
           shape->group_size <= ptx->group_size && shape->needs.bounded == ptx->needs.bounded &&
           shape->needs.plane_bound <= ptx->needs.plane_bound &&
           shape->needs.depth_bound <= ptx->needs.depth_bound &&
           shape->needs.node_stack_bound <= ptx->needs.node_stack_bound;
}

const HdCudaPtx *hd_cuda_ptx_find(const HdKernelShape *shape, int arch) {
    for (int i = 0; i < hd_cuda_ptx_count && arch >= HD_CUDA_PTX_ARCH; i++)
        if (does_all(&hd_cuda_ptx[i].shape, shape))
            return &hd_cuda_ptx[i];
    return NULL;
}

/* ---- devices ---- */

static HdStatus query_attributes(HdDevice *device, const HdCudaDriver *driver, HdCuDevice handle,
                                 HdError *error) {
    int major = 0, minor = 0, khz = 0, has_timeout = 0;
    const struct {
        HdCuAttribute attribute;
        int *value;
    } list[] = {
        {HD_CU_DEVICE_CAPABILITY_MAJOR, &major},
        {HD_CU_DEVICE_CAPABILITY_MINOR, &minor},
        {HD_CU_DEVICE_MULTIPROCESSOR_COUNT, &device->compute_units},
        {HD_CU_DEVICE_CLOCK_KHZ, &khz},
        {HD_CU_DEVICE_KERNEL_EXEC_TIMEOUT, &has_timeout},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        HD_TRY(
            CALL(*driver, cuDeviceGetAttribute, (list[i].value, list[i].attribute, handle), error));
    device->nvidia_arch = 10 * major + minor;
    device->clock_mhz = khz / 1000;
    device->has_timeout = has_timeout != 0 || hd_display_may_be_there(HD_DISPLAY_FOLDER);
    return HD_OK;
}

static int query_driver_version(const HdCudaDriver *driver) {
    int version = 0;
    return driver->cuDriverGetVersion(&version) == HD_CU_SUCCESS ? version : 0;
}

/* Returns whether the embedded PTX is used. */
static bool takes_ptx(int arch) {
    return !hd_nvrtc_is_named() && hd_cuda_ptx_suits(arch);
}

static HdStatus query_device(HdDevice *device, const HdCudaDriver *driver, int index,
                             HdError *error) {
    HdCuDevice handle = 0;
    HD_TRY(CALL(*driver, cuDeviceGet, (&handle, index), error));
    HD_TRY(CALL(*driver, cuDeviceGetName, (device->name, (int)sizeof device->name, handle), error));
    HD_TRY(query_attributes(device, driver, handle, error));
    int arch = device->nvidia_arch, version = query_driver_version(driver);
    snprintf(device->driver, sizeof device->driver, "sm_%d, driver for CUDA %d.%d", arch,
             version / 1000, version % 1000 / 10);
    /* Fails without a compiler, so that a choice among devices can skip this one. */
    HdStatus status = hd_nvrtc_check(device->name, arch, version / 1000, error);
    return status != HD_OK && takes_ptx(arch) ? HD_OK : status;
}

/* A device that fails is listed with the reason; it does not hide the others. */
static void describe_device(HdDevice *device, const HdCudaDriver *driver, int index) {
    HdError error;
    memset(device, 0, sizeof *device);
    device->index = index;
    device->has_double = true;
    device->has_wide_atomics = true;
    snprintf(device->name, sizeof device->name, "CUDA device %d", index);
    if (query_device(device, driver, index, &error) != HD_OK)
        snprintf(device->unusable, sizeof device->unusable, "%.*s",
                 (int)sizeof device->unusable - 1, error.message);
}

static HdStatus cuda_enumerate(HdDevice *devices, int capacity, int *count, HdError *error) {
    HdCudaDriver driver;
    int available = 0;
    *count = 0;
    HD_TRY(hd_cuda_load_driver(&driver, error));
    HD_TRY(CALL(driver, cuDeviceGetCount, (&available), error));
    if (available < 1)
        return hd_fail(error, HD_UNAVAILABLE, "the NVIDIA driver knows no device");
    for (*count = 0; *count < available && *count < capacity; ++*count)
        describe_device(&devices[*count], &driver, *count);
    return HD_OK;
}

/* ---- an open device ---- */

typedef struct Device {
    HdCudaDriver driver;
    HdDevice is;
    HdCuDevice handle;
    HdCuContext context;
    HdCuStream stream; /* everything but copies to the host */
    HdCuStream copies; /* copies to the host, concurrent with the next frame's kernels */
    HdNvrtc nvrtc;     /* loaded after the first compilation */
    HdCudaCode code;   /* code of the module */
    HdCuModule module; /* NULL: none */
    HdCuFunction kernels[HD_KERNEL_COUNT];
    int registers, local_bytes; /* of the tracing kernel */
} Device;

/* The device's primary context, which others in this process may share. */
static HdStatus enter(void *state, HdError *error) {
    const Device *device = state;
    return CALL(device->driver, cuCtxSetCurrent, (device->context), error);
}

static HdStatus create_streams(Device *device, HdGpuFacts *facts, HdError *error) {
    size_t available = 0, total = 0;
    HD_TRY(enter(device, error));
    HD_TRY(
        CALL(device->driver, cuStreamCreate, (&device->stream, HD_CU_STREAM_NON_BLOCKING), error));
    HD_TRY(
        CALL(device->driver, cuStreamCreate, (&device->copies, HD_CU_STREAM_NON_BLOCKING), error));
    HD_TRY(CALL(device->driver, cuMemGetInfo, (&available, &total), error));
    facts->memory = total;
    return HD_OK;
}

static void close_device(void *state) {
    Device *device = state;
    HdError ignored;
    const bool is_entered = device->context && enter(device, &ignored) == HD_OK;
    if (is_entered && device->copies)
        device->driver.cuStreamDestroy(device->copies);
    if (is_entered && device->stream)
        device->driver.cuStreamDestroy(device->stream);
    if (device->context)
        device->driver.cuDevicePrimaryCtxRelease(device->handle);
    hd_nvrtc_close(&device->nvrtc);
    hd_cuda_code_free(&device->code);
}

static HdStatus open_device(void *state, const HdDevice *is, HdGpuFacts *facts, HdError *error) {
    Device *device = state;
    device->is = *is;
    HdStatus status = hd_cuda_load_driver(&device->driver, error);
    if (status == HD_OK)
        status = CALL(device->driver, cuDeviceGet, (&device->handle, is->index), error);
    if (status == HD_OK)
        status = CALL(device->driver, cuDevicePrimaryCtxRetain, (&device->context, device->handle),
                      error);
    if (status == HD_OK)
        status = create_streams(device, facts, error);
    if (status != HD_OK)
        close_device(device);
    return status;
}

/* ---- memory ---- */

static HdCuPointer pointer_to(const HdGpuMemory *memory) {
    return (HdCuPointer)(uintptr_t)memory->handle;
}

static HdCuResult allocate_at(const HdCudaDriver *driver, HdGpuMemory *memory, HdGpuPlace place,
                              size_t bytes) {
    HdCuPointer pointer = 0;
    if (place == HD_GPU_HOST) {
        HdCuResult code = driver->cuMemHostAlloc(&memory->data, bytes, 0);
        memory->handle = memory->data;
        return code;
    }
    HdCuResult code = driver->cuMemAlloc(&pointer, bytes);
    memory->handle = (void *)(uintptr_t)pointer; /* NOLINT(performance-no-int-to-ptr) */
    return code;
}

static HdStatus allocate(void *state, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                         HdGpuRefusal *refusal, HdError *error) {
    const HdCudaDriver *driver = &((const Device *)state)->driver;
    const char *function = place == HD_GPU_HOST ? "cuMemHostAlloc" : "cuMemAlloc";
    size_t available = 0, total = 0;
    HdCuResult code = allocate_at(driver, memory, place, bytes);
    if (code == HD_CU_SUCCESS) {
        memory->bytes = bytes;
        return HD_OK;
    }
    *memory = (HdGpuMemory){0};
    if (place != HD_GPU_HOST && code != HD_CU_ERROR_OUT_OF_MEMORY)
        return hd_cuda_fail(driver, function, code, error);
    driver->cuMemGetInfo(&available, &total);
    *refusal = (HdGpuRefusal){.lacks_memory = true,
                              .function = function,
                              .reason = hd_cuda_error_name(driver, code),
                              .knows_free = true,
                              .free = (double)available};
    return HD_FAILED;
}

static void release(void *state, HdGpuMemory *memory) {
    const Device *device = state;
    device->driver.cuCtxSynchronize();
    if (memory->data != NULL)
        device->driver.cuMemFreeHost(memory->data);
    else
        device->driver.cuMemFree(pointer_to(memory));
}

/* The host does not wait if the device reads the memory by itself. */
static HdStatus write_memory(void *state, const HdGpuMemory *memory, const void *data, size_t bytes,
                             HdGpuRefusal *refusal, HdError *error) {
    const Device *device = state;
    (void)refusal;
    return CALL(device->driver, cuMemcpyHtoDAsync,
                (pointer_to(memory), data, bytes, device->stream), error);
}

static HdStatus finish(void *state, HdError *error) {
    const Device *device = state;
    return CALL(device->driver, cuStreamSynchronize, (device->stream), error);
}

static HdStatus read_memory(void *state, const HdGpuMemory *memory, void *to, size_t bytes,
                            HdError *error) {
    const Device *device = state;
    HD_TRY(CALL(device->driver, cuMemcpyDtoHAsync, (to, pointer_to(memory), bytes, device->stream),
                error));
    return finish(state, error);
}

/* ---- kernels ---- */

static void write_options(void *state, const HdKernelShape *shape, char *text, size_t capacity) {
    const Device *device = state;
    hd_cuda_options(text, capacity, hd_cuda_target(shape, device->is.nvidia_arch), shape);
}

/* The machine code depends on NVRTC's version too, but to query it would need NVRTC. The entry
   names it, and kernels of any version have passed the test. Only a library that the user names
   counts. */
static void write_version(void *state, char *text, size_t capacity) {
    const char *named = getenv("HEDRON_NVRTC");
    (void)state;
    snprintf(text, capacity, "%s", named != NULL ? named : "");
}

static void unload(void *state) {
    Device *device = state;
    if (device->module)
        device->driver.cuModuleUnload(device->module);
    device->module = NULL;
    hd_cuda_code_free(&device->code);
}

static HdStatus query_kernel(const Device *device, HdCuAttribute attribute, int *value,
                             HdError *error) {
    return CALL(device->driver, cuFuncGetAttribute,
                (value, attribute, device->kernels[HD_KERNEL_TRACE]), error);
}

static bool find_constant(void *state, const char *name, HdGpuMemory *memory) {
    const Device *device = state;
    HdCuPointer pointer = 0;
    char symbol[64];
    snprintf(symbol, sizeof symbol, "hedron_constant_%s", name);
    if (device->driver.cuModuleGetGlobal(&pointer, &memory->bytes, device->module, symbol) !=
        HD_CU_SUCCESS)
        return false;
    memory->handle = (void *)(uintptr_t)pointer; /* NOLINT(performance-no-int-to-ptr) */
    memory->is_constant = true;
    return true;
}

static HdStatus get_kernels(Device *device, const HdKernelShape *shape, HdError *error) {
    for (int i = 0; i < HD_KERNEL_COUNT; i++) {
        const char *name = hd_kernel_name(shape, (HdKernel)i);
        if (name != NULL)
            HD_TRY(CALL(device->driver, cuModuleGetFunction,
                        (&device->kernels[i], device->module, name), error));
    }
    HD_TRY(query_kernel(device, HD_CU_FUNCTION_REGISTERS, &device->registers, error));
    return query_kernel(device, HD_CU_FUNCTION_LOCAL_BYTES, &device->local_bytes, error);
}

/* Compiles PTX to machine code by the driver, with the register limit that NVRTC would have. */
static HdCuResult load_image(const Device *device, const HdKernelShape *shape, const char *image,
                             HdCuModule *module) {
    HdCuJitOption option = HD_CU_JIT_MAX_REGISTERS;
    uintptr_t limit = (uintptr_t)shape->register_limit;
    void *value = (void *)limit; /* NOLINT(performance-no-int-to-ptr) */
    bool is_ptx = memcmp(image, "\177ELF", 4) != 0;
    return device->driver.cuModuleLoadDataEx(module, image, is_ptx ? 1 : 0, &option, &value);
}

static HdStatus load_module(Device *device, const HdKernelShape *shape, const char *image,
                            const char *maker, HdError *error) {
    HdCuModule module = NULL;
    HdCuResult result = load_image(device, shape, image, &module);
    int arch = device->is.nvidia_arch, major = query_driver_version(&device->driver) / 1000;
    if (result != HD_CU_SUCCESS)
        return hd_fail(error, HD_FAILED,
                       "the driver, of CUDA %d, does not load what %s compiled for sm_%d "
                       "(cuModuleLoadDataEx: %s); Python's package %s suits both",
                       major, maker, arch, hd_cuda_error_name(&device->driver, result),
                       hd_nvrtc_package(arch, major));
    device->module = module;
    return get_kernels(device, shape, error);
}

static HdStatus load(void *state, const HdKernelShape *shape, const char *options,
                     const unsigned char *binary, size_t size, const char *maker, HdError *error) {
    (void)options, (void)size;
    return load_module(state, shape, (const char *)binary, maker, error);
}

/* Loads the embedded PTX if no NVRTC can compile; the error says why. */
static HdStatus load_ptx(Device *device, const HdKernelShape *shape, char *maker, size_t capacity,
                         HdError *error) {
    const HdCudaPtx *ptx = hd_cuda_ptx_find(shape, device->is.nvidia_arch);
    size_t length = strlen(error->message);
    if (ptx == NULL) {
        snprintf(error->message + length, sizeof error->message - length,
                 "; the PTX in this program is for strict arithmetic, at most %d planes, depth %d, "
                 "and blocks of %d threads",
                 (int)HD_CUDA_PTX_PLANES, (int)HD_CUDA_PTX_DEPTH, (int)HD_CUDA_PTX_BLOCK);
        return HD_UNAVAILABLE;
    }
    snprintf(maker, capacity, "the driver from PTX of %s", ptx->maker);
    HdStatus status = load_module(device, shape, (const char *)ptx->text, maker, error);
    if (status == HD_FAILED)
        status = error->status = HD_UNAVAILABLE;
    return status;
}

static HdStatus compile(void *state, const HdKernelShape *shape, const char *options, char *maker,
                        size_t capacity, HdError *error) {
    Device *device = state;
    HdCudaTarget target = hd_cuda_target(shape, device->is.nvidia_arch);
    HdStatus status = HD_OK;
    if (!device->nvrtc.library)
        status = hd_nvrtc_open(&device->nvrtc, device->is.name, target.arch,
                               query_driver_version(&device->driver) / 1000, NULL, error);
    if (status == HD_UNAVAILABLE && !target.is_ptx && takes_ptx(target.arch))
        return load_ptx(device, shape, maker, capacity, error);
    HD_TRY(status);
    HD_TRY(hd_cuda_compile(&device->code, &device->nvrtc, target, options, error));
    int length = snprintf(maker, capacity, "NVRTC %d.%d", device->nvrtc.major, device->nvrtc.minor);
    if (target.is_ptx)
        snprintf(maker + length, capacity - (size_t)length, ", PTX for compute_%d", target.arch);
    return load_module(device, shape, device->code.image, maker, error);
}

static unsigned char *copy_binary(const void *state, size_t *size) {
    const Device *device = state;
    *size = device->code.size;
    if (*size == 0) /* the driver compiled it from PTX */
        return NULL;
    unsigned char *copy = malloc(*size);
    if (copy != NULL)
        memcpy(copy, device->code.image, *size);
    return copy;
}

/* Threads share the registers of a multiprocessor. */
static HdStatus query_max_threads(void *state, size_t *threads, HdError *error) {
    int most = 0;
    HD_TRY(query_kernel(state, HD_CU_FUNCTION_MAX_THREADS, &most, error));
    *threads = (size_t)most;
    return HD_OK;
}

/* ---- launches ---- */

/* Waiting for an event must not keep a core busy. */
static HdStatus record(const Device *device, void **event, HdCuStream stream, HdError *error) {
    HdCuEvent made = *event;
    if (made == NULL)
        HD_TRY(CALL(device->driver, cuEventCreate, (&made, HD_CU_EVENT_BLOCKING_SYNC), error));
    *event = made;
    return CALL(device->driver, cuEventRecord, (made, stream), error);
}

static void forget(void *state, HdGpuEvent *event) {
    const Device *device = state;
    if (event->begin)
        device->driver.cuEventDestroy(event->begin);
    if (event->end)
        device->driver.cuEventDestroy(event->end);
    *event = (HdGpuEvent){0};
}

static HdStatus launch(void *state, const HdGpuLaunch *launch, HdGpuEvent *event, HdError *error) {
    const Device *device = state;
    void *arguments[HD_GPU_MAX_ARGUMENTS];
    unsigned int blocks = (unsigned int)launch->groups, threads = (unsigned int)launch->group_size;
    for (int i = 0; i < launch->argument_count; i++)
        arguments[i] = (void *)launch->arguments[i].value;
    HD_TRY(event != NULL ? record(device, &event->begin, device->stream, error) : HD_OK);
    HD_TRY(CALL(device->driver, cuLaunchKernel,
                (device->kernels[launch->kernel], blocks, 1, 1, threads, 1, 1, 0, device->stream,
                 arguments, NULL),
                error));
    if (event != NULL)
        HD_TRY(record(device, &event->end, device->stream, error));
    return HD_OK;
}

static HdStatus copy_back(void *state, const HdGpuEvent *after, const HdGpuCopy *copies, int count,
                          HdGpuEvent *done, HdError *error) {
    const Device *device = state;
    HD_TRY(CALL(device->driver, cuStreamWaitEvent, (device->copies, after->end, 0), error));
    for (int i = 0; i < count; i++)
        HD_TRY(CALL(device->driver, cuMemcpyDtoHAsync,
                    (copies[i].to, pointer_to(copies[i].from), copies[i].bytes, device->copies),
                    error));
    return record(device, &done->end, device->copies, error);
}

static HdStatus wait_for(void *state, const HdGpuEvent *event, HdError *error) {
    const Device *device = state;
    return CALL(device->driver, cuEventSynchronize, (event->end), error);
}

static void drain(void *state) {
    const Device *device = state;
    device->driver.cuCtxSynchronize();
}

static HdStatus measure_seconds(void *state, const HdGpuEvent *from, const HdGpuEvent *to,
                                double *seconds, HdError *error) {
    const Device *device = state;
    float milliseconds = 0.0f;
    HD_TRY(CALL(device->driver, cuEventElapsedTime, (&milliseconds, from->begin, to->end), error));
    *seconds = 1e-3 * (double)milliseconds;
    return HD_OK;
}

static int describe(const void *state, const HdKernelShape *shape, int group_size,
                    const char *pipeline, const char *maker, char *text, int capacity) {
    const Device *device = state;
    int length = snprintf(text, (size_t)capacity, "sm_%d, 1 lane of %s, blocks of %d threads, %s",
                          device->is.nvidia_arch,
                          shape->precision == HD_PRECISION_DOUBLE ? "double" : "float", group_size,
                          pipeline);
    if (device->module && length > 0 && length < capacity)
        length += snprintf(text + length, (size_t)(capacity - length),
                           ", %d registers and %d bytes of local memory a thread, %s",
                           device->registers, device->local_bytes, maker);
    return length;
}

static const HdGpuDriver driver = {
    .groups = "blocks",
    .group_size = BLOCK_THREADS,
    .bytes = sizeof(Device),
    .source = hd_cuda_source,
    .source_size = &hd_cuda_source_size,
    .open = open_device,
    .close = close_device,
    .enter = enter,
    .allocate = allocate,
    .release = release,
    .write = write_memory,
    .read = read_memory,
    .write_options = write_options,
    .write_version = write_version,
    .compile = compile,
    .load = load,
    .binary = copy_binary,
    .unload = unload,
    .constant = find_constant,
    .max_threads = query_max_threads,
    .launch = launch,
    .copy_back = copy_back,
    .wait_for_launch = wait_for,
    .wait_for_copies = wait_for,
    .finish = finish,
    .drain = drain,
    .seconds = measure_seconds,
    .forget = forget,
    .describe = describe,
};

const HdBackend hd_backend_cuda = {
    .name = "cuda", .functions = &hd_gpu_functions, .driver = &driver, .enumerate = cuda_enumerate};
