/* SPDX-License-Identifier: MIT */
/* Pictures in files. */
#ifndef HD_IMAGE_PICTURE_H
#define HD_IMAGE_PICTURE_H

#include "base/error.h"
#include "base/limits.h"
#include "image/formats.h"
#include "system/atomic_file.h"

/* Writes a frame as a picture, under a temporary name beside `path`, for hd_atomic_file_commit or
   hd_atomic_file_discard to end; missing folders are made. A film's format is an error. The data
   format: int32 width, int32 height, then r g b a, 8 bits each, little endian. PNG: RGB, with an
   sRGB chunk where the values are on that curve, and a gAMA chunk of 1 where they are linear. PFM:
   float, little endian, rows from the bottom. A frame that is encoded already must be so on the
   style's curve; only what has 8 bits can be made of it. PNG gets what the label says; NULL:
   nothing. On failure nothing is left of `file`, and a file that was there before is untouched. */
HdStatus hd_picture_prepare(HdAtomicFile *file, const HdFrame *frame, const HdFormat *format,
                            const HdPictureStyle *style, const HdPictureLabel *label,
                            const char *path, HdError *error);

/* The same in the format of the path's ending, or else the data format, and with the renaming. */
HdStatus hd_picture_write(const HdFrame *frame, const HdPictureStyle *style, const char *path,
                          HdError *error);

/* Reads a texture, PNG of any kind, JPEG of 8 bits that is grey or of three colours, or the data
   format, told apart by the first bytes, and takes its values off the curve; alpha is dropped. At
   most 65535 pixels a side, and 2^28 in all. */
HdStatus hd_texture_read(HdTexture *texture, const char *path, HdCurve curve, HdError *error);

/* The same from memory; `name` is for messages. */
HdStatus hd_texture_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                           const char *name, HdCurve curve, HdError *error);

#endif
