/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "device/cuda/compile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PARTS = 48, MOST_TEXT = 1024 };

static HdStatus fail(const HdNvrtc *nvrtc, const char *function, HdNvrtcResult code,
                     HdError *error) {
    return hd_fail(error, HD_FAILED, "%s failed with %s", function,
                   nvrtc->functions.error_string(code));
}

/* A compiler that claims more lies. */
enum { MOST_LOG_BYTES = 1 << 26 };

/* Returns the log, "" if there is none, or NULL when out of memory. */
static char *copy_log(const HdNvrtc *nvrtc, HdNvrtcProgram program) {
    size_t size = 0;
    if (nvrtc->functions.log_size(program, &size) != 0 || size > MOST_LOG_BYTES)
        size = 0;
    char *log = calloc(size + 1, 1);
    if (log && size > 0)
        nvrtc->functions.log(program, log);
    return log;
}

static HdStatus copy_image(HdCudaCode *code, const HdNvrtc *nvrtc, HdNvrtcProgram program,
                           HdCudaTarget target, HdError *error) {
    const HdNvrtcFunctions *functions = &nvrtc->functions;
    HdNvrtcResult result = target.is_ptx ? functions->ptx_size(program, &code->size)
                                         : functions->cubin_size(program, &code->size);
    if (result != 0 || code->size == 0)
        return fail(nvrtc, target.is_ptx ? "nvrtcGetPTXSize" : "nvrtcGetCUBINSize", result, error);
    code->image = malloc(code->size);
    code->log = copy_log(nvrtc, program);
    if (!code->image || !code->log)
        return hd_fail(error, HD_FAILED, "out of memory: no room for compiled kernels");
    result = target.is_ptx ? functions->ptx(program, code->image)
                           : functions->cubin(program, code->image);
    return result == 0
               ? HD_OK
               : fail(nvrtc, target.is_ptx ? "nvrtcGetPTX" : "nvrtcGetCUBIN", result, error);
}

static const char *prefix_of(HdCudaTarget target) {
    return target.is_ptx ? "compute" : "sm";
}

static HdStatus fail_with_log(const HdNvrtc *nvrtc, HdNvrtcProgram program, HdCudaTarget target,
                              HdNvrtcResult result, HdError *error) {
    char *log = copy_log(nvrtc, program);
    hd_fail(error, HD_FAILED, "NVRTC %d.%d refused the kernels for %s_%d (%s):\n%s", nvrtc->major,
            nvrtc->minor, prefix_of(target), target.arch, nvrtc->functions.error_string(result),
            log && log[0] ? log : "(it left no log)");
    free(log);
    return HD_FAILED;
}

HdCudaTarget hd_cuda_target(const HdKernelShape *shape, int arch) {
    bool is_ptx = shape->ptx_arch > 0;
    return (HdCudaTarget){.arch = is_ptx ? shape->ptx_arch : arch, .is_ptx = is_ptx};
}

void hd_cuda_options(char *options, size_t capacity, HdCudaTarget target,
                     const HdKernelShape *shape) {
    static const char strict[] = "--fmad=false --prec-div=true --prec-sqrt=true --ftz=false";
    char defines[HD_KERNEL_DEFINES_SIZE];
    hd_kernel_defines(shape, defines);
    snprintf(options, capacity, "--gpu-architecture=%s_%d --maxrregcount=%d %s%s",
             prefix_of(target), target.arch, shape->register_limit,
             shape->math == HD_MATH_FAST ? "--use_fast_math" : strict, defines);
}

/* Cuts the text at its spaces and returns the number of parts. */
static int split(char *text, const char *parts[MOST_PARTS]) {
    int count = 0;
    char *rest = NULL;
    for (char *part = strtok_r(text, " ", &rest); part != NULL && count < MOST_PARTS;
         part = strtok_r(NULL, " ", &rest))
        parts[count++] = part;
    return count;
}

static HdStatus compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdNvrtcProgram program,
                        HdCudaTarget target, const char *options, HdError *error) {
    char text[MOST_TEXT];
    const char *parts[MOST_PARTS];
    snprintf(text, sizeof text, "%s", options);
    HdNvrtcResult result = nvrtc->functions.compile_program(program, split(text, parts), parts);
    if (result != 0)
        return fail_with_log(nvrtc, program, target, result, error);
    return copy_image(code, nvrtc, program, target, error);
}

HdStatus hd_cuda_compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdCudaTarget target,
                         const char *options, HdError *error) {
    *code = (HdCudaCode){0};
    HdNvrtcProgram program = NULL;
    HdNvrtcResult result = nvrtc->functions.create_program(&program, (const char *)hd_cuda_source,
                                                           "kernels/cuda/hedron.cu", 0, NULL, NULL);
    if (result != 0)
        return fail(nvrtc, "nvrtcCreateProgram", result, error);
    HdStatus status = compile(code, nvrtc, program, target, options, error);
    nvrtc->functions.destroy_program(&program);
    if (status != HD_OK)
        hd_cuda_code_free(code);
    return status;
}

void hd_cuda_code_free(HdCudaCode *code) {
    free(code->image);
    free(code->log);
    *code = (HdCudaCode){0};
}
