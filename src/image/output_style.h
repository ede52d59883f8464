/* SPDX-License-Identifier: MIT */
#ifndef HD_IMAGE_OUTPUT_STYLE_H
#define HD_IMAGE_OUTPUT_STYLE_H

#include "image/picture.h"

/* How the frames are stored. */
typedef struct HdOutputStyle {
    HdPictureStyle picture; /* films have its curve and 8 bits */
    int frames_per_second;  /* of films */
} HdOutputStyle;

#endif
