/* SPDX-License-Identifier: MIT */
/* A rendered frame: linear radiance and what was counted on the way. */
#ifndef HD_FRAME_H
#define HD_FRAME_H

#include <stdint.h>

#include "error.h"
#include "image.h"

typedef struct HdFrame {
    int width, height;
    float *rgb;    /* owned; width * height * 3, row by row from the top; radiance times exposure */
    uint64_t rays; /* closest-hit searches: primary, mirrored and transmitted rays */
    uint64_t shadow_tests; /* pairs of a point and a light that it faces */
    uint64_t clamps;       /* contributions cut to 2^16 */
    double trace_seconds;  /* on the device, copies left out */
} HdFrame;

HdStatus hd_frame_create(HdFrame *frame, int width, int height, HdError *error);
void hd_frame_free(HdFrame *frame);

/* Each channel clamped to 0..1, times 255, rounded to the nearest; alpha 255. `image` has the
   frame's size. */
void hd_frame_to_image8(const HdFrame *frame, HdImage8 *image);

/* A 64-bit hash (FNV-1a) of size, pixels and counts of rays, shadow tests and clamps: two frames
   are the same when their hashes are. */
uint64_t hd_frame_hash(const HdFrame *frame);

#endif
