/* SPDX-License-Identifier: MIT */
/* OpenCL as a driver of GPUs and CPUs (device/gpu/driver.h). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "device/gpu/driver.h"
#include "device/opencl/api.h"
#include "device/opencl/devices.h"

enum { GPU_GROUP_SIZE = 64, OPTIONS_LENGTH = 1024 };

typedef struct Device {
    HdOpenclLibrary cl;
    cl_device_id id;
    HdDevice is;
    cl_ulong at_once; /* bytes of a buffer, at most */
    cl_context context;
    cl_command_queue queue;  /* everything but copies to the host */
    cl_command_queue copies; /* copies to the host, concurrent with the next frame's kernels */
    cl_program program;      /* NULL: none */
    cl_kernel kernels[HD_KERNEL_COUNT];
} Device;

static HdStatus check(cl_int code, const char *function, HdError *error) {
    return code == CL_SUCCESS ? HD_OK : hd_opencl_fail(error, function, code);
}

/* ---- open and close ---- */

static void close_device(void *state) {
    Device *device = state;
    if (device->copies)
        device->cl.clReleaseCommandQueue(device->copies);
    if (device->queue)
        device->cl.clReleaseCommandQueue(device->queue);
    if (device->context)
        device->cl.clReleaseContext(device->context);
}

static HdStatus create_queues(Device *device, HdError *error) {
    cl_int code;
    device->context = device->cl.clCreateContext(NULL, 1, &device->id, NULL, NULL, &code);
    if (!device->context)
        return hd_opencl_fail(error, "clCreateContext", code);
    cl_context context = device->context;
    device->queue =
        device->cl.clCreateCommandQueue(context, device->id, CL_QUEUE_PROFILING_ENABLE, &code);
    if (!device->queue)
        device->queue = device->cl.clCreateCommandQueue(context, device->id, 0, &code);
    if (device->queue)
        device->copies = device->cl.clCreateCommandQueue(context, device->id, 0, &code);
    return device->copies ? HD_OK : hd_opencl_fail(error, "clCreateCommandQueue", code);
}

static HdStatus open_device(void *state, const HdDevice *is, HdGpuFacts *facts, HdError *error) {
    Device *device = state;
    device->is = *is;
    HD_TRY(hd_opencl_load_library(&device->cl, error));
    HdStatus status = hd_opencl_find(&device->cl, &device->id, is->index, facts, error);
    device->at_once = facts->at_once;
    if (status == HD_OK)
        status = create_queues(device, error);
    if (status != HD_OK)
        close_device(device);
    return status;
}

/* ---- memory ---- */

static HdStatus check_memory(cl_int code, const char *function, HdGpuRefusal *refusal,
                             HdError *error) {
    if (code != CL_MEM_OBJECT_ALLOCATION_FAILURE && code != CL_OUT_OF_RESOURCES &&
        code != CL_OUT_OF_HOST_MEMORY)
        return check(code, function, error);
    *refusal = (HdGpuRefusal){
        .lacks_memory = true, .function = function, .reason = hd_opencl_error_name(code)};
    return HD_FAILED;
}

static void release(void *state, HdGpuMemory *memory) {
    Device *device = state;
    if (memory->data &&
        device->cl.clEnqueueUnmapMemObject(device->copies, memory->handle, memory->data, 0, NULL,
                                           NULL) == CL_SUCCESS)
        device->cl.clFinish(device->copies);
    device->cl.clReleaseMemObject(memory->handle);
}

static HdStatus map(Device *device, HdGpuMemory *memory, HdError *error) {
    cl_int code;
    memory->data = device->cl.clEnqueueMapBuffer(device->copies, memory->handle, CL_TRUE,
                                                 CL_MAP_READ | CL_MAP_WRITE, 0, memory->bytes, 0,
                                                 NULL, NULL, &code);
    if (memory->data)
        return HD_OK;
    release(device, memory);
    memory->handle = NULL;
    return hd_opencl_fail(error, "clEnqueueMapBuffer", code);
}

static HdStatus allocate(void *state, HdGpuMemory *memory, HdGpuPlace place, size_t bytes,
                         HdGpuRefusal *refusal, HdError *error) {
    Device *device = state;
    cl_int code = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    cl_mem_flags flags = CL_MEM_READ_WRITE | (place == HD_GPU_HOST ? CL_MEM_ALLOC_HOST_PTR : 0);
    if (place == HD_GPU_DEVICE_AT_ONCE)
        HD_TRY(check(device->cl.clFinish(device->queue), "clFinish", error));
    if (device->at_once == 0 || bytes <= device->at_once)
        memory->handle = device->cl.clCreateBuffer(device->context, flags, bytes, NULL, &code);
    memory->bytes = bytes;
    if (code == CL_SUCCESS && place == HD_GPU_DEVICE_AT_ONCE)
        code = device->cl.clEnqueueWriteBuffer(
            device->queue, memory->handle, CL_TRUE, 0, 1, "", 0, NULL,
            NULL); /* drivers may allocate it only on first use */
    if (code == CL_SUCCESS && place == HD_GPU_HOST)
        return map(device, memory, error);
    return check_memory(code, "clCreateBuffer", refusal, error);
}

static HdStatus write_memory(void *state, const HdGpuMemory *memory, const void *data, size_t bytes,
                             HdGpuRefusal *refusal, HdError *error) {
    Device *device = state;
    cl_int code = device->cl.clEnqueueWriteBuffer(device->queue, memory->handle, CL_FALSE, 0, bytes,
                                                  data, 0, NULL, NULL);
    return check_memory(code, "clEnqueueWriteBuffer", refusal, error);
}

static HdStatus read_memory(void *state, const HdGpuMemory *memory, void *to, size_t bytes,
                            HdError *error) {
    Device *device = state;
    return check(device->cl.clEnqueueReadBuffer(device->queue, memory->handle, CL_TRUE, 0, bytes,
                                                to, 0, NULL, NULL),
                 "clEnqueueReadBuffer", error);
}

/* ---- kernels ---- */

/* Not every driver knows the option; the probe measures the division (verify/probe.h). */
static const char rounding[] = " -cl-fp32-correctly-rounded-divide-sqrt";

static void write_options(void *state, const HdKernelShape *shape, char *text, size_t capacity) {
    (void)state;
    const char *math = shape->math == HD_MATH_FAST ? " -cl-fast-relaxed-math"
                       : shape->rounds_by_fma      ? ""
                                                   : rounding;
    char defines[HD_KERNEL_DEFINES_SIZE], limit[40] = "";
    hd_kernel_defines(shape, defines);
    if (shape->register_limit > 0)
        snprintf(limit, sizeof limit, " -cl-nv-maxrregcount=%d", shape->register_limit);
    snprintf(text, capacity, "-cl-std=CL1.2%s%s%s", math, defines, limit);
}

/* Writes what the device's name and driver do not state, such as the LLVM version of PoCL. */
static void write_version(void *state, char *text, size_t capacity) {
    const Device *device = state;
    cl_platform_id platform;
    text[0] = '\0';
    if (device->cl.clGetDeviceInfo(device->id, CL_DEVICE_PLATFORM, sizeof(cl_platform_id),
                                   &platform, NULL) == CL_SUCCESS)
        device->cl.clGetPlatformInfo(platform, CL_PLATFORM_VERSION, capacity, text, NULL);
}

static void unload(void *state) {
    Device *device = state;
    for (int i = 0; i < HD_KERNEL_COUNT; i++) {
        if (device->kernels[i])
            device->cl.clReleaseKernel(device->kernels[i]);
        device->kernels[i] = NULL;
    }
    if (device->program)
        device->cl.clReleaseProgram(device->program);
    device->program = NULL;
}

static HdStatus create_kernels(Device *device, const HdKernelShape *shape, HdError *error) {
    cl_int code = CL_SUCCESS;
    for (int i = 0; code == CL_SUCCESS && i < HD_KERNEL_COUNT; i++) {
        const char *name = hd_kernel_name(shape, (HdKernel)i);
        if (name != NULL)
            device->kernels[i] = device->cl.clCreateKernel(device->program, name, &code);
    }
    return check(code, "clCreateKernel", error);
}

static HdStatus fail_with_log(const Device *device, cl_int code, HdError *error) {
    size_t size = 0;
    char *log = NULL, fault[HD_POCL_FAULT_SIZE];
    if (device->cl.clGetProgramBuildInfo(device->program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL,
                                         &size) == CL_SUCCESS &&
        size <= HD_OPENCL_MAX_BYTES)
        log = calloc(size + 1, 1);
    if (log)
        device->cl.clGetProgramBuildInfo(device->program, device->id, CL_PROGRAM_BUILD_LOG, size,
                                         log, NULL);
    if (hd_pocl_lacks_cache(device->is.driver, fault))
        hd_fail(error, HD_FAILED, "%s", fault);
    else
        hd_fail(error, HD_FAILED,
                "the compiler of %s refused the kernels (clBuildProgram: %s):\n%s", device->is.name,
                hd_opencl_error_name(code), log && log[0] ? log : "(no log)");
    free(log);
    return HD_FAILED;
}

/* Tries again without the option that a driver may refuse. */
static cl_int build(const Device *device, const char *options) {
    char other[OPTIONS_LENGTH];
    const char *refused = strstr(options, rounding);
    cl_int code = device->cl.clBuildProgram(device->program, 1, &device->id, options, NULL, NULL);
    if (code != CL_INVALID_BUILD_OPTIONS || refused == NULL)
        return code;
    snprintf(other, sizeof other, "%.*s%s", (int)(refused - options), options,
             refused + strlen(rounding));
    return device->cl.clBuildProgram(device->program, 1, &device->id, other, NULL, NULL);
}

static HdStatus compile(void *state, const HdKernelShape *shape, const char *options, char *maker,
                        size_t capacity, HdError *error) {
    Device *device = state;
    const char *text = (const char *)hd_opencl_source;
    cl_int code;
    device->program = device->cl.clCreateProgramWithSource(device->context, 1, &text,
                                                           &hd_opencl_source_size, &code);
    if (!device->program)
        return hd_opencl_fail(error, "clCreateProgramWithSource", code);
    code = build(device, options);
    if (code != CL_SUCCESS)
        return fail_with_log(device, code, error);
    maker[0] = '\0';
    (void)capacity;
    return create_kernels(device, shape, error);
}

static HdStatus load(void *state, const HdKernelShape *shape, const char *options,
                     const unsigned char *binary, size_t size, const char *maker, HdError *error) {
    Device *device = state;
    cl_int loaded = CL_SUCCESS, code;
    (void)maker;
    device->program = device->cl.clCreateProgramWithBinary(device->context, 1, &device->id, &size,
                                                           &binary, &loaded, &code);
    if (code == CL_SUCCESS)
        code = loaded;
    if (!device->program || code != CL_SUCCESS)
        return hd_opencl_fail(error, "clCreateProgramWithBinary", code);
    code = build(device, options);
    return code == CL_SUCCESS ? create_kernels(device, shape, error)
                              : hd_opencl_fail(error, "clBuildProgram", code);
}

/* PoCL returns its machine code too, once the kernels have run. */
static unsigned char *read_binary(const void *state, size_t *size) {
    const Device *device = state;
    *size = 0;
    if (device->cl.clGetProgramInfo(device->program, CL_PROGRAM_BINARY_SIZES, sizeof *size, size,
                                    NULL) != CL_SUCCESS ||
        *size == 0 || *size > HD_OPENCL_MAX_BYTES)
        return NULL;
    unsigned char *binaries[1] = {malloc(*size)};
    if (binaries[0] && device->cl.clGetProgramInfo(device->program, CL_PROGRAM_BINARIES,
                                                   sizeof binaries, binaries, NULL) == CL_SUCCESS)
        return binaries[0];
    free(binaries[0]);
    return NULL;
}

static HdStatus query_max_threads(void *state, size_t *threads, HdError *error) {
    const Device *device = state;
    return check(device->cl.clGetKernelWorkGroupInfo(device->kernels[HD_KERNEL_TRACE], device->id,
                                                     CL_KERNEL_WORK_GROUP_SIZE, sizeof *threads,
                                                     threads, NULL),
                 "clGetKernelWorkGroupInfo", error);
}

/* ---- launches; their event is that of the last command ---- */

static void forget(void *state, HdGpuEvent *event) {
    const Device *device = state;
    if (event->end)
        device->cl.clReleaseEvent(event->end);
    *event = (HdGpuEvent){0};
}

static HdStatus launch(void *state, const HdGpuLaunch *launch, HdGpuEvent *event, HdError *error) {
    Device *device = state;
    cl_kernel kernel = device->kernels[launch->kernel];
    size_t local = (size_t)launch->group_size, global = (size_t)launch->groups * local;
    cl_event command = NULL;
    cl_int code = CL_SUCCESS;
    for (int i = 0; code == CL_SUCCESS && i < launch->argument_count; i++)
        code = device->cl.clSetKernelArg(kernel, (cl_uint)i, launch->arguments[i].bytes,
                                         launch->arguments[i].value);
    if (code != CL_SUCCESS)
        return hd_opencl_fail(error, "clSetKernelArg", code);
    code = device->cl.clEnqueueNDRangeKernel(device->queue, kernel, 1, NULL, &global, &local, 0,
                                             NULL, event != NULL ? &command : NULL);
    if (event != NULL) {
        forget(state, event);
        event->end = command;
    }
    return check(code, "clEnqueueNDRangeKernel", error);
}

/* A queue must be flushed before another one waits for it. */
static HdStatus copy_back(void *state, const HdGpuEvent *after, const HdGpuCopy *copies, int count,
                          HdGpuEvent *done, HdError *error) {
    Device *device = state;
    cl_event ready = after->end, event = NULL;
    HdStatus status = check(device->cl.clFlush(device->queue), "clFlush", error);
    for (int i = 0; status == HD_OK && i < count; i++)
        status = check(device->cl.clEnqueueReadBuffer(device->copies, copies[i].from->handle,
                                                      CL_FALSE, 0, copies[i].bytes, copies[i].to, 1,
                                                      &ready, i == count - 1 ? &event : NULL),
                       "clEnqueueReadBuffer", error);
    forget(state, done);
    done->end = event;
    return status == HD_OK ? check(device->cl.clFlush(device->copies), "clFlush", error) : status;
}

static HdStatus finish(void *state, HdError *error) {
    Device *device = state;
    return check(device->cl.clFinish(device->queue), "clFinish", error);
}

static HdStatus wait_for_launch(void *state, const HdGpuEvent *launched, HdError *error) {
    (void)launched;
    return finish(state, error);
}

static HdStatus wait_for_copies(void *state, const HdGpuEvent *done, HdError *error) {
    const Device *device = state;
    cl_event event = done->end;
    return check(device->cl.clWaitForEvents(1, &event), "clWaitForEvents", error);
}

static void drain(void *state) {
    Device *device = state;
    device->cl.clFinish(device->queue);
    device->cl.clFinish(device->copies);
}

/* Without profiling the times are unknown. */
static HdStatus measure_seconds(void *state, const HdGpuEvent *from, const HdGpuEvent *to,
                                double *seconds, HdError *error) {
    const Device *device = state;
    cl_ulong start = 0, end = 0;
    (void)error;
    bool has_start = device->cl.clGetEventProfilingInfo(from->end, CL_PROFILING_COMMAND_START,
                                                        sizeof start, &start, NULL) == CL_SUCCESS;
    bool has_end = device->cl.clGetEventProfilingInfo(to->end, CL_PROFILING_COMMAND_END, sizeof end,
                                                      &end, NULL) == CL_SUCCESS;
    *seconds = has_start && has_end && end > start ? 1e-9 * (double)(end - start) : -1.0;
    return HD_OK;
}

static int describe(const void *state, const HdKernelShape *shape, int group_size,
                    const char *pipeline, const char *maker, char *text, int capacity) {
    const Device *device = state;
    (void)maker;
    return snprintf(
        text, (size_t)capacity,
        "%d lane%s of %s, work groups of %d, %d pixel%s for each work item, %d compute units, %s",
        shape->lanes, hd_plural(shape->lanes),
        shape->precision == HD_PRECISION_DOUBLE ? "double" : "float", group_size,
        shape->pixels_per_item, hd_plural(shape->pixels_per_item), device->is.compute_units,
        pipeline);
}

static const HdGpuDriver driver = {
    .groups = "work groups",
    .group_size = GPU_GROUP_SIZE,
    .bytes = sizeof(Device),
    .counts_host_memory = true,
    .source = hd_opencl_source,
    .source_size = &hd_opencl_source_size,
    .open = open_device,
    .close = close_device,
    .allocate = allocate,
    .release = release,
    .write = write_memory,
    .read = read_memory,
    .write_options = write_options,
    .write_version = write_version,
    .compile = compile,
    .load = load,
    .binary = read_binary,
    .unload = unload,
    .max_threads = query_max_threads,
    .launch = launch,
    .copy_back = copy_back,
    .wait_for_launch = wait_for_launch,
    .wait_for_copies = wait_for_copies,
    .finish = finish,
    .drain = drain,
    .seconds = measure_seconds,
    .forget = forget,
    .describe = describe,
};

const HdBackend hd_backend_opencl = {.name = "opencl",
                                     .functions = &hd_gpu_functions,
                                     .driver = &driver,
                                     .enumerate = hd_opencl_enumerate};
