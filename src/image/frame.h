/* SPDX-License-Identifier: MIT */
/* A rendered frame: linear radiance, or what files store of it, and what was counted on the way. */
#ifndef HD_IMAGE_FRAME_H
#define HD_IMAGE_FRAME_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "image/curve.h"

/* What is wanted of a frame's pixels. */
typedef struct HdFrameWish {
    bool radiance; /* `rgb` must be filled */
    HdCurve curve; /* without it: 8 bits on this curve will do, where the device makes them */
} HdFrameWish;

/* Of a pixel; those of surveyed scenes. */
enum { HD_RADIANCE_FLOATS = 3, HD_SURVEY_FLOATS = 5 };

typedef struct HdFrame {
    int width, height;
    int floats;      /* of a pixel: HD_RADIANCE_FLOATS or HD_SURVEY_FLOATS */
    float *rgb;      /* owned; width * height * floats, row by row from the top; radiance times
                        exposure; of surveyed scenes also a bound of what was left out, and a number
                        below 2^24 that tells what the pixel's samples see */
    uint8_t *rgba;   /* owned; width * height * 4: r, g, b and an alpha of 255, as hd_curve_encode8
                        makes them; NULL: radiance must be wished for */
    bool is_encoded; /* the device filled `rgba`, and `rgb` is worth nothing; otherwise it filled
                        `rgb` and left `rgba` alone */
    uint64_t primary_rays, mirrored_rays, transmitted_rays; /* closest-hit searches */
    uint64_t shadow_tests; /* pairs of a point and a light that may reach it */
    uint64_t clamps;       /* contributions cut to 2^16 */
    double trace_seconds;  /* on the device, copies left out */
    bool has_bound;        /* of a surveyed scene: what was left out, in steps of 255 */
    double largest_bound, mean_bound;
} HdFrame;

/* What the kernels count in a part of a frame, laid out as their RayCounts; as in HdFrame. */
typedef struct HdRayCounts {
    uint64_t mirrored_rays, transmitted_rays, shadow_tests, clamps;
} HdRayCounts;
_Static_assert(sizeof(HdRayCounts) == 32, "the kernels count in 32 bytes");

/* A frame without `rgba`. */
HdStatus hd_frame_create(HdFrame *frame, int width, int height, HdError *error);

/* The same for so many floats of a pixel. */
HdStatus hd_frame_create_with(HdFrame *frame, int width, int height, int floats, HdError *error);

/* Fails where a side is not in 1..65535, as no picture may have it. */
HdStatus hd_frame_check_size(const HdFrame *frame, HdError *error);

/* Gives a frame of such a size `rgba`. */
HdStatus hd_frame_add_rgba(HdFrame *frame, HdError *error);

/* Fills `rgba` from the radiance of a frame of HD_RADIANCE_FLOATS. */
void hd_frame_encode(const HdFrame *frame, HdCurve curve);

/* A frame that is free may be freed. */
void hd_frame_free(HdFrame *frame);

/* Sets the frame's counts to the sums of those of its parts; every sample has one primary ray. */
void hd_frame_set_counts(HdFrame *frame, int samples, const HdRayCounts *counts, int count);

/* Rays of all kinds. */
uint64_t hd_frame_rays(const HdFrame *frame);

/* A 64-bit hash (FNV-1a) of size, radiance and counts of rays, shadow tests and clamps: two frames
   are the same when their hashes are. */
uint64_t hd_frame_hash(const HdFrame *frame);

#endif
