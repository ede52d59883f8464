/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "cpu/instruction_set.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define DECLARE_BUILD(set, lanes)                                                                  \
    HdCpuKernel hd_kernel_##set##_##lanes##_float_strict;                                          \
    HdCpuKernel hd_kernel_##set##_##lanes##_float_fast;                                            \
    HdCpuKernel hd_kernel_##set##_##lanes##_double_strict;                                         \
    HdCpuKernel hd_kernel_##set##_##lanes##_double_fast;
HD_CPU_BUILDS(DECLARE_BUILD)

#define LIST_BUILD(set, lanes)                                                                     \
    {#set, lanes, HD_PRECISION_FLOAT, HD_MATH_STRICT, hd_kernel_##set##_##lanes##_float_strict},   \
        {#set, lanes, HD_PRECISION_FLOAT, HD_MATH_FAST, hd_kernel_##set##_##lanes##_float_fast},   \
        {#set, lanes, HD_PRECISION_DOUBLE, HD_MATH_STRICT,                                         \
         hd_kernel_##set##_##lanes##_double_strict},                                               \
        {#set, lanes, HD_PRECISION_DOUBLE, HD_MATH_FAST, hd_kernel_##set##_##lanes##_double_fast},
static const HdCpuBuild builds[] = {HD_CPU_BUILDS(LIST_BUILD)};

static bool is_supported(const char *set) {
#ifdef HD_CPU_X86
    bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (strcmp(set, "avx512") == 0)
        return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    if (strcmp(set, "avx2") == 0)
        return avx2;
#endif
    return strcmp(set, "generic") == 0;
}

const char *hd_cpu_best_instruction_set(void) {
    for (size_t i = 0;; i++)
        if (is_supported(builds[i].instruction_set))
            return builds[i].instruction_set;
}

static int native_lanes(HdPrecision precision) {
    const char *set = hd_cpu_best_instruction_set();
    int floats = strcmp(set, "avx512") == 0 ? 16 : strcmp(set, "avx2") == 0 ? 8 : 4;
    if (precision == HD_PRECISION_FLOAT)
        return floats;
    return floats == 16 ? 8 : 4;
}

const HdCpuBuild *hd_cpu_find_build(int lanes, HdPrecision precision, HdMath math) {
    if (lanes == 0)
        lanes = native_lanes(precision);
    const HdCpuBuild *build = builds;
    while (build->lanes != lanes || build->precision != precision || build->math != math ||
           !is_supported(build->instruction_set))
        build++;
    return build;
}

void hd_cpu_name(char *name, int capacity) {
    char line[512];
    snprintf(name, (size_t)capacity, "processor");
    FILE *file = fopen("/proc/cpuinfo", "r");
    if (file == NULL)
        return;
    while (fgets(line, sizeof line, file) != NULL) {
        char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon != NULL) {
            line[strcspn(line, "\n")] = '\0';
            snprintf(name, (size_t)capacity, "%s", colon + 2);
            break;
        }
    }
    fclose(file);
}
