/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "cpu/builds.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "generated/cpu_builds.h"

#define DECLARE_KERNEL(kernel) HdCpuKernel kernel;
HD_CPU_KERNELS(DECLARE_KERNEL)
#define DECLARE_FIRST_HITS(set, lanes, precision, kernel, plain_kernel)                            \
    HdCpuFirstHits kernel##_first_hits;
HD_CPU_BUILDS(DECLARE_FIRST_HITS)

#define LIST_BUILD(set, lanes, precision, kernel, plain_kernel)                                    \
    {#set, lanes, HD_PRECISION_##precision, kernel, plain_kernel, kernel##_first_hits},
static const HdCpuBuild builds[] = {HD_CPU_BUILDS(LIST_BUILD)};
enum { BUILD_COUNT = sizeof builds / sizeof builds[0] };

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

const HdCpuBuild *hd_cpu_find_build(int lanes, HdPrecision precision) {
    for (const HdCpuBuild *build = builds; build < builds + BUILD_COUNT; build++)
        if ((lanes == 0 || build->lanes == lanes) && build->precision == precision &&
            is_supported(build->instruction_set))
            return build;
    return NULL;
}

int hd_cpu_most_lanes(HdPrecision precision) {
    int most = 1;
    for (const HdCpuBuild *build = builds; build < builds + BUILD_COUNT; build++)
        if (build->lanes > most && build->precision == precision &&
            is_supported(build->instruction_set))
            most = build->lanes;
    return most;
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
