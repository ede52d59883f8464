/* SPDX-License-Identifier: MIT */
/* Sine, cosine and angles, bit-identical with every mathematics library. */
#ifndef HD_BASE_TRIGONOMETRY_H
#define HD_BASE_TRIGONOMETRY_H

#include "base/vector.h"

#define HD_PI 3.14159265358979323846

/* Computes both functions of `x`, in radians. The error is at most 2 units in the last place of 1
   for |x| <= 1e5. Larger finite arguments are reduced by fmod to the double 2 pi. */
void hd_sine_cosine(double x, double *sine, double *cosine);

/* Returns the angle between two vectors of any length in radians, 0..pi, within 1e-15; 0 if one is
   0. */
double hd_angle(HdVec3 a, HdVec3 b);

#endif
