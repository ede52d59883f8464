/* SPDX-License-Identifier: MIT */
#include <float.h>

#include "base/trigonometry.h"
#include "unit_test.h"

static const double tolerance = 2.0 * DBL_EPSILON;

/* Both against the system's library, which is right to the last bit or nearly so. */
static void compare(double x, double library_argument) {
    double sine, cosine;
    hd_sine_cosine(x, &sine, &cosine);
    if (!(fabs(sine - sin(library_argument)) <= tolerance))
        fail_msg("sine of %.17g is %.17g, expected %.17g", x, sine, sin(library_argument));
    if (!(fabs(cosine - cos(library_argument)) <= tolerance))
        fail_msg("cosine of %.17g is %.17g, expected %.17g", x, cosine, cos(library_argument));
}

TEST(test_one_turn) {
    for (int i = -100000; i <= 100000; i++)
        compare(i * (HD_PI / 50000.0), i * (HD_PI / 50000.0));
}

TEST(test_up_to_the_promised_limit) {
    for (double x = 1e-320; x < 1e5; x *= 1.001) {
        compare(x, x);
        compare(-x, -x);
    }
    for (int i = 0; i < 200000; i++)
        compare(i * 0.49999, i * 0.49999);
    compare(1e5, 1e5);
}

TEST(test_up_to_the_end_of_the_exact_reduction) {
    for (int i = 0; i < 100000; i++)
        compare(1e6 - i * 0.7071, 1e6 - i * 0.7071);
    compare(1e6, 1e6);
}

TEST(test_neighbours_of_the_quadrants) {
    for (int k = -60000; k <= 60000; k++) {
        const double at = k * (HD_PI / 4.0);
        compare(at, at);
        compare(nextafter(at, 1e9), nextafter(at, 1e9));
        compare(nextafter(at, -1e9), nextafter(at, -1e9));
    }
}

TEST(test_huge_arguments_are_taken_modulo_the_double_two_pi) {
    for (double x = 1.1e6; x < DBL_MAX / 2.0; x *= 1.37) {
        const double rest = fmod(x, 2.0 * HD_PI);
        compare(x, rest);
        compare(-x, -rest);
    }
    compare(DBL_MAX, fmod(DBL_MAX, 2.0 * HD_PI));
}

TEST(test_quadrant_points) {
    static const double expected[4][2] = {{0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}};
    for (int k = 0; k < 400; k++) {
        double sine, cosine;
        hd_sine_cosine(k * (HD_PI / 2.0), &sine, &cosine);
        /* The argument itself is off by the rounding of pi / 2 and of its product with k. */
        const double off = 2.0 * (k + 1) * DBL_EPSILON;
        expect_near(sine, expected[k % 4][0], off);
        expect_near(cosine, expected[k % 4][1], off);
    }
}

TEST(test_zero_is_exact) {
    double sine, cosine;
    hd_sine_cosine(0.0, &sine, &cosine);
    assert_true(sine == 0.0 && !signbit(sine) && cosine == 1.0);
    hd_sine_cosine(-0.0, &sine, &cosine);
    assert_true(sine == 0.0 && signbit(sine) && cosine == 1.0);
}

TEST(test_symmetries_are_exact) {
    for (double x = 1e-10; x < 1e12; x *= 1.01) {
        double sine, cosine, mirrored_sine, mirrored_cosine;
        hd_sine_cosine(x, &sine, &cosine);
        hd_sine_cosine(-x, &mirrored_sine, &mirrored_cosine);
        assert_true(mirrored_sine == -sine && mirrored_cosine == cosine);
        assert_true(fabs(sine) <= 1.0 && fabs(cosine) <= 1.0);
        expect_near(sine * sine + cosine * cosine, 1.0, 4.0 * DBL_EPSILON);
    }
}

TEST(test_not_finite) {
    const double arguments[3] = {HUGE_VAL, -HUGE_VAL, (double)NAN};
    for (int i = 0; i < 3; i++) {
        double sine = 0.0, cosine = 0.0;
        hd_sine_cosine(arguments[i], &sine, &cosine);
        assert_true(isnan(sine) && isnan(cosine));
    }
}
