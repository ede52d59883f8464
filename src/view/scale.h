/* SPDX-License-Identifier: MIT */
/* Pictures at other sizes, for the eye. */
#ifndef HD_VIEW_SCALE_H
#define HD_VIEW_SCALE_H

#include <stdint.h>

/* Fills a picture, whose rows begin `stride` bytes apart, with another one's content: the mean of
   what a pixel covers where it gets smaller, the nearest pixel where it gets larger. Both are r, g,
   b and alpha. An empty source gives black. */
void hd_scale_rgba(const uint8_t *source, int source_width, int source_height, uint8_t *target,
                   int width, int height, int stride);

#endif
