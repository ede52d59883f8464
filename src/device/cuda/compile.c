/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "device/cuda/compile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_OPTIONS = HD_KERNEL_DEFINE_COUNT + 8 };

static HdStatus fail(const HdNvrtc *nvrtc, const char *function, HdNvrtcResult code,
                     HdError *error) {
    return hd_fail(error, HD_FAILED, "%s failed with %s", function,
                   nvrtc->functions.error_string(code));
}

/* Returns the log, "" if there is none, or NULL when out of memory. */
static char *copy_log(const HdNvrtc *nvrtc, HdNvrtcProgram program) {
    size_t size = 0;
    if (nvrtc->functions.log_size(program, &size) != 0)
        size = 0;
    char *log = calloc(size + 1, 1);
    if (log && size > 0)
        nvrtc->functions.log(program, log);
    return log;
}

static HdStatus copy_results(HdCudaCode *code, const HdNvrtc *nvrtc, HdNvrtcProgram program,
                             HdError *error) {
    HdNvrtcResult result = nvrtc->functions.cubin_size(program, &code->size);
    if (result != 0 || code->size == 0)
        return fail(nvrtc, "nvrtcGetCUBINSize", result, error);
    code->cubin = malloc(code->size);
    code->log = copy_log(nvrtc, program);
    if (!code->cubin || !code->log)
        return hd_fail(error, HD_FAILED, "out of memory: no room for compiled kernels");
    result = nvrtc->functions.cubin(program, code->cubin);
    return result == 0 ? HD_OK : fail(nvrtc, "nvrtcGetCUBIN", result, error);
}

static HdStatus fail_with_log(const HdNvrtc *nvrtc, HdNvrtcProgram program, int arch,
                              HdNvrtcResult result, HdError *error) {
    char *log = copy_log(nvrtc, program);
    hd_fail(error, HD_FAILED, "NVRTC %d.%d refused the kernels for sm_%d (%s):\n%s", nvrtc->major,
            nvrtc->minor, arch, nvrtc->functions.error_string(result),
            log && log[0] ? log : "(it left no log)");
    free(log);
    return HD_FAILED;
}

void hd_cuda_options(char options[HD_CUDA_OPTIONS_LENGTH], int arch, const HdKernelShape *shape) {
    char defines[HD_KERNEL_DEFINE_COUNT][HD_KERNEL_DEFINE_LENGTH];
    hd_kernel_defines(shape, defines);
    int length = snprintf(
        options, HD_CUDA_OPTIONS_LENGTH, "--gpu-architecture=sm_%d --maxrregcount=%d %s", arch,
        shape->register_limit,
        shape->math == HD_MATH_FAST ? "--use_fast_math"
                                    : "--fmad=false --prec-div=true --prec-sqrt=true --ftz=false");
    for (int i = 0; i < HD_KERNEL_DEFINE_COUNT; i++)
        length +=
            snprintf(options + length, HD_CUDA_OPTIONS_LENGTH - (size_t)length, " %s", defines[i]);
    if (shape->is_cautious)
        snprintf(options + length, HD_CUDA_OPTIONS_LENGTH - (size_t)length, " --ptxas-options=-O0");
}

/* Cuts the text at its spaces and returns the number of parts. */
static int split(char *text, const char *parts[MAX_OPTIONS]) {
    int count = 0;
    char *rest = NULL;
    for (char *part = strtok_r(text, " ", &rest); part != NULL && count < MAX_OPTIONS;
         part = strtok_r(NULL, " ", &rest))
        parts[count++] = part;
    return count;
}

static HdStatus compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdNvrtcProgram program, int arch,
                        const HdKernelShape *shape, bool verbose, HdError *error) {
    char text[HD_CUDA_OPTIONS_LENGTH];
    const char *options[MAX_OPTIONS + 1];
    hd_cuda_options(text, arch, shape);
    int count = split(text, options);
    if (verbose)
        options[count++] = "--ptxas-options=-v";
    HdNvrtcResult result = nvrtc->functions.compile_program(program, count, options);
    if (result != 0)
        return fail_with_log(nvrtc, program, arch, result, error);
    return copy_results(code, nvrtc, program, error);
}

HdStatus hd_cuda_compile(HdCudaCode *code, const HdNvrtc *nvrtc, int arch,
                         const HdKernelShape *shape, bool verbose, HdError *error) {
    *code = (HdCudaCode){0};
    HdNvrtcProgram program = NULL;
    HdNvrtcResult result = nvrtc->functions.create_program(&program, (const char *)hd_cuda_source,
                                                           "kernels/cuda/hedron.cu", 0, NULL, NULL);
    if (result != 0)
        return fail(nvrtc, "nvrtcCreateProgram", result, error);
    HdStatus status = compile(code, nvrtc, program, arch, shape, verbose, error);
    nvrtc->functions.destroy_program(&program);
    if (status != HD_OK)
        hd_cuda_code_free(code);
    return status;
}

/* The machine code depends on NVRTC's version as well. To ask for it would need NVRTC; an entry
   tells it, and kernels of any version have passed the test. The one that the user names counts. */
bool hd_cuda_find_cached(HdCudaCode *code, HdKernelCache *cache, int arch,
                         const HdKernelShape *shape) {
    char options[HD_CUDA_OPTIONS_LENGTH];
    unsigned char *cubin;
    const char *nvrtc = getenv("HEDRON_NVRTC");
    *code = (HdCudaCode){0};
    hd_cuda_options(options, arch, shape);
    if (!hd_kernel_cache_find(cache, shape, hd_cuda_source, hd_cuda_source_size, options,
                              nvrtc != NULL ? nvrtc : "", &cubin, &code->size))
        return false;
    code->cubin = (char *)cubin;
    return true;
}

unsigned char *hd_cuda_read_code(const void *code, size_t *size) {
    const HdCudaCode *from = code;
    unsigned char *copy = malloc(from->size);
    if (copy == NULL)
        return NULL;
    memcpy(copy, from->cubin, from->size);
    *size = from->size;
    return copy;
}

void hd_cuda_code_free(HdCudaCode *code) {
    free(code->cubin);
    free(code->log);
    *code = (HdCudaCode){0};
}
