/* SPDX-License-Identifier: MIT */
/* What a format of pictures, films or textures is; each is defined in a file format_NAME.c, those
   of films in one. picture.h has their table. */
#ifndef HD_IMAGE_FORMAT_H
#define HD_IMAGE_FORMAT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "image/frame.h"

/* How a picture stores values: PNG in 8 or 16 bits; OpenEXR in half, with 32 bits in float, and PFM
   in float, both linear; all else in 8 bits. */
typedef struct HdPictureStyle {
    HdCurve curve;
    int bits; /* 8, 16 or 32 */
} HdPictureStyle;

/* How the frames are stored. */
typedef struct HdOutputStyle {
    HdPictureStyle picture; /* films have its curve and 8 bits */
    int frames_per_second;  /* of films */
} HdOutputStyle;

/* What a picture says of how it was made, where its format has a place for it, beside the program's
   version: the same on every device and at any time. */
typedef struct HdPictureLabel {
    const char *scene;   /* its name; this and the options are UTF-8 without control characters */
    const char *options; /* of the command line, those that decide pixels; "": none */
    int frame;
    bool has_fingerprint;
    uint64_t fingerprint; /* of the frame (output/fingerprint.h): by it, it is known as finished */
} HdPictureLabel;

enum { HD_MAX_FURTHER = 64 }; /* what is beyond is passed over */

/* Of a picture that is read row by row. */
typedef struct HdPictureFacts {
    const struct HdFormat *format; /* PNG, OpenEXR or PFM */
    int width, height;
    int bits;                 /* of a channel: 8 or 16, in OpenEXR 16 or 32, in PFM 32 */
    HdCurve curve;            /* of PNG: sRGB where a chunk says so, else linear, as it is written;
                                 of the others: linear */
    int further;              /* channels of OpenEXR beside R, G and B */
    const char *const *names; /* theirs, by the alphabet */
} HdPictureFacts;

enum { HD_SLICED_SIDE = 64 };

/* Functions are NULL where the format has no such thing; `path` and `name` are for messages. */
typedef struct HdFormat HdFormat;
struct HdFormat {
    const char *name; /* for people */

    /* Of films: the arguments by which FFmpeg makes one, which says that its values are on that
       curve; NULL ends them. Small ones have a side below HD_SLICED_SIDE; NULL: as others. */
    const char *const *film_arguments[HD_CURVES], *const *small_film_arguments[HD_CURVES];
    bool is_srgb_alone;                /* no other curve can be said */
    const HdFormat *segment_format;    /* which segments of such a film have */
    const char *const *join_arguments; /* by which FFmpeg joins them; NULL: film_arguments do */

    /* Of pictures: writes a frame to an open stream, a row at a time, with what it says of itself;
       NULL: nothing. */
    HdStatus (*write)(const HdFrame *frame, const HdPictureStyle *style,
                      const HdPictureLabel *label, FILE *stream, const char *path, HdError *error);
    bool has_layers;      /* holds an alpha, and the layers that the frame has */
    int max_encoded_bits; /* styles of more bits need the frame's radiance; those of fewer can be
                              written of one that is encoded, on the style's curve */

    /* Of pictures that bear fingerprints, by which frames are known as finished: reads one of 8
       bits and the frame's size back into `rgba`, and says so (is_encoded). */
    HdStatus (*load)(HdFrame *frame, const unsigned char *bytes, size_t size, const char *name,
                     HdError *error);

    /* Of textures: decodes into a cleared one, whose values stay on their curve; on failure it may
       hold memory that the caller clears. */
    HdStatus (*decode)(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdError *error);

    /* Of what is told apart by its first bytes, of which there are 8 at least in a whole file. */
    bool (*begins)(const unsigned char *bytes, size_t size);

    /* Of pictures that are read row by row: reads the head of a file, which remains the caller's
       and lives as long as the rows, as the path does; HD_BAD_INPUT where it is of a wrong kind. */
    HdStatus (*open_rows)(void **rows, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error);
    /* The next row from the top, r, g, b: radiance, or where a picture is on a curve its values,
       0..65535. */
    HdStatus (*next_row)(void *rows, float *rgb, HdError *error);
    const float *(*further_channel)(const void *rows, int channel); /* of this row */
    void (*close_rows)(void *rows);
    bool is_on_curve;
};

/* A finished frame's PNG ends with its label's fingerprint, last but IEND, in a chunk of the type
   tEXt, with a hash of all bytes before (hash.h). This is the size of that chunk and IEND. */
enum { HD_PNG_END_SIZE = 12 + 7 + 45 + 12 };

/* Whether these bytes are those of a PNG that ends with that fingerprint: not one has changed since
   it was written. */
bool hd_png_is_whole(const unsigned char *bytes, size_t size, uint64_t fingerprint);

#endif
