/* SPDX-License-Identifier: MIT */
/* Pictures in files. Values are linear as the caller gives them: no file written or read here
   applies a curve. */
#ifndef HD_IMAGE_H
#define HD_IMAGE_H

#include <stddef.h>
#include <stdint.h>

#include "curve.h"
#include "error.h"
#include "frame.h"
#include "scene.h"

/* Eight bits a channel, row by row from the top: r, g, b, a. */
typedef struct HdImage8 {
    int width, height;
    uint8_t *rgba; /* owned; width * height * 4 */
} HdImage8;

/* How a picture stores values; PFM is always linear, and only PNG has more than 8 bits. */
typedef struct HdPictureStyle {
    HdCurve curve;
    int bits; /* 8 or 16 */
} HdPictureStyle;

typedef enum HdImageFormat { HD_IMAGE_DATA, HD_IMAGE_PNG } HdImageFormat;

/* HD_IMAGE_PNG for names that end in ".png" (any case), HD_IMAGE_DATA for all others. */
HdImageFormat hd_image_format(const char *path);

/* Allocates a picture of width * height; 1..65535 each. */
HdStatus hd_image8_create(HdImage8 *image, int width, int height, HdError *error);
void hd_image8_free(HdImage8 *image);

/* Each channel clamped to 0..1, times 255, rounded to the nearest; alpha 255. `image` has the
   frame's size. */
void hd_frame_to_image8(const HdFrame *frame, HdImage8 *image);

/* Writes under a temporary name beside `path` and renames it; makes missing folders. On failure
   nothing is left behind under either name, and a file that was there before is untouched. The data
   format: int32 width, int32 height, then r g b a, little endian. PNG: RGB, 8 bits. */
HdStatus hd_image8_write(const HdImage8 *image, const char *path, HdError *error);

/* Reads a texture, PNG of any kind or the data format, told apart by the first bytes; alpha is
   dropped. At most 65535 pixels a side, and 2^28 in all. */
HdStatus hd_texture_read(HdTexture *texture, const char *path, HdError *error);

/* The same from memory; `name` is for messages. */
HdStatus hd_texture_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                           const char *name, HdError *error);

/* Frees what the texture owns and clears it; it may be clear already. */
void hd_texture_clear(HdTexture *texture);

#endif
