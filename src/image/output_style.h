/* SPDX-License-Identifier: MIT */
#ifndef HD_IMAGE_OUTPUT_STYLE_H
#define HD_IMAGE_OUTPUT_STYLE_H

#include "image/curve.h"

/* How a picture stores values; PFM is always linear, and only PNG has more than 8 bits. */
typedef struct HdPictureStyle {
    HdCurve curve;
    int bits; /* 8 or 16 */
} HdPictureStyle;

/* How the frames are stored. */
typedef struct HdOutputStyle {
    HdPictureStyle picture; /* films have its curve and 8 bits */
    int frames_per_second;  /* of films */
} HdOutputStyle;

#endif
