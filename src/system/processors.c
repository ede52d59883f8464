/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE
#include "system/processors.h"

#include <sched.h>
#include <unistd.h>

int hd_processor_count(void) {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
    long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)online : 1;
}
