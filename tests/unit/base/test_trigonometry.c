/* SPDX-License-Identifier: MIT */
#include <float.h>

#include "base/trigonometry.h"
#include "unit_test.h"

static const double tolerance = 2.0 * DBL_EPSILON;

/* Against the system's library, which is right to the last bit or nearly so. */
static void compare(double x, double library_argument) {
    double sine, cosine, mirrored_sine, mirrored_cosine;
    hd_sine_cosine(x, &sine, &cosine);
    if (!(fabs(sine - sin(library_argument)) <= tolerance))
        fail_msg("sine of %.17g is %.17g, expected %.17g", x, sine, sin(library_argument));
    if (!(fabs(cosine - cos(library_argument)) <= tolerance))
        fail_msg("cosine of %.17g is %.17g, expected %.17g", x, cosine, cos(library_argument));
    hd_sine_cosine(-x, &mirrored_sine, &mirrored_cosine);
    if (mirrored_sine != -sine || mirrored_cosine != cosine || fabs(sine) > 1.0 ||
        fabs(cosine) > 1.0)
        fail_msg("sine and cosine of %.17g and of its negative are no pair", x);
}

TEST(test_up_to_the_end_of_the_exact_reduction) {
    for (int i = 0; i <= 100000; i++)
        compare(i * (HD_PI / 50000.0), i * (HD_PI / 50000.0));
    for (double x = 1e-320; x < 1e5; x *= 1.001)
        compare(x, x);
    for (int i = 0; i < 200000; i++) {
        compare(i * 0.49999, i * 0.49999);
        compare(1e6 - i * 0.7071, 1e6 - i * 0.7071);
    }
    compare(1e5, 1e5);
}

TEST(test_neighbours_of_the_quadrants) {
    for (int k = 0; k <= 60000; k++) {
        const double at = k * (HD_PI / 4.0);
        compare(at, at);
        compare(nextafter(at, 1e9), nextafter(at, 1e9));
        compare(nextafter(at, -1e9), nextafter(at, -1e9));
    }
}

TEST(test_huge_arguments_are_taken_modulo_the_double_two_pi) {
    for (double x = 1.1e6; x < DBL_MAX / 2.0; x *= 1.37)
        compare(x, fmod(x, 2.0 * HD_PI));
    compare(DBL_MAX, fmod(DBL_MAX, 2.0 * HD_PI));
}

TEST(test_zero_is_exact) {
    double sine, cosine;
    hd_sine_cosine(0.0, &sine, &cosine);
    assert_true(sine == 0.0 && !signbit(sine) && cosine == 1.0);
    hd_sine_cosine(-0.0, &sine, &cosine);
    assert_true(sine == 0.0 && signbit(sine) && cosine == 1.0);
}

TEST(test_not_finite) {
    const double arguments[3] = {HUGE_VAL, -HUGE_VAL, (double)NAN};
    for (int i = 0; i < 3; i++) {
        double sine = 0.0, cosine = 0.0;
        hd_sine_cosine(arguments[i], &sine, &cosine);
        assert_true(isnan(sine) && isnan(cosine));
    }
}
