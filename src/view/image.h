/* SPDX-License-Identifier: MIT */
/* Pictures as they are shown. */
#ifndef HD_VIEW_IMAGE_H
#define HD_VIEW_IMAGE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "view/motion.h"

/* A picture and what is known of it. */
typedef struct HdViewImage {
    uint8_t *rgba; /* owned; as the scene's curve has it */
    int width, height;
    HdDetail detail; /* of its latest part */
    bool is_settled; /* it has the bytes that 'hedron render' makes */
    double share;    /* of the work on it, 0..1 */
    double seconds;  /* of its latest step: a moving picture, or all of a settled one */
    uint64_t rays;   /* of that */
    bool has_bound;  /* of a settled picture: what was left out, in steps of 255 */
    double largest_bound;
} HdViewImage;

/* Gives the image another size; its content becomes so large, roughly, or is black where there is
   none. */
HdStatus hd_view_image_resize(HdViewImage *image, int width, int height, HdError *error);

void hd_view_image_free(HdViewImage *image);

typedef struct HdSplitFigures {
    int largest;    /* difference of a channel, in steps of 255 */
    double share;   /* of the pixels that differ at all */
    bool is_unlike; /* the pictures have different sizes, for now */
} HdSplitFigures;

/* Makes `out` twice as wide and high as the first picture, which is on the left, the second one on
   the right; below on the left the difference of each channel, times `gain`, and on the right
   nothing. Where sizes differ, the second one is fitted and the figures say so. */
HdStatus hd_view_image_split(HdViewImage *out, const HdViewImage *first, const HdViewImage *second,
                             int gain, HdSplitFigures *figures, HdError *error);

#endif
