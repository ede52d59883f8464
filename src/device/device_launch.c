/* SPDX-License-Identifier: MIT */
#include "device/device_launch.h"

#include "image/frame.h"
#include "kernels/host/shared.h"

_Static_assert(sizeof(HdRayCounts) == sizeof(RayCounts), "the counts are copied as they are");

int hd_gpu_sample_parts(int samples, int group_size) {
    enum { MAX_PARTS = 64 };
    int parts = group_size < MAX_PARTS ? group_size : MAX_PARTS;
    while (samples % parts != 0)
        parts--;
    return parts;
}
