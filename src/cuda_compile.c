/* SPDX-License-Identifier: MIT */
#include "cuda_compile.h"

#include <stdio.h>
#include <stdlib.h>

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
        return hd_fail(error, HD_FAILED, "out of memory");
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

static HdStatus compile(HdCudaCode *code, const HdNvrtc *nvrtc, HdNvrtcProgram program, int arch,
                        const HdKernelShape *shape, bool verbose, HdError *error) {
    char architecture[40], register_limit[40];
    char defines[HD_KERNEL_DEFINE_COUNT][HD_KERNEL_DEFINE_LENGTH];
    const char *options[MAX_OPTIONS];
    int count = 0;
    snprintf(architecture, sizeof architecture, "--gpu-architecture=sm_%d", arch);
    options[count++] = architecture;
    hd_kernel_defines(shape, defines);
    for (int i = 0; i < HD_KERNEL_DEFINE_COUNT; i++)
        options[count++] = defines[i];
    if (shape->math == HD_MATH_FAST) {
        options[count++] = "--use_fast_math";
    } else {
        options[count++] = "--fmad=false";
        options[count++] = "--prec-div=true";
        options[count++] = "--prec-sqrt=true";
        options[count++] = "--ftz=false";
    }
    snprintf(register_limit, sizeof register_limit, "--maxrregcount=%d", (int)HD_REGISTER_LIMIT);
    options[count++] = register_limit;
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

void hd_cuda_code_free(HdCudaCode *code) {
    free(code->cubin);
    free(code->log);
    *code = (HdCudaCode){0};
}
