/* SPDX-License-Identifier: MIT */
#include <float.h>

#include "base/trigonometry.h"
#include "unit_test.h"

static const double tolerance = 2.0 * DBL_EPSILON;

/* Compares with the system's library, which is exact or nearly so. */
static void compare(double x, double library_argument) {
    double sine, cosine, mirrored_sine, mirrored_cosine;
    hd_sine_cosine(x, &sine, &cosine);
    hd_sine_cosine(-x, &mirrored_sine, &mirrored_cosine);
    if (!(fabs(sine - sin(library_argument)) <= tolerance) ||
        !(fabs(cosine - cos(library_argument)) <= tolerance))
        fail_msg("sine and cosine of %.17g are %.17g and %.17g", x, sine, cosine);
    if (mirrored_sine != -sine || mirrored_cosine != cosine || fabs(sine) > 1.0 ||
        fabs(cosine) > 1.0)
        fail_msg("sine and cosine of %.17g and of its negative are no pair", x);
}

TEST(test_up_to_the_end_of_the_exact_reduction) {
    for (double x = 1e-320; x < 1e5; x *= 1.001)
        compare(x, x);
    for (int i = 0; i < 60000; i++) {
        const double quadrant = i * (HD_PI / 4.0);
        const double arguments[] = {
            i * (HD_PI / 30000.0),    1e6 - i * 0.7071,          quadrant,
            nextafter(quadrant, 1e9), nextafter(quadrant, -1e9), i * 1.6666};
        for (int k = 0; k < 6; k++)
            compare(arguments[k], arguments[k]);
    }
    compare(1e5, 1e5);
}

TEST(test_huge_arguments_are_taken_modulo_the_double_two_pi) {
    for (double x = 1.1e6; x < DBL_MAX / 2.0; x *= 1.37)
        compare(x, fmod(x, 2.0 * HD_PI));
    compare(DBL_MAX, fmod(DBL_MAX, 2.0 * HD_PI));
}

TEST(test_zeros_and_what_is_not_finite) {
    const double arguments[] = {0.0, -0.0, HUGE_VAL, -HUGE_VAL, (double)NAN};
    for (int i = 0; i < 5; i++) {
        double sine = 0.5, cosine = 0.5;
        hd_sine_cosine(arguments[i], &sine, &cosine);
        if (i >= 2)
            assert_true(isnan(sine) && isnan(cosine));
        else
            assert_true(sine == 0.0 && signbit(sine) == signbit(arguments[i]) && cosine == 1.0);
    }
}
