/* SPDX-License-Identifier: MIT */
/* Transfer curve between linear light and file values. It uses sums, products, quotients and square
   roots in double only, so its tables are identical on every system. */
#ifndef HD_IMAGE_CURVE_H
#define HD_IMAGE_CURVE_H

#include <stddef.h>
#include <stdint.h>

typedef enum HdCurve {
    HD_CURVE_LINEAR,
    HD_CURVE_SRGB, /* IEC 61966-2-1 */
    HD_CURVES
} HdCurve;

/* Clamp each value to 0..1 (NaN becomes 0), apply the curve, and round to the nearest of 256 or
   65536 steps. */
void hd_curve_encode8(HdCurve curve, const float *values, size_t count, uint8_t *out);
void hd_curve_encode16(HdCurve curve, const float *values, size_t count, uint16_t *out);

/* As hd_curve_encode8 for r, g, b of each pixel, each followed by an alpha of 255. */
void hd_curve_encode_rgba(HdCurve curve, const float *rgb, size_t pixels, uint8_t *rgba);

/* Fills the thresholds: for each code the bits of the least float that hd_curve_encode8 maps to it,
   0 for code 0. A value has the greatest code whose threshold is not above it. */
void hd_curve_thresholds8(HdCurve curve, int32_t thresholds[256]);

/* Decodes 0..65535 to linear 0..65535 in place; computes each code once. */
void hd_curve_decode16(HdCurve curve, uint16_t *values, size_t count);

/* Apply the curve or its inverse in double, clamping to 0..1. NaN stays NaN. */
double hd_curve_to_display(HdCurve curve, double linear);
double hd_curve_to_linear(HdCurve curve, double display);

#endif
