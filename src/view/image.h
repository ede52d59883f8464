/* SPDX-License-Identifier: MIT */
/* Holds, splits and compares pictures for display. */
#ifndef HD_VIEW_IMAGE_H
#define HD_VIEW_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "view/motion.h"

/* Displayed picture with its statistics. */
typedef struct HdViewImage {
    uint8_t *rgba; /* owned; encoded with the scene's curve */
    int width, height;
    HdDetail detail; /* detail of its latest part */
    bool is_settled; /* has the bytes that 'hedron render' writes */
    double share;    /* finished part of the work, 0..1 */
    double seconds;  /* time of its latest step: a moving picture, or all of a settled one */
    uint64_t rays;   /* rays of that step */
    bool has_bound;  /* settled picture: truncation error, in steps of 255 */
    double largest_bound;
} HdViewImage;

/* Changes the image's size; scales its content roughly, or makes it black if there is none. */
HdStatus hd_view_image_resize(HdViewImage *image, int width, int height, HdError *error);

void hd_view_image_free(HdViewImage *image);

typedef struct HdSplitFigures {
    int largest;    /* largest difference of a channel, in steps of 255 */
    double share;   /* share of pixels that differ */
    bool is_unlike; /* the pictures' sizes differ at present */
} HdSplitFigures;

/* Makes `out` twice as wide and high as the first picture, which is on the left, the second one on
   the right. Below on the left is each channel's difference, times `gain`; the right is empty. If
   sizes differ, fits the second one and sets `is_unlike`. */
HdStatus hd_view_image_split(HdViewImage *out, const HdViewImage *first, const HdViewImage *second,
                             int gain, HdSplitFigures *figures, HdError *error);

#endif
