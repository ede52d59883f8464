/* SPDX-License-Identifier: MIT */
/* How far two pictures of one size are apart, in figures and as a picture. */
#ifndef HD_IMAGE_DIFFERENCE_H
#define HD_IMAGE_DIFFERENCE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "image/picture.h"

/* Of one space, over the pixels that are compared. The error of a channel is how far its two values
   are apart, that of a pixel the largest of its three. All are NaN where no pixel is compared. */
typedef struct HdDifferenceFigures {
    double rmse, mean; /* over the channels */
    double psnr;       /* dB below the largest value that the space shows; infinite for rmse 0 */
    double largest;    /* of the channels */
    int x, y, channel; /* of `largest`, the first one from the top left; -1 where it is 0 */
    double p999;       /* no more than one pixel in 1000 is above; as hd_quantile_above */
} HdDifferenceFigures;

typedef struct HdPictureFigures {
    uint64_t pixels;             /* compared: all six values are finite */
    uint64_t not_finite[2];      /* values of the first and the second picture */
    HdDifferenceFigures display; /* in steps of 255 */
    HdDifferenceFigures linear;  /* 1 is white */
    double above_1, above_8;     /* shares of the pixels with a larger display error */
    bool identical;              /* all values are finite and alike in both spaces */
} HdPictureFigures;

/* Of a channel that is no colour. */
typedef struct HdChannelDifference {
    double largest; /* infinite where one value is so, or is NaN, and the other is not */
    int x, y;       /* of it, the first one from the top left; of account where it is not 0 */
} HdChannelDifference;

/* Takes a pixel; the difference is all 0 at first. */
void hd_channel_difference_add(HdChannelDifference *difference, float first, float second, int x,
                               int y);

typedef struct HdPictureDifference HdPictureDifference;

/* `clamps` says that linear values are clamped to 0..1 before they are compared, since one of the
   pictures holds no others. */
HdStatus hd_difference_create(HdPictureDifference **difference, bool clamps, HdError *error);

/* Takes the next row of both pictures, from the top; 3 values a pixel. `errors`, if not NULL, gets
   the display error of each pixel in steps of 255; NaN where the pixel is not compared. */
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

/* One of the numbers: at most one in `out_of` is above it. It is the least such number, or a number
   that is larger by at most 1/2048 of it (of those from 2^-60 to 2^130); the least one exactly
   where the numbers are multiples of a step and below 2048 of it. Without numbers NaN. */
double hd_quantile_above(const HdQuantile *quantile, uint64_t out_of);

/* Pictures of errors. The scale is logarithmic: black below 1/4 of a step of 255, then a colour for
   each doubling, from dark violet at 1/4 over red and orange to pale yellow at 256, mixed in
   between; each is lighter than the one before. Cyan stands for NaN. */

/* The colour of an error in steps of 255, at least 0 or NaN; r, g, b on the sRGB curve. */
void hd_heat_colour(double error, uint8_t rgb[3]);

#endif
