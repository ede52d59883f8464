/* SPDX-License-Identifier: MIT */
/* The formats that frames are stored in: one table, and what the ending of a name means. A format
   of pictures has a file format_NAME.c of its own. */
#ifndef HD_IMAGE_FORMAT_H
#define HD_IMAGE_FORMAT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "image/frame.h"
#include "image/texture.h"

/* How a picture stores values; PFM is always linear, and only PNG has more than 8 bits. */
typedef struct HdPictureStyle {
    HdCurve curve;
    int bits; /* 8 or 16 */
} HdPictureStyle;

/* How the frames are stored. */
typedef struct HdOutputStyle {
    HdPictureStyle picture; /* films have its curve and 8 bits */
    int frames_per_second;  /* of films */
} HdOutputStyle;

/* Functions are NULL where the format has no such thing; `path` and `name` are for messages. */
typedef struct HdFormat {
    const char *name; /* for people */

    /* Of films: the arguments by which FFmpeg makes one of that size; NULL ends them. */
    const char *const *(*film_arguments)(int width, int height);

    /* Of pictures: writes a frame to an open stream, a row at a time, with the mark of
       `fingerprint` (mark.h); NULL: without one. */
    HdStatus (*write)(const HdFrame *frame, const HdPictureStyle *style,
                      const uint64_t *fingerprint, FILE *stream, const char *path, HdError *error);
    int most_encoded_bits; /* styles of more bits need the frame's radiance; those of fewer can be
                              written of one that is encoded, on the style's curve */

    /* Of pictures that bear marks, by which frames are known as finished: reads one of 8 bits and
       the frame's size back into `rgba`, and says so (is_encoded). */
    HdStatus (*load)(HdFrame *frame, const unsigned char *bytes, size_t size, const char *name,
                     HdError *error);

    /* Of textures: decodes into a cleared one and takes its values off the curve; on failure it may
       hold memory that the caller clears. */
    HdStatus (*decode)(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdCurve curve, HdError *error);
} HdFormat;

/* The table. Each format is hd_format_NAME, and the ending of its files .NAME.
   mp4: H.264, 4:2:0; mkv: FFV1, lossless RGB; gif: 256 colours, repeats for ever.
   png: 8 or 16 bits, RGB; pfm: float, linear; data: 8 bits, RGBA. */
#define HD_FILM_FORMATS(FIRST, NEXT, LAST)    FIRST(mp4) NEXT(mkv) LAST(gif)
#define HD_PICTURE_FORMATS(FIRST, NEXT, LAST) FIRST(png) NEXT(pfm) LAST(data)

#define HD_FORMAT_DECLARED(name) extern const HdFormat hd_format_##name;
HD_FILM_FORMATS(HD_FORMAT_DECLARED, HD_FORMAT_DECLARED, HD_FORMAT_DECLARED)
HD_PICTURE_FORMATS(HD_FORMAT_DECLARED, HD_FORMAT_DECLARED, HD_FORMAT_DECLARED)

/* The endings for messages and help, as in ".png, .pfm or .data". */
#define HD_ENDING(name)       "." #name
#define HD_COMMA_ENDING(name) ", ." #name
#define HD_OR_ENDING(name)    " or ." #name
#define HD_FILM_ENDINGS       HD_FILM_FORMATS(HD_ENDING, HD_COMMA_ENDING, HD_OR_ENDING)
#define HD_PICTURE_ENDINGS    HD_PICTURE_FORMATS(HD_ENDING, HD_COMMA_ENDING, HD_OR_ENDING)

/* By the ending, in upper or lower case; NULL where it is of no format. */
const HdFormat *hd_format_of(const char *path);

/* NULL is none. */
bool hd_format_is_film(const HdFormat *format);

#endif
