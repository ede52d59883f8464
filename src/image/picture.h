/* SPDX-License-Identifier: MIT */
/* Pictures in files: the formats that frames are stored in, in their one table, and that textures
   and pictures to compare are read from. */
#ifndef HD_IMAGE_PICTURE_H
#define HD_IMAGE_PICTURE_H

#include "base/limits.h"
#include "image/format.h"
#include "system/atomic_file.h"

/* Each format is hd_format_NAME, and the ending of its files .NAME.
   mp4: H.264, 4:2:0; mkv: FFV1, lossless RGB; gif: 256 colours, repeats for ever.
   png: 8 or 16 bits, RGB; exr: half or float, linear; pfm: float, linear; data: 8 bits, RGBA. */
#define HD_FILM_FORMATS(FIRST, NEXT, LAST)    FIRST(mp4) NEXT(mkv) LAST(gif)
#define HD_PICTURE_FORMATS(FIRST, NEXT, LAST) FIRST(png) NEXT(exr) NEXT(pfm) LAST(data)

#define HD_FORMAT_DECLARED(name) extern const HdFormat hd_format_##name;
HD_FILM_FORMATS(HD_FORMAT_DECLARED, HD_FORMAT_DECLARED, HD_FORMAT_DECLARED)
HD_PICTURE_FORMATS(HD_FORMAT_DECLARED, HD_FORMAT_DECLARED, HD_FORMAT_DECLARED)

/* Of textures alone. */
HD_FORMAT_DECLARED(jpeg)

/* The endings for messages and help, as in ".png, .exr, .pfm or .data". */
#define HD_ENDING(name)       "." #name
#define HD_COMMA_ENDING(name) ", ." #name
#define HD_OR_ENDING(name)    " or ." #name
#define HD_FILM_ENDINGS       HD_FILM_FORMATS(HD_ENDING, HD_COMMA_ENDING, HD_OR_ENDING)
#define HD_PICTURE_ENDINGS    HD_PICTURE_FORMATS(HD_ENDING, HD_COMMA_ENDING, HD_OR_ENDING)

/* By the ending, in upper or lower case; NULL where it is of no format. */
const HdFormat *hd_format_of(const char *path);

/* NULL is none. */
bool hd_format_is_film(const HdFormat *format);

/* HD_BAD_INPUT where the path is that of a film that cannot say that its values are on the style's
   curve, or of a picture that cannot have so many bits. */
HdStatus hd_format_check_style(const char *path, const HdPictureStyle *style, HdError *error);

/* Writes a frame as a picture, under a temporary name beside `path`, for hd_atomic_file_commit or
   hd_atomic_file_discard to end; missing folders are made. A film's format is an error. The data
   format: int32 width, int32 height, then r g b a, 8 bits each, little endian. PNG: RGB, with an
   sRGB chunk where the values are on that curve, and a gAMA chunk of 1 where they are linear. PFM:
   float, rows from the bottom. A frame that is encoded already must be so on the
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

/* What the display values run to. Those of 8 bits and of 16 bits are whole numbers of this scale,
   so that their differences are exact; 257 are one step of 255. */
#define HD_DISPLAY_TOP  65535.0
#define HD_DISPLAY_STEP 257.0

/* A channel of a pixel in both spaces. */
typedef struct HdPictureValue {
    double linear;  /* light; 1 is white; of PFM as it stands in the file, whatever that is */
    double display; /* clamped to 0..1 and put on the curve, times HD_DISPLAY_TOP */
} HdPictureValue;

/* Pictures are read row by row, so that the largest one needs no more memory than a row: PNG,
   OpenEXR (some rows more) and PFM, told apart by the first bytes. */
typedef struct HdPictureReader HdPictureReader;

/* Opens a regular file and reads its head. PNG: every kind that is not interlaced; alpha is
   dropped. OpenEXR: a part of lines with R, G and B; and up to HD_MAX_FURTHER other channels. PFM:
   in colour, of either byte order. HD_BAD_INPUT, with the file's name and what was expected, where
   it is something else. */
HdStatus hd_picture_reader_open(HdPictureReader **reader, const char *path, HdError *error);

const HdPictureFacts *hd_picture_reader_facts(const HdPictureReader *reader);

/* Says on which curve the display values are, and those of a PNG, whatever its chunks say. Once,
   before the first row. */
HdStatus hd_picture_reader_start(HdPictureReader *reader, HdCurve curve, HdError *error);

/* The next row from the top: 3 values for each pixel. */
HdStatus hd_picture_reader_next(HdPictureReader *reader, HdPictureValue *values, HdError *error);

/* The last row's values of a further channel, by its place among the names; until the next row. */
const float *hd_picture_reader_further(const HdPictureReader *reader, int channel);

/* NULL is allowed. */
void hd_picture_reader_close(HdPictureReader *reader);

#endif
