/* SPDX-License-Identifier: MIT */
#include "opencl_program.h"

#include <stdio.h>
#include <stdlib.h>

enum { OPTIONS_LENGTH = 128 + HD_KERNEL_DEFINE_COUNT * (HD_KERNEL_DEFINE_LENGTH + 1) };

static void write_options(char options[OPTIONS_LENGTH], const HdKernelShape *shape,
                          bool takes_register_limit) {
    char defines[HD_KERNEL_DEFINE_COUNT][HD_KERNEL_DEFINE_LENGTH];
    hd_kernel_defines(shape, defines);
    int length = snprintf(options, OPTIONS_LENGTH, "-cl-std=CL1.2 %s",
                          shape->math == HD_MATH_FAST ? "-cl-fast-relaxed-math"
                                                      : "-cl-fp32-correctly-rounded-divide-sqrt");
    for (int i = 0; i < HD_KERNEL_DEFINE_COUNT; i++)
        length += snprintf(options + length, OPTIONS_LENGTH - (size_t)length, " %s", defines[i]);
    if (takes_register_limit)
        snprintf(options + length, OPTIONS_LENGTH - (size_t)length, " -cl-nv-maxrregcount=%d",
                 (int)HD_REGISTER_LIMIT);
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

HdStatus hd_opencl_build(HdOpenclProgram *program, cl_context context, const HdOpenclDevice *device,
                         const char *name, const HdKernelShape *shape, HdError *error) {
    *program = (HdOpenclProgram){0};
    const char *text = (const char *)hd_opencl_source;
    cl_int code;
    program->program = clCreateProgramWithSource(context, 1, &text, &hd_opencl_source_size, &code);
    if (!program->program)
        return hd_opencl_fail(error, "clCreateProgramWithSource", code);
    char options[OPTIONS_LENGTH];
    write_options(options, shape, device->takes_register_limit);
    HdStatus status = HD_OK;
    code = clBuildProgram(program->program, 1, &device->id, options, NULL, NULL);
    if (code != CL_SUCCESS)
        status = fail_with_log(program->program, device->id, name, code, error);
    if (status == HD_OK)
        status = create_kernel(&program->render, program->program, hd_kernel_tracing(shape), error);
    if (status == HD_OK && hd_kernel_storing(shape) != NULL)
        status = create_kernel(&program->store, program->program, hd_kernel_storing(shape), error);
    if (status == HD_OK)
        status = create_kernel(&program->sum, program->program, "hedron_sum_counts", error);
    if (status != HD_OK)
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
    if (program->program)
        clReleaseProgram(program->program);
    *program = (HdOpenclProgram){0};
}
