/* SPDX-License-Identifier: MIT */
#include "image/difference.h"
#include "unit_test.h"

/* A grey pixel whose display value is `steps` of 255 and whose light is `linear`. */
#define GREY(steps, light)                                                                         \
    {(light), (steps)*HD_DISPLAY_STEP}, {(light), (steps)*HD_DISPLAY_STEP}, {                      \
        (light), (steps)*HD_DISPLAY_STEP                                                           \
    }

static HdPictureFigures compare(const HdPictureValue *first, const HdPictureValue *second,
                                int width, int height, bool clamps, double *errors) {
    HdError error = {0};
    HdPictureDifference *difference;
    HdPictureFigures figures;
    assert_int_equal(hd_difference_create(&difference, clamps, &error), HD_OK);
    for (int y = 0; y < height; y++)
        hd_difference_add_row(difference, first + 3 * width * y, second + 3 * width * y, width,
                              errors != NULL ? errors + width * y : NULL);
    hd_difference_figures(difference, &figures);
    hd_difference_free(difference);
    return figures;
}

/* 2 x 2 pixels. Display errors by channel: 3 4 0, 0 0 0, 1 1 1, 0 12 0: their sum is 22, that of
   their squares 9 + 16 + 3 + 144 = 172. Linear ones: 0.25 in one channel. */
TEST(figures_are_those_of_the_formulas) {
    const double s = HD_DISPLAY_STEP;
    const HdPictureValue first[] = {{0.5, 10 * s}, {0, 20 * s}, {0, 30 * s},  GREY(7, 1),
                                    GREY(100, 2),  {0, 0},      {0, 200 * s}, {0, 5 * s}};
    const HdPictureValue second[] = {{0.5, 13 * s}, {0, 16 * s}, {0, 30 * s},     GREY(7, 1),
                                     GREY(101, 2),  {0, 0},      {0.25, 188 * s}, {0, 5 * s}};
    double errors[4];
    const HdPictureFigures figures = compare(first, second, 2, 2, false, errors);
    assert_int_equal(figures.pixels, 4);
    expect_near(figures.display.rmse, sqrt(172.0 / 12.0), 1e-15);
    expect_near(figures.display.mean, 22.0 / 12.0, 1e-15);
    expect_near(figures.display.psnr, 10.0 * log10(255.0 * 255.0 / (172.0 / 12.0)), 1e-12);
    assert_true(figures.display.largest == 12.0);
    assert_int_equal(figures.display.x, 1);
    assert_int_equal(figures.display.y, 1);
    assert_int_equal(figures.display.channel, 1);
    assert_true(figures.display.p999 == 12.0);
    assert_true(figures.above_1 == 0.5); /* 4 and 12; 1 is not more than 1 */
    assert_true(figures.above_8 == 0.25);
    expect_near(figures.linear.rmse, 0.25 / sqrt(12.0), 1e-16);
    expect_near(figures.linear.mean, 0.25 / 12.0, 1e-16);
    expect_near(figures.linear.psnr, 10.0 * log10(12.0 * 16.0), 1e-12);
    assert_true(figures.linear.largest == 0.25);
    assert_int_equal(figures.linear.channel, 1);
    const double expected[] = {4.0, 0.0, 1.0, 12.0};
    assert_memory_equal(errors, expected, sizeof errors);
    assert_false(figures.identical);
}

/* One step of 8 bits is exact in 16, and not more than one. */
TEST(the_first_of_equal_errors_is_named) {
    const HdPictureValue first[] = {GREY(0, 0), GREY(7, 0), GREY(7, 0), GREY(7, 0)};
    const HdPictureValue second[] = {GREY(0, 0), GREY(8, 0.5), GREY(8, 0.5), GREY(8, 0.5)};
    const HdPictureFigures figures = compare(first, second, 2, 2, false, NULL);
    assert_true(figures.display.largest == 1.0 && figures.above_1 == 0.0);
    assert_int_equal(figures.display.x, 1);
    assert_int_equal(figures.display.y, 0);
    assert_int_equal(figures.display.channel, 0);
    assert_int_equal(figures.linear.x, 1);
}

/* Equal on the screen, but not in light. */
TEST(clamping_is_a_choice) {
    const HdPictureValue first[] = {GREY(255, 1), GREY(0, 0)};
    const HdPictureValue second[] = {GREY(255, 5), GREY(0, -2)};
    HdPictureFigures figures = compare(first, second, 2, 1, false, NULL);
    assert_true(figures.linear.largest == 4.0);
    assert_false(figures.identical);
    assert_true(figures.display.largest == 0.0);
    figures = compare(first, second, 2, 1, true, NULL);
    assert_true(figures.linear.largest == 0.0);
    assert_true(figures.identical && isinf(figures.linear.psnr));
    assert_int_equal(figures.linear.channel, -1);
}

TEST(values_that_are_no_numbers_are_counted_and_left_out) {
    const double nan = (double)NAN, infinite = (double)INFINITY;
    const HdPictureValue first[] = {
        {nan, nan}, {infinite, 65535.0}, {0, 0}, GREY(9, 1), GREY(1, 0)};
    const HdPictureValue second[] = {GREY(1, 1), {0, 0}, {-infinite, 0}, {0, 0}, GREY(3, 0)};
    double errors[3];
    HdPictureFigures figures = compare(first, second, 3, 1, false, errors);
    assert_int_equal(figures.pixels, 1);
    assert_int_equal(figures.not_finite[0], 2);
    assert_int_equal(figures.not_finite[1], 1);
    assert_true(figures.display.rmse == 2.0 && figures.display.largest == 2.0);
    assert_int_equal(figures.display.x, 2);
    assert_true(figures.above_1 == 1.0);
    assert_true(isnan(errors[0]) && isnan(errors[1]) && errors[2] == 2.0);
    figures = compare(first, first, 1, 1, false, NULL); /* no figures at all */
    assert_int_equal(figures.pixels, 0);
    assert_true(isnan(figures.display.rmse) && isnan(figures.linear.p999));
    assert_true(isnan(figures.above_1) && !figures.identical);
    assert_int_equal(figures.display.x, -1);
}

/* Compares quantiles of the values, or if there are none, of the multiples of `step`. */
static double quantile_of(int count, const double *values, double step, uint64_t out_of) {
    HdError error = {0};
    HdQuantile quantile;
    assert_int_equal(hd_quantile_create(&quantile, &error), HD_OK);
    for (int i = 0; i < count; i++)
        hd_quantile_add(&quantile, values != NULL ? values[i] : i * step);
    const double result = hd_quantile_above(&quantile, out_of);
    hd_quantile_free(&quantile);
    return result;
}

TEST(quantiles_leave_one_in_so_many_above) {
    const double extreme[] = {0.0, 1e-300, 1e-30, 1.0, 1e30, 1e300};
    assert_true(quantile_of(1000, NULL, 1.0, 1000) == 998.0); /* only 999 is above */
    assert_true(quantile_of(999, NULL, 1.0, 1000) == 998.0);  /* none may be above */
    assert_true(quantile_of(2048, NULL, 1.0, 4) == 1535.0);
    assert_true(isnan(quantile_of(0, NULL, 1.0, 1000)));
    const double found = quantile_of(100000, NULL, 1e-3, 10);
    assert_true(found >= 89.999 && found <= 89.999 * (1.0 + 1.0 / 2048.0));
    assert_true(quantile_of(6, extreme, 0.0, 6) == 1e30);
    assert_true(quantile_of(6, extreme, 0.0, 7) == 1e300);
    assert_true(quantile_of(6, extreme, 0.0, 2) == 1e-30);
}

TEST(further_channels_differ_by_their_values) {
    HdChannelDifference difference = {0};
    hd_channel_difference_add(&difference, 5.0F, 5.0F, 1, 1);
    hd_channel_difference_add(&difference, INFINITY, INFINITY, 2, 1);
    hd_channel_difference_add(&difference, NAN, NAN, 3, 1);
    assert_true(difference.largest == 0.0);
    hd_channel_difference_add(&difference, 1.0F, 1.25F, 4, 2);
    hd_channel_difference_add(&difference, 3.25F, 3.0F, 5, 2);
    assert_true(difference.largest == 0.25 && difference.x == 4 && difference.y == 2);
    hd_channel_difference_add(&difference, 1.0F, NAN, 6, 3);
    hd_channel_difference_add(&difference, INFINITY, 0.0F, 7, 3);
    assert_true(isinf(difference.largest) && difference.x == 6 && difference.y == 3);
}
