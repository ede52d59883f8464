/* SPDX-License-Identifier: MIT */
#ifndef HD_IMAGE_TEXTURE_H
#define HD_IMAGE_TEXTURE_H

#include <stdint.h>

#include "base/error.h"

enum { HD_MAX_TEXTURE_PIXELS = 1 << 28 };

/* Linear values, 16 bits a channel, row by row from the top: r, g, b, r, g, b, ... */
typedef struct HdTexture {
    int width, height;
    uint16_t *texels; /* owned; width * height * 3 */
} HdTexture;

/* Checks the size against HD_MAX_TEXTURE_SIDE and the limit above and allocates the texels, which
   are not cleared. `name` is for messages. */
HdStatus hd_texture_create(HdTexture *texture, uint32_t width, uint32_t height, const char *name,
                           HdError *error);

/* Frees what the texture owns and clears it; it may be clear already. */
void hd_texture_clear(HdTexture *texture);

#endif
