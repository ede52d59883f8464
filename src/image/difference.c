/* SPDX-License-Identifier: MIT */
#include "image/difference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- quantiles ---- */

/* The bits of non-negative doubles are ordered as the numbers; the upper bits select the bucket. */
enum {
    FRACTION_BITS = 52,
    KEPT_BITS = 11,
    BIAS = 1023,
    MIN_POWER = -60,
    MAX_POWER = 130,
    BUCKETS = (MAX_POWER - MIN_POWER) << KEPT_BITS
};

HdStatus hd_quantile_create(HdQuantile *quantile, HdError *error) {
    *quantile = (HdQuantile){.buckets = calloc(BUCKETS, sizeof *quantile->buckets)};
    if (quantile->buckets == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to sort numbers");
    return HD_OK;
}

void hd_quantile_free(HdQuantile *quantile) {
    free(quantile->buckets);
    *quantile = (HdQuantile){0};
}

static int64_t bucket_of(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    int64_t bucket =
        (int64_t)(bits >> (FRACTION_BITS - KEPT_BITS)) - ((int64_t)(BIAS + MIN_POWER) << KEPT_BITS);
    if (bucket < 0)
        return 0;
    return bucket < BUCKETS ? bucket : BUCKETS - 1;
}

void hd_quantile_add(HdQuantile *quantile, double value) {
    HdQuantileBucket *bucket = &quantile->buckets[bucket_of(value)];
    bucket->count++;
    if (value > bucket->largest)
        bucket->largest = value;
    quantile->count++;
}

double hd_quantile_above(const HdQuantile *quantile, uint64_t out_of) {
    const uint64_t allowed = quantile->count / out_of;
    uint64_t above = 0;
    for (int i = BUCKETS; i-- > 0;) {
        const HdQuantileBucket *bucket = &quantile->buckets[i];
        if (above + bucket->count > allowed)
            return bucket->largest;
        above += bucket->count;
    }
    return (double)NAN;
}

/* ---- pictures ---- */

enum { CHANNELS = 3 };

typedef struct Space {
    double sum, sum_of_squares;         /* previous rows */
    double row_sum, row_sum_of_squares; /* separate, to limit rounding errors */
    double largest;
    int x, y, channel;
    HdQuantile pixels;
} Space;

struct HdPictureDifference {
    Space display, linear; /* display: in 1/257 of 1/255 */
    bool clamps;
    int rows;
    uint64_t pixels, not_finite[2], above_1, above_8;
};

HdStatus hd_difference_create(HdPictureDifference **out, bool clamps, HdError *error) {
    HdPictureDifference *difference = calloc(1, sizeof *difference);
    if (difference == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to compare pictures");
    difference->clamps = clamps;
    HdStatus status = hd_quantile_create(&difference->display.pixels, error);
    if (status == HD_OK)
        status = hd_quantile_create(&difference->linear.pixels, error);
    if (status != HD_OK)
        hd_difference_free(difference);
    else
        *out = difference;
    return status;
}

void hd_difference_free(HdPictureDifference *difference) {
    if (difference == NULL)
        return;
    hd_quantile_free(&difference->display.pixels);
    hd_quantile_free(&difference->linear.pixels);
    free(difference);
}

/* ---- adding ---- */

static int count_not_finite(const HdPictureValue pixel[CHANNELS]) {
    int count = 0;
    for (int c = 0; c < CHANNELS; c++)
        count += !isfinite(pixel[c].linear);
    return count;
}

static double clamped(double value) {
    return value < 0.0 ? 0.0 : value > 1.0 ? 1.0 : value;
}

/* Adds a pixel and returns its error. */
static double add_pixel(Space *space, const double errors[CHANNELS], int x, int y) {
    double largest = 0.0;
    for (int c = 0; c < CHANNELS; c++) {
        const double size = errors[c];
        space->row_sum += size;
        space->row_sum_of_squares += size * size;
        if (size > largest)
            largest = size;
        if (size > space->largest) {
            space->largest = size;
            space->x = x;
            space->y = y;
            space->channel = c;
        }
    }
    hd_quantile_add(&space->pixels, largest);
    return largest;
}

static void end_row(Space *space) {
    space->sum += space->row_sum;
    space->sum_of_squares += space->row_sum_of_squares;
    space->row_sum = space->row_sum_of_squares = 0.0;
}

static double compare_pixel(HdPictureDifference *difference, const HdPictureValue *first,
                            const HdPictureValue *second, int x) {
    double display[CHANNELS], linear[CHANNELS];
    for (int c = 0; c < CHANNELS; c++) {
        display[c] = fabs(first[c].display - second[c].display);
        linear[c] = difference->clamps ? fabs(clamped(first[c].linear) - clamped(second[c].linear))
                                       : fabs(first[c].linear - second[c].linear);
    }
    add_pixel(&difference->linear, linear, x, difference->rows);
    const double error = add_pixel(&difference->display, display, x, difference->rows);
    difference->pixels++;
    difference->above_1 += error > HD_DISPLAY_STEP;
    difference->above_8 += error > 8.0 * HD_DISPLAY_STEP;
    return error / HD_DISPLAY_STEP;
}

void hd_difference_add_row(HdPictureDifference *difference, const HdPictureValue *first,
                           const HdPictureValue *second, int width, double *errors) {
    for (int x = 0; x < width; x++, first += CHANNELS, second += CHANNELS) {
        const int wrong_first = count_not_finite(first), wrong_second = count_not_finite(second);
        difference->not_finite[0] += (uint64_t)wrong_first;
        difference->not_finite[1] += (uint64_t)wrong_second;
        const double error = wrong_first + wrong_second > 0
                                 ? (double)NAN
                                 : compare_pixel(difference, first, second, x);
        if (errors != NULL)
            errors[x] = error;
    }
    end_row(&difference->display);
    end_row(&difference->linear);
    difference->rows++;
}

void hd_channel_difference_add(HdChannelDifference *difference, float first, float second, int x,
                               int y) {
    double size = fabs((double)first - (double)second);
    if (first == second || (isnan(first) && isnan(second)))
        size = 0.0;
    else if (!isfinite(size))
        size = (double)INFINITY;
    if (size > difference->largest)
        *difference = (HdChannelDifference){size, x, y};
}

/* ---- figures ---- */

/* Computes the figures; `unit` divides the values, and `peak` is their maximum after that. */
static HdDifferenceFigures figures_of(const Space *space, uint64_t pixels, double unit,
                                      double peak) {
    if (pixels == 0)
        return (HdDifferenceFigures){(double)NAN, (double)NAN, (double)NAN, (double)NAN,
                                     -1,          -1,          -1,          (double)NAN};
    const double values = (double)pixels * CHANNELS;
    const bool differs = space->largest > 0.0;
    HdDifferenceFigures figures = {
        .rmse = sqrt(space->sum_of_squares / values) / unit,
        .mean = space->sum / values / unit,
        .largest = space->largest / unit,
        .x = differs ? space->x : -1,
        .y = differs ? space->y : -1,
        .channel = differs ? space->channel : -1,
        .p999 = hd_quantile_above(&space->pixels, 1000) / unit,
    };
    figures.psnr = figures.rmse > 0.0 ? 20.0 * log10(peak / figures.rmse) : (double)INFINITY;
    return figures;
}

void hd_difference_figures(const HdPictureDifference *difference, HdPictureFigures *figures) {
    const uint64_t pixels = difference->pixels;
    *figures = (HdPictureFigures){
        .pixels = pixels,
        .not_finite = {difference->not_finite[0], difference->not_finite[1]},
        .display = figures_of(&difference->display, pixels, HD_DISPLAY_STEP, 255.0),
        .linear = figures_of(&difference->linear, pixels, 1.0, 1.0),
        .above_1 = pixels > 0 ? (double)difference->above_1 / (double)pixels : (double)NAN,
        .above_8 = pixels > 0 ? (double)difference->above_8 / (double)pixels : (double)NAN,
    };
    figures->identical = difference->not_finite[0] + difference->not_finite[1] == 0 &&
                         !(figures->linear.largest > 0.0 || figures->display.largest > 0.0);
}

/* ---- heat maps ---- */

static const double LEAST = 0.25; /* error of the first colour */
enum { DOUBLINGS = 10 };

/* Lightness (CIE L*) rises from 14 to 97 in equal steps. */
static const uint8_t colours[DOUBLINGS + 1][3] = {
    {53, 10, 90},   {89, 17, 107},  {127, 31, 106}, {164, 45, 95},  {198, 63, 76},   {225, 89, 51},
    {243, 120, 25}, {250, 155, 13}, {249, 191, 41}, {247, 223, 90}, {252, 252, 156},
};
static const uint8_t no_error[3] = {0, 0, 0}, no_number[3] = {0, 255, 255};

void hd_heat_colour(double error, uint8_t rgb[3]) {
    if (isnan(error) || error < LEAST) {
        memcpy(rgb, isnan(error) ? no_number : no_error, 3);
        return;
    }
    const double place = fmin(log2(error / LEAST), DOUBLINGS);
    const int below = place < DOUBLINGS ? (int)place : DOUBLINGS - 1;
    for (int c = 0; c < 3; c++) {
        const double from = colours[below][c], to = colours[below + 1][c];
        rgb[c] = (uint8_t)lround(from + (place - below) * (to - from));
    }
}
