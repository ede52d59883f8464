/* SPDX-License-Identifier: MIT */
#include "image/format.h"

#include <stdlib.h>

#include "base/limits.h"
#include "system/machine.h"

HdStatus hd_texture_create(HdTexture *texture, uint32_t width, uint32_t height, const char *name,
                           HdError *error) {
    if (width < 1 || width > HD_MAX_TEXTURE_SIDE || height < 1 || height > HD_MAX_TEXTURE_SIDE)
        return hd_fail(error, HD_BAD_INPUT,
                       "the texture %s has %lu x %lu pixels, expected 1..%d each", name,
                       (unsigned long)width, (unsigned long)height, HD_MAX_TEXTURE_SIDE);
    if ((uint64_t)width * height > HD_MAX_TEXTURE_PIXELS)
        return hd_fail(error, HD_BAD_INPUT,
                       "the texture %s has %lu x %lu pixels, expected at most %d in all", name,
                       (unsigned long)width, (unsigned long)height, HD_MAX_TEXTURE_PIXELS);
    texture->texels =
        hd_large_allocate((size_t)width * (size_t)height * 3 * sizeof *texture->texels);
    if (texture->texels == NULL)
        return hd_fail(error, HD_FAILED,
                       "out of memory: no room for the texture %s of %lu x %lu pixels", name,
                       (unsigned long)width, (unsigned long)height);
    texture->width = (int)width;
    texture->height = (int)height;
    return HD_OK;
}

void hd_texture_clear(HdTexture *texture) {
    free(texture->texels);
    *texture = (HdTexture){0};
}
