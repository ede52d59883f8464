/* SPDX-License-Identifier: MIT */
/* Frames and textures as PNG and in the data format. */
#ifndef HD_IMAGE_PICTURE_FORMATS_H
#define HD_IMAGE_PICTURE_FORMATS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "image/frame.h"
#include "image/output_style.h"
#include "image/texture.h"

/* Write to an open stream, a row at a time; `path` is for messages. */
HdStatus hd_image_data_write(const HdFrame *frame, HdCurve curve, FILE *stream, const char *path,
                             HdError *error);
HdStatus hd_image_png_write(const HdFrame *frame, const HdPictureStyle *style,
                            const uint64_t *fingerprint, FILE *stream, const char *path,
                            HdError *error);

/* Reads an RGB picture of 8 bits and the frame's size back into `rgba`, and says so (is_encoded).
   `name` is for messages. */
HdStatus hd_image_png_load(HdFrame *frame, const unsigned char *bytes, size_t size,
                           const char *name, HdError *error);

/* Decode into a cleared texture and take its values off the curve; on failure it may hold memory
 * that the caller clears. */
HdStatus hd_image_data_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                              const char *name, HdCurve curve, HdError *error);
HdStatus hd_image_png_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                             const char *name, HdCurve curve, HdError *error);

#endif
