/* SPDX-License-Identifier: MIT */
/* Sine, cosine and angles whose bytes do not depend on a system's mathematics library. */
#ifndef HD_BASE_TRIGONOMETRY_H
#define HD_BASE_TRIGONOMETRY_H

#include "base/vector.h"

#define HD_PI 3.14159265358979323846

/* Both in one call; at most 2 units in the last place of 1 off for |x| <= 1e5, and for larger
   finite arguments as good as their reduction by fmod to a double 2 pi allows. */
void hd_sine_cosine(double x, double *sine, double *cosine);

/* The angle between two vectors of any length in radians, 0..pi, within 1e-15; 0 where one of them
   is 0. */
double hd_angle(HdVec3 a, HdVec3 b);

#endif
