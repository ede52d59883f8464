/* SPDX-License-Identifier: MIT */
#ifndef HD_IMAGE_PICTURE_VALUE_H
#define HD_IMAGE_PICTURE_VALUE_H

/* What the display values run to. Those of 8 bits and of 16 bits are whole numbers of this scale,
   so that their differences are exact; 257 are one step of 255. */
#define HD_DISPLAY_TOP  65535.0
#define HD_DISPLAY_STEP 257.0

/* A channel of a pixel in both spaces. */
typedef struct HdPictureValue {
    double linear;  /* light; 1 is white; of PFM as it stands in the file, whatever that is */
    double display; /* clamped to 0..1 and put on the curve, times HD_DISPLAY_TOP */
} HdPictureValue;

#endif
