/* SPDX-License-Identifier: MIT */
/* The formats behind image.h. */
#ifndef HD_IMAGE_PICTURE_FORMATS_H
#define HD_IMAGE_PICTURE_FORMATS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "image/picture.h"

enum { HD_MAX_TEXTURE_PIXELS = 1 << 28 };

/* Checks the size against the limits above and allocates the texels, which are not cleared. */
HdStatus hd_texture_create(HdTexture *texture, uint32_t width, uint32_t height, const char *name,
                           HdError *error);

/* The pixels' values on the curve, each followed by an alpha of 255. */
void hd_encode_rgba(HdCurve curve, const float *rgb, size_t pixels, uint8_t *rgba);

/* Write to an open stream, a row at a time; `path` is for messages. */
HdStatus hd_image_data_write(const HdFrame *frame, HdCurve curve, FILE *stream, const char *path,
                             HdError *error);
HdStatus hd_image_png_write(const HdFrame *frame, const HdPictureStyle *style,
                            const uint64_t *fingerprint, FILE *stream, const char *path,
                            HdError *error);
HdStatus hd_image_pfm_write(const HdFrame *frame, FILE *stream, const char *path, HdError *error);

/* Reads an RGB picture of 8 bits and the frame's size back into `rgba`, and says so (is_encoded).
   `name` is for messages. */
HdStatus hd_image_png_load(HdFrame *frame, const unsigned char *bytes, size_t size,
                           const char *name, HdError *error);

/* True where the bytes begin with PNG's signature. */
bool hd_image_is_png(const unsigned char *bytes, size_t size);

/* Decode into a cleared texture and take its values off the curve; on failure it may hold memory
 * that the caller clears. */
HdStatus hd_image_data_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                              const char *name, HdCurve curve, HdError *error);
HdStatus hd_image_png_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                             const char *name, HdCurve curve, HdError *error);

#endif
