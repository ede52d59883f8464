/* SPDX-License-Identifier: MIT */
#include "base/quantile.h"
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

TEST(the_first_of_equal_errors_is_named) {
    const HdPictureValue first[] = {GREY(0, 0), GREY(0, 0), GREY(0, 0), GREY(0, 0)};
    const HdPictureValue second[] = {GREY(0, 0), GREY(2, 0.5), GREY(2, 0.5), GREY(2, 0.5)};
    const HdPictureFigures figures = compare(first, second, 2, 2, false, NULL);
    assert_int_equal(figures.display.x, 1);
    assert_int_equal(figures.display.y, 0);
    assert_int_equal(figures.display.channel, 0);
    assert_int_equal(figures.linear.x, 1);
    assert_int_equal(figures.linear.y, 0);
}

TEST(equal_pictures_are_identical) {
    const HdPictureValue values[] = {GREY(0, 0), GREY(255, 1e30), GREY(3, -1)};
    const HdPictureFigures figures = compare(values, values, 3, 1, false, NULL);
    assert_true(figures.identical);
    assert_true(isinf(figures.display.psnr) && figures.display.psnr > 0.0);
    assert_true(isinf(figures.linear.psnr));
    assert_true(figures.display.rmse == 0.0 && figures.linear.p999 == 0.0);
    assert_int_equal(figures.display.channel, -1);
    assert_int_equal(figures.linear.x, -1);
}

/* Alike on the screen, but not in light. */
TEST(clamping_is_a_choice) {
    const HdPictureValue first[] = {GREY(255, 1), GREY(0, 0)};
    const HdPictureValue second[] = {GREY(255, 5), GREY(0, -2)};
    HdPictureFigures figures = compare(first, second, 2, 1, false, NULL);
    assert_true(figures.linear.largest == 4.0);
    assert_false(figures.identical);
    assert_true(figures.display.largest == 0.0);
    figures = compare(first, second, 2, 1, true, NULL);
    assert_true(figures.linear.largest == 0.0);
    assert_true(figures.identical);
}

TEST(values_that_are_no_numbers_are_counted_and_left_out) {
    const double nan = (double)NAN, infinite = (double)INFINITY;
    const HdPictureValue first[] = {
        {nan, nan}, {infinite, 65535.0}, {0, 0}, GREY(9, 1), GREY(1, 0)};
    const HdPictureValue second[] = {GREY(1, 1), {0, 0}, {-infinite, 0}, {0, 0}, GREY(3, 0)};
    double errors[3];
    const HdPictureFigures figures = compare(first, second, 3, 1, false, errors);
    assert_int_equal(figures.pixels, 1);
    assert_int_equal(figures.not_finite[0], 2);
    assert_int_equal(figures.not_finite[1], 1);
    assert_true(figures.display.rmse == 2.0 && figures.display.largest == 2.0);
    assert_int_equal(figures.display.x, 2);
    assert_true(figures.above_1 == 1.0);
    assert_true(isnan(errors[0]) && isnan(errors[1]) && errors[2] == 2.0);
}

TEST(without_a_finite_pixel_there_are_no_figures) {
    const double nan = (double)NAN;
    const HdPictureValue values[] = {{0, 0}, {nan, nan}, {0, 0}};
    const HdPictureFigures figures = compare(values, values, 1, 1, false, NULL);
    assert_int_equal(figures.pixels, 0);
    assert_true(isnan(figures.display.rmse) && isnan(figures.linear.p999));
    assert_true(isnan(figures.above_1));
    assert_int_equal(figures.display.x, -1);
    assert_false(figures.identical);
}

/* 16 bits have 257 values between those of 8 bits; exactly one step is not more than one. */
TEST(one_step_is_exact_with_16_bits) {
    for (int code = 0; code + 257 <= 65535; code += 4099) {
        const HdPictureValue first[] = {{0, code}, {0, code}, {0, code}};
        const HdPictureValue second[] = {{0, code + 257}, {0, code}, {0, code}};
        const HdPictureFigures figures = compare(first, second, 1, 1, false, NULL);
        assert_true(figures.display.largest == 1.0);
        assert_true(figures.above_1 == 0.0);
    }
}

static double quantile_of(int count, double (*value)(int), uint64_t out_of) {
    HdError error = {0};
    HdQuantile quantile;
    assert_int_equal(hd_quantile_create(&quantile, &error), HD_OK);
    for (int i = 0; i < count; i++)
        hd_quantile_add(&quantile, value(i));
    const double result = hd_quantile_above(&quantile, out_of);
    hd_quantile_free(&quantile);
    return result;
}

static double itself(int i) {
    return i;
}

static double fine(int i) {
    return 1e-3 * i + 1e-4;
}

static double extreme(int i) {
    const double values[] = {0.0, 1e-300, 1e-30, 1.0, 1e30, 1e300};
    return values[i];
}

TEST(quantiles_leave_one_in_so_many_above) {
    assert_true(quantile_of(1000, itself, 1000) == 998.0); /* 999 alone is above */
    assert_true(quantile_of(999, itself, 1000) == 998.0);  /* none may be above */
    assert_true(quantile_of(2000, itself, 1000) == 1997.0);
    assert_true(quantile_of(2048, itself, 4) == 1535.0);
    assert_true(quantile_of(1, itself, 1000) == 0.0);
    assert_true(isnan(quantile_of(0, itself, 1000)));
    for (int count = 10; count <= 100000; count *= 10) {
        const double exact = fine(count - count / 10 - 1), found = quantile_of(count, fine, 10);
        assert_true(found >= exact && found <= exact * (1.0 + 1.0 / 2048.0));
    }
    assert_true(quantile_of(6, extreme, 6) == 1e30);
    assert_true(quantile_of(6, extreme, 7) == 1e300);
    assert_true(quantile_of(6, extreme, 2) == 1e-30);
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
