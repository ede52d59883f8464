/* SPDX-License-Identifier: MIT */
/* Interface of a picture, film or texture format, each defined in a file format_NAME.c (films share
   one). picture.h lists them. */
#ifndef HD_IMAGE_FORMAT_H
#define HD_IMAGE_FORMAT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "base/vector.h"
#include "image/frame.h"

/* How a picture stores values: PNG in 8 or 16 bits; OpenEXR in half, or float for 32 bits; PFM in
   float; others in 8 bits. OpenEXR and PFM are linear. */
typedef struct HdPictureStyle {
    HdCurve curve;
    int bits;       /* 8, 16 or 32 */
    bool has_alpha; /* PNG has the frame's alpha, if the frame has it; OpenEXR always does */
} HdPictureStyle;

/* Storage of frames. */
typedef struct HdOutputStyle {
    HdPictureStyle picture; /* films use its curve and 8 bits */
    int frames_per_second;  /* for films */
    bool is_ntsc;           /* films have 1000/1001 of that rate, such as 24000/1001 */
} HdOutputStyle;

/* The picture's position in a larger one: its first pixel is the larger one's (left, top). */
typedef struct HdCrop {
    int whole_width, whole_height; /* size of the larger one; 0: no crop */
    int left, top;
} HdCrop;

/* What a picture needs besides its frame and style, mostly metadata: the same on every device and
   at any time. */
typedef struct HdPictureLabel {
    const char *scene;   /* name; UTF-8 without control characters, as the options */
    const char *options; /* options of the command line that affect pixels; "": none */
    int frame;
    HdCrop crop;
    HdVec3 background; /* radiance behind the objects, times exposure */
    bool has_fingerprint;
    uint64_t fingerprint; /* the frame's fingerprint (output/fingerprint.h), which marks it as
                             finished */
} HdPictureLabel;

enum { HD_MAX_FURTHER = 64 }; /* further channels are skipped */

/* Properties of a picture that is read row by row. */
typedef struct HdPictureFacts {
    const struct HdFormat *format; /* PNG, OpenEXR or PFM */
    int width, height;
    int bits;                 /* bits of a channel: 8 or 16, OpenEXR 16 or 32, PFM 32 */
    HdCurve curve;            /* PNG: sRGB if a chunk says so, else linear; others: linear */
    int further;              /* channels of OpenEXR besides R, G and B */
    const char *const *names; /* names of them, in alphabetical order */
} HdPictureFacts;

enum { HD_SLICED_SIDE = 64 };

/* Unsupported functions are NULL; `path` and `name` are for messages. */
typedef struct HdFormat HdFormat;
struct HdFormat {
    const char *name; /* name for messages */

    /* Films: FFmpeg's arguments, NULL-terminated, which also tag the file with the curve. Small
       films have a side below HD_SLICED_SIDE; NULL: the same arguments. */
    const char *const *film_arguments[HD_CURVES], *const *small_film_arguments[HD_CURVES];
    bool is_srgb_only;                 /* cannot tag another curve */
    const HdFormat *segment_format;    /* format of segments */
    const char *const *join_arguments; /* to join segments; NULL: film_arguments */

    /* Pictures: writes a frame to an open stream, row by row, with its metadata; NULL: none. */
    HdStatus (*write)(const HdFrame *frame, const HdPictureStyle *style,
                      const HdPictureLabel *label, FILE *stream, const char *path, HdError *error);
    bool has_layers;      /* holds alpha and the frame's layers */
    bool has_alpha;       /* holds alpha if the style asks for it */
    int max_encoded_bits; /* most bits of a style that an encoded frame on its curve suffices for;
                             more need the radiance */

    /* Pictures with fingerprints: reads one with 8 bits and the frame's size back into `rgba`, and
       sets is_encoded. */
    HdStatus (*load)(HdFrame *frame, const unsigned char *bytes, size_t size, const char *name,
                     HdError *error);

    /* Textures: decodes into a cleared texture, whose values stay on their curve; alpha, if there
       is one, in place of colours for a mask. After a failure the caller clears it, because it may
       hold memory. */
    HdStatus (*decode)(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdError *error);

    /* Detects the format by the first bytes, at least 8 in a complete file. */
    bool (*begins)(const unsigned char *bytes, size_t size);

    /* Pictures read row by row: reads the header of a file that the caller owns. File and path must
       live as long as the rows. HD_BAD_INPUT: unsupported kind. */
    HdStatus (*open_rows)(void **rows, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error);
    /* Reads the next row from the top, r, g, b: radiance, or 0..65535 for a picture on a curve. */
    HdStatus (*next_row)(void *rows, float *rgb, HdError *error);
    const float *(*further_channel)(const void *rows, int channel); /* of this row */
    void (*close_rows)(void *rows);
    bool is_on_curve;
};

/* Size of the end of a finished frame's PNG: a tEXt chunk with the fingerprint and a hash of all
   previous bytes (hash.h), then IEND. */
enum { HD_PNG_END_SIZE = 12 + 7 + 45 + 12 };

/* Returns whether the bytes are an unchanged PNG that ends with this fingerprint. */
bool hd_png_is_whole(const unsigned char *bytes, size_t size, uint64_t fingerprint);

#endif
