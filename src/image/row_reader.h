/* SPDX-License-Identifier: MIT */
/* Pictures that are read row by row, so that the largest one needs no more memory than a row: PNG,
   OpenEXR (some rows more) and PFM, told apart by the first bytes. */
#ifndef HD_IMAGE_ROW_READER_H
#define HD_IMAGE_ROW_READER_H

#include "base/error.h"
#include "image/formats.h"
#include "image/picture_value.h"

typedef struct HdPictureFacts {
    const HdFormat *format; /* PNG, OpenEXR or PFM */
    int width, height;
    int bits;                 /* of a channel: 8 or 16, in OpenEXR 16 or 32, in PFM 32 */
    HdCurve curve;            /* of PNG: sRGB where a chunk says so, else linear, as it is written;
                                 of the others: linear */
    int further;              /* channels of OpenEXR beside R, G and B */
    const char *const *names; /* theirs, by the alphabet */
} HdPictureFacts;

typedef struct HdPictureReader HdPictureReader;

/* Opens a regular file and reads its head. PNG: every kind that is not interlaced; alpha is
   dropped. OpenEXR: a part of lines with R, G and B; and up to HD_MOST_FURTHER other channels. PFM:
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
