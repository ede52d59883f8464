/* SPDX-License-Identifier: MIT */
/* Two pictures of one view beside each other, and below them what they differ in. */
#ifndef HD_VIEW_SPLIT_H
#define HD_VIEW_SPLIT_H

#include "view/worker.h"

typedef struct HdSplitFigures {
    int largest;    /* difference of a channel, in steps of 255 */
    double share;   /* of the pixels that differ at all */
    bool is_unlike; /* the pictures have different sizes, for now */
} HdSplitFigures;

/* Makes `out` twice as wide and high as the first picture, which is on the left, the second one on
   the right; below on the left the difference of each channel, times `gain`, and on the right
   nothing. Where sizes differ, the second one is fitted and the figures say so. */
HdStatus hd_split_compose(HdViewImage *out, const HdViewImage *first, const HdViewImage *second,
                          int gain, HdSplitFigures *figures, HdError *error);

#endif
