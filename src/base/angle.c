/* SPDX-License-Identifier: MIT */
#include "base/angle.h"

#include "base/trigonometry.h"

/* The arc tangent of 0..1. Halving the angle twice leaves at most tan(pi / 16) = 0.199, where the
   first term that is left out of the series is below 1e-18. */
static double arc_tangent(double t) {
    const double half = t / (1.0 + sqrt(1.0 + t * t));
    const double x = half / (1.0 + sqrt(1.0 + half * half));
    const double y = x * x;
    double sum = 1.0 / 23.0;
    for (int odd = 21; odd >= 1; odd -= 2)
        sum = 1.0 / odd - y * sum;
    return 4.0 * (x * sum);
}

double hd_angle(HdVec3 a, HdVec3 b) {
    const double sine = hd_length(hd_cross(a, b));
    const double cosine = hd_dot(a, b);
    if (sine == 0.0)
        return cosine < 0.0 ? HD_PI : 0.0;
    const double size = fabs(cosine);
    const double acute =
        sine <= size ? arc_tangent(sine / size) : HD_PI / 2.0 - arc_tangent(size / sine);
    return cosine < 0.0 ? HD_PI - acute : acute;
}
