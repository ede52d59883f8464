/* SPDX-License-Identifier: MIT */
/* The transfer curve between linear light and the numbers in a file. Every value is made of sums,
   products, quotients and square roots in double, so the tables are the same on every system. */
#ifndef HD_IMAGE_CURVE_H
#define HD_IMAGE_CURVE_H

#include <stddef.h>
#include <stdint.h>

typedef enum HdCurve {
    HD_CURVE_LINEAR,
    HD_CURVE_SRGB, /* IEC 61966-2-1 */
    HD_CURVES
} HdCurve;

/* Each value is clamped to 0..1 (NaN counts as 0), put on the curve, and rounded to the nearest of
   256 or 65536 steps. */
void hd_curve_encode8(HdCurve curve, const float *values, size_t count, uint8_t *out);
void hd_curve_encode16(HdCurve curve, const float *values, size_t count, uint16_t *out);

/* As hd_curve_encode8 for r, g, b of each pixel, each followed by an alpha of 255. */
void hd_curve_encode_rgba(HdCurve curve, const float *rgb, size_t pixels, uint8_t *rgba);

/* By code: the bits of the least float that hd_curve_encode8 gives it; 0 for the code 0. A value
   has the greatest code whose threshold is not above it. */
void hd_curve_thresholds8(HdCurve curve, int32_t thresholds[256]);

/* The way back, in place, 0..65535 for 0..1; each code is worked out once in a call. */
void hd_curve_decode16(HdCurve curve, uint16_t *values, size_t count);

/* The curve itself in double, for 0..1; what lies outside is clamped. NaN stays. */
double hd_curve_to_display(HdCurve curve, double linear);
double hd_curve_to_linear(HdCurve curve, double display);

#endif
