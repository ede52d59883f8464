/* SPDX-License-Identifier: MIT */
#ifndef HD_IMAGE_TEXTURE_H
#define HD_IMAGE_TEXTURE_H

#include <stdint.h>

/* Linear values, 16 bits a channel, row by row from the top: r, g, b, r, g, b, ... */
typedef struct HdTexture {
    int width, height;
    uint16_t *texels; /* owned; width * height * 3 */
} HdTexture;

#endif
