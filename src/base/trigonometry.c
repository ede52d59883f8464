/* SPDX-License-Identifier: MIT */
#include "base/trigonometry.h"

#include <math.h>

/* The method of Cody and Waite: pi/2 in three parts of 33 bits, so that k times a part is exact for
   |k| < 2^20. A fourth part would be below 1e-31. */
#define HALF_PI_1 0x1.921fb544p+0
#define HALF_PI_2 0x1.0b4611a6p-34
#define HALF_PI_3 0x1.3198a2ep-69

#define TWO_OVER_PI (2.0 / HD_PI)

/* Above this bound k could reach 2^20 = 1.04e6. */
static const double max_reduced = 1e6;

/* Taylor series; the first omitted term is below 1e-19 on [-pi/4, pi/4]. All factorials up to 18!
   are exact in double. */
static const double sine_terms[] = {
    1.0 / 355687428096000.0, -1.0 / 1307674368000.0, 1.0 / 6227020800.0, -1.0 / 39916800.0,
    1.0 / 362880.0,          -1.0 / 5040.0,          1.0 / 120.0,        -1.0 / 6.0};
static const double cosine_terms[] = {-1.0 / 6402373705728000.0,
                                      1.0 / 20922789888000.0,
                                      -1.0 / 87178291200.0,
                                      1.0 / 479001600.0,
                                      -1.0 / 3628800.0,
                                      1.0 / 40320.0,
                                      -1.0 / 720.0,
                                      1.0 / 24.0,
                                      -1.0 / 2.0};

static double sum_terms(const double *terms, int count, double y) {
    double sum = terms[0];
    for (int i = 1; i < count; i++)
        sum = sum * y + terms[i];
    return y * sum;
}

void hd_sine_cosine(double x, double *sine, double *cosine) {
    if (!isfinite(x)) {
        *sine = *cosine = (double)NAN;
        return;
    }
    /* Working on |x| makes the sine exactly odd and the cosine exactly even. */
    double rest = fabs(x);
    if (rest > max_reduced)
        rest = fmod(rest, 2.0 * HD_PI); /* exact for the double 2 pi, which itself is rounded */
    const double quotient = floor(rest * TWO_OVER_PI + 0.5);
    rest = ((rest - quotient * HALF_PI_1) - quotient * HALF_PI_2) - quotient * HALF_PI_3;
    const double s = rest + rest * sum_terms(sine_terms, 8, rest * rest);
    const double c = 1.0 + sum_terms(cosine_terms, 9, rest * rest);
    const int quadrant = (int)quotient & 3;
    const double absolute_sine = (quadrant & 1) ? c : s;
    const double absolute_cosine = (quadrant & 1) ? s : c;
    const double upper = (quadrant & 2) ? -absolute_sine : absolute_sine;
    *sine = signbit(x) ? -upper : upper;
    *cosine = (quadrant == 1 || quadrant == 2) ? -absolute_cosine : absolute_cosine;
}

/* Returns the arc tangent of t in 0..1. Halving the angle twice leaves at most tan(pi / 16) =
   0.199. The first omitted term of the series is then below 1e-18. */
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
