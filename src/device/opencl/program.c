/* SPDX-License-Identifier: MIT */
#include "device/opencl/program.h"

#include <stdio.h>
#include <stdlib.h>

#include "system/machine.h"

enum { OPTIONS_LENGTH = 128 + HD_KERNEL_DEFINE_COUNT * (HD_KERNEL_DEFINE_LENGTH + 1) };

static void write_options(char options[OPTIONS_LENGTH], const HdOpenclDevice *device,
                          const HdKernelShape *shape) {
    const char *cautious = device->nvidia_arch > 0 ? " -cl-nv-opt-level=0" : " -cl-opt-disable";
    char defines[HD_KERNEL_DEFINE_COUNT][HD_KERNEL_DEFINE_LENGTH];
    hd_kernel_defines(shape, defines);
    int length = snprintf(options, OPTIONS_LENGTH, "-cl-std=CL1.2 %s",
                          shape->math == HD_MATH_FAST ? "-cl-fast-relaxed-math"
                                                      : "-cl-fp32-correctly-rounded-divide-sqrt");
    for (int i = 0; i < HD_KERNEL_DEFINE_COUNT; i++)
        length += snprintf(options + length, OPTIONS_LENGTH - (size_t)length, " %s", defines[i]);
    if (shape->register_limit > 0)
        length += snprintf(options + length, OPTIONS_LENGTH - (size_t)length,
                           " -cl-nv-maxrregcount=%d", shape->register_limit);
    if (shape->is_cautious)
        snprintf(options + length, OPTIONS_LENGTH - (size_t)length, "%s", cautious);
}

static HdStatus fail_with_log(cl_program program, cl_device_id device, const char *name,
                              cl_int code, HdError *error) {
    size_t size = 0;
    char *log = NULL;
    if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, NULL, &size) == CL_SUCCESS)
        log = calloc(size + 1, 1);
    if (log)
        clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    hd_fail(error, HD_FAILED, "the compiler of %s refused the kernels (clBuildProgram: %s):\n%s",
            name, hd_opencl_error_name(code), log && log[0] ? log : "(it left no log)");
    free(log);
    return HD_FAILED;
}

static HdStatus create_kernel(cl_kernel *kernel, cl_program program, const char *name,
                              HdError *error) {
    cl_int code;
    *kernel = clCreateKernel(program, name, &code);
    return *kernel ? HD_OK : hd_opencl_fail(error, "clCreateKernel", code);
}

static HdStatus create_kernels(HdOpenclProgram *program, const HdKernelShape *shape,
                               HdError *error) {
    const char *storing = hd_kernel_storing(shape);
    HdStatus status =
        create_kernel(&program->render, program->program, hd_kernel_tracing(shape), error);
    if (status == HD_OK && storing != NULL)
        status = create_kernel(&program->store, program->program, storing, error);
    if (status == HD_OK)
        status = create_kernel(&program->sum, program->program, "hedron_sum_counts", error);
    if (status == HD_OK && shape->group_size > 0)
        status = create_kernel(&program->encode, program->program, "hedron_encode", error);
    return status;
}

static HdStatus compile(HdOpenclProgram *program, cl_context context, const HdOpenclDevice *device,
                        const char *name, const char *options, const HdKernelShape *shape,
                        HdError *error) {
    const char *text = (const char *)hd_opencl_source;
    cl_int code;
    program->program = clCreateProgramWithSource(context, 1, &text, &hd_opencl_source_size, &code);
    if (!program->program)
        return hd_opencl_fail(error, "clCreateProgramWithSource", code);
    code = clBuildProgram(program->program, 1, &device->id, options, NULL, NULL);
    if (code != CL_SUCCESS)
        return fail_with_log(program->program, device->id, name, code, error);
    return create_kernels(program, shape, error);
}

/* ---- the driver's own form of the compiled kernels ---- */

/* The device's name and driver are a part of the key in any case; this is what they do not tell,
   such as which LLVM PoCL has. */
static void read_platform_version(const HdOpenclDevice *device, char *text, size_t capacity) {
    cl_platform_id platform;
    size_t size = 0;
    text[0] = '\0';
    if (clGetDeviceInfo(device->id, CL_DEVICE_PLATFORM, sizeof(cl_platform_id), &platform, NULL) !=
            CL_SUCCESS ||
        clGetPlatformInfo(platform, CL_PLATFORM_VERSION, 0, NULL, &size) != CL_SUCCESS)
        return;
    char *whole = calloc(size + 1, 1);
    if (whole && clGetPlatformInfo(platform, CL_PLATFORM_VERSION, size, whole, NULL) == CL_SUCCESS)
        snprintf(text, capacity, "%s", whole);
    free(whole);
}

static HdStatus load(HdOpenclProgram *program, cl_context context, const HdOpenclDevice *device,
                     const char *options, const HdKernelShape *shape, const unsigned char *binary,
                     size_t size, HdError *error) {
    cl_int loaded = CL_SUCCESS, code;
    program->program =
        clCreateProgramWithBinary(context, 1, &device->id, &size, &binary, &loaded, &code);
    if (code == CL_SUCCESS)
        code = loaded;
    if (!program->program || code != CL_SUCCESS)
        return hd_opencl_fail(error, "clCreateProgramWithBinary", code);
    code = clBuildProgram(program->program, 1, &device->id, options, NULL, NULL);
    if (code != CL_SUCCESS)
        return hd_opencl_fail(error, "clBuildProgram", code);
    return create_kernels(program, shape, error);
}

static bool load_cached(HdOpenclProgram *program, cl_context context, const HdOpenclDevice *device,
                        const char *options, const HdKernelShape *shape, HdKernelCache *cache,
                        HdError *error) {
    char version[256];
    unsigned char *binary;
    size_t size;
    read_platform_version(device, version, sizeof version);
    if (!hd_kernel_cache_find(cache, shape, hd_opencl_source, hd_opencl_source_size, options,
                              version, &binary, &size))
        return false;
    bool loaded = load(program, context, device, options, shape, binary, size, error) == HD_OK;
    free(binary);
    if (!loaded) {
        hd_kernel_cache_refuse(cache, error->message);
        hd_opencl_program_free(program);
    }
    return loaded;
}

/* PoCL hands out its machine code too, once the kernels have run. */
static unsigned char *read_binary(const void *context, size_t *size) {
    const HdOpenclProgram *program = context;
    *size = 0;
    if (clGetProgramInfo(program->program, CL_PROGRAM_BINARY_SIZES, sizeof *size, size, NULL) !=
            CL_SUCCESS ||
        *size == 0)
        return NULL;
    unsigned char *binaries[1] = {malloc(*size)};
    if (binaries[0] && clGetProgramInfo(program->program, CL_PROGRAM_BINARIES, sizeof binaries,
                                        binaries, NULL) == CL_SUCCESS)
        return binaries[0];
    free(binaries[0]);
    return NULL;
}

HdStatus hd_opencl_build(HdOpenclProgram *program, cl_context context, const HdOpenclDevice *device,
                         const char *name, const HdKernelShape *shape, HdKernelCache *cache,
                         HdError *error) {
    char options[OPTIONS_LENGTH];
    *program = (HdOpenclProgram){0};
    write_options(options, device, shape);
    if (load_cached(program, context, device, options, shape, cache, error))
        return HD_OK;
    double start = hd_monotonic_seconds();
    HdStatus status = compile(program, context, device, name, options, shape, error);
    if (status == HD_OK)
        hd_kernel_cache_compiled(cache, shape, read_binary, program,
                                 shape->is_cautious ? "the driver" : "",
                                 hd_monotonic_seconds() - start);
    else
        hd_opencl_program_free(program);
    return status;
}

void hd_opencl_program_free(HdOpenclProgram *program) {
    if (program->render)
        clReleaseKernel(program->render);
    if (program->store)
        clReleaseKernel(program->store);
    if (program->sum)
        clReleaseKernel(program->sum);
    if (program->encode)
        clReleaseKernel(program->encode);
    if (program->program)
        clReleaseProgram(program->program);
    *program = (HdOpenclProgram){0};
}
