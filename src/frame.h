/* SPDX-License-Identifier: MIT */
/* A rendered frame: linear radiance and what was counted on the way. */
#ifndef HD_FRAME_H
#define HD_FRAME_H

#include <stdint.h>

#include "error.h"

typedef struct HdFrame {
    int width, height;
    float *rgb; /* owned; width * height * 3, row by row from the top; radiance times exposure */
    uint64_t primary_rays, mirrored_rays, transmitted_rays; /* closest-hit searches */
    uint64_t shadow_tests; /* pairs of a point and a light that may reach it */
    uint64_t clamps;       /* contributions cut to 2^16 */
    double trace_seconds;  /* on the device, copies left out */
} HdFrame;

/* What the kernels count in a part of a frame, laid out as their RayCounts; as in HdFrame. */
typedef struct HdRayCounts {
    uint64_t mirrored_rays, transmitted_rays, shadow_tests, clamps;
} HdRayCounts;
_Static_assert(sizeof(HdRayCounts) == 32, "the kernels count in 32 bytes");

HdStatus hd_frame_create(HdFrame *frame, int width, int height, HdError *error);
void hd_frame_free(HdFrame *frame);

/* Sets the frame's counts to the sums of those of its parts; every sample has one primary ray. */
void hd_frame_set_counts(HdFrame *frame, int samples_per_side, const HdRayCounts *counts,
                         int count);

/* Rays of all kinds. */
uint64_t hd_frame_rays(const HdFrame *frame);

/* A 64-bit hash (FNV-1a) of size, pixels and counts of rays, shadow tests and clamps: two frames
   are the same when their hashes are. */
uint64_t hd_frame_hash(const HdFrame *frame);

#endif
