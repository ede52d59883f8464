/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "device_launch.h"

#include <time.h>

#include "../kernels/common/scene_tables.h"

_Static_assert(sizeof(HdItemCounts) == sizeof(RayCounts), "the kernels count in 32 bytes");
_Static_assert(sizeof(HdItemCounts) == HD_COUNTS_BYTES, "the kernels count in 32 bytes");

int hd_gpu_launch_items(int compute_units) {
    enum { ITEMS_PER_UNIT = 1 << 14, MIN_ITEMS = 1 << 16 };
    if (compute_units >= HD_MAX_LAUNCH_ITEMS / ITEMS_PER_UNIT)
        return HD_MAX_LAUNCH_ITEMS;
    int items = compute_units * ITEMS_PER_UNIT;
    return items < MIN_ITEMS ? MIN_ITEMS : items;
}

void hd_frame_set_counts(HdFrame *frame, const HdItemCounts sums[HD_SUM_WORKERS]) {
    frame->rays = 0;
    frame->shadow_tests = 0;
    frame->clamps = 0;
    for (int i = 0; i < HD_SUM_WORKERS; i++) {
        frame->rays += sums[i].rays;
        frame->shadow_tests += sums[i].shadow_tests;
        frame->clamps += sums[i].clamps;
    }
}

double hd_monotonic_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
