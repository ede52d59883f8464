/* SPDX-License-Identifier: MIT */
/* Difference of two pictures of one size, as figures and as a heat map. */
#ifndef HD_IMAGE_DIFFERENCE_H
#define HD_IMAGE_DIFFERENCE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "image/picture.h"

/* Figures in one space over the compared pixels; all NaN if there are none. The error of a channel
   is the distance of its two values; that of a pixel is the maximum of its channels. */
typedef struct HdDifferenceFigures {
    double rmse, mean; /* over the channels */
    double psnr;       /* dB below the maximum value of the space; infinite for rmse 0 */
    double largest;    /* maximum channel error */
    int x, y, channel; /* place of `largest`, the first from the top left; -1 if it is 0 */
    double p999;       /* exceeded by at most one pixel in 1000; as hd_quantile_above */
} HdDifferenceFigures;

typedef struct HdPictureFigures {
    uint64_t pixels;             /* compared pixels: all six values are finite */
    uint64_t not_finite[2];      /* values of the first and the second picture */
    HdDifferenceFigures display; /* in 1/255 */
    HdDifferenceFigures linear;  /* 1 is white */
    double above_1, above_8;     /* shares of pixels with a larger display error */
    bool identical;              /* all values are finite and equal in both spaces */
} HdPictureFigures;

/* Difference in a channel other than a colour. */
typedef struct HdChannelDifference {
    double largest; /* infinite if one value is infinite or NaN and the other is not */
    int x, y;       /* its place, the first from the top left; valid if it is not 0 */
} HdChannelDifference;

/* Adds a pixel to a difference that starts as zero. */
void hd_channel_difference_add(HdChannelDifference *difference, float first, float second, int x,
                               int y);

typedef struct HdPictureDifference HdPictureDifference;

/* `clamps`: clamp linear values to 0..1 before comparing, because one picture cannot hold
   others. */
HdStatus hd_difference_create(HdPictureDifference **difference, bool clamps, HdError *error);

/* Adds the next row of both pictures, from the top; 3 values a pixel. `errors`, unless NULL,
   receives the display error of each pixel in 1/255; NaN if the pixel is not compared. */
void hd_difference_add_row(HdPictureDifference *difference, const HdPictureValue *first,
                           const HdPictureValue *second, int width, double *errors);

void hd_difference_figures(const HdPictureDifference *difference, HdPictureFigures *figures);

/* NULL is allowed. */
void hd_difference_free(HdPictureDifference *difference);

typedef struct HdQuantileBucket {
    uint64_t count;
    double largest;
} HdQuantileBucket;

typedef struct HdQuantile {
    HdQuantileBucket *buckets; /* owned; numbers that share exponent and leading bits */
    uint64_t count;
} HdQuantile;

HdStatus hd_quantile_create(HdQuantile *quantile, HdError *error);
void hd_quantile_free(HdQuantile *quantile);

/* Adds a finite number that is at least 0. */
void hd_quantile_add(HdQuantile *quantile, double value);

/* Returns the least number that at most one in `out_of` exceeds, or one larger by at most 1/2048 of
   it (from 2^-60 to 2^130). It is exact for multiples of a step, below 2048 steps. Without numbers
   it is NaN. */
double hd_quantile_above(const HdQuantile *quantile, uint64_t out_of);

/* Heat maps: a logarithmic scale, black below 1/4 of 1/255, then one colour for each doubling. It
   runs from dark violet at 1/4 over red and orange to pale yellow at 256, interpolated, ever
   lighter. Cyan marks NaN. */

/* Converts an error in 1/255, at least 0 or NaN, to r, g, b on the sRGB curve. */
void hd_heat_colour(double error, uint8_t rgb[3]);

#endif
