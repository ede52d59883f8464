/* SPDX-License-Identifier: MIT */
/* What a format is that frames are stored in. Each is defined in a file format_NAME.c, those of
   films in one. */
#ifndef HD_IMAGE_FORMAT_H
#define HD_IMAGE_FORMAT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "image/frame.h"
#include "image/texture.h"

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

/* Functions are NULL where the format has no such thing; `path` and `name` are for messages. */
typedef struct HdFormat HdFormat;
struct HdFormat {
    const char *name; /* for people */

    /* Of films: the arguments by which FFmpeg makes one of that size, which says that its values
       are on that curve; NULL ends them. */
    const char *const *(*film_arguments)(int width, int height, HdCurve curve);
    bool is_srgb_alone;                /* no other curve can be said */
    const HdFormat *segment_format;    /* which segments of such a film have */
    const char *const *join_arguments; /* by which FFmpeg joins them; NULL: film_arguments do */

    /* Of pictures: writes a frame to an open stream, a row at a time, with what it says of itself;
       NULL: nothing. */
    HdStatus (*write)(const HdFrame *frame, const HdPictureStyle *style,
                      const HdPictureLabel *label, FILE *stream, const char *path, HdError *error);
    bool has_layers;       /* holds an alpha, and the layers that the frame has */
    int most_encoded_bits; /* styles of more bits need the frame's radiance; those of fewer can be
                              written of one that is encoded, on the style's curve */

    /* Of pictures that bear fingerprints, by which frames are known as finished: reads one of 8
       bits and the frame's size back into `rgba`, and says so (is_encoded). */
    HdStatus (*load)(HdFrame *frame, const unsigned char *bytes, size_t size, const char *name,
                     HdError *error);

    /* Of textures: decodes into a cleared one and takes its values off the curve; on failure it may
       hold memory that the caller clears. */
    HdStatus (*decode)(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdCurve curve, HdError *error);
};

#endif
