/* SPDX-License-Identifier: MIT */
/* Pictures in files: the formats that frames are stored in, in their one table, and that textures
   and pictures to compare are read from. */
#ifndef HD_IMAGE_PICTURE_H
#define HD_IMAGE_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "base/limits.h"
#include "image/frame.h"
#include "system/atomic_file.h"

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

enum { HD_MAX_TEXTURE_PIXELS = 1 << 28 };

/* Linear values, 16 bits a channel, row by row from the top: r, g, b, r, g, b, ... */
typedef struct HdTexture {
    int width, height;
    uint16_t *texels; /* owned; width * height * 3 */
} HdTexture;

/* Checks the size against HD_MAX_TEXTURE_SIDE and the limit above and allocates the texels, which
   are not cleared. `name` is for messages. */
HdStatus hd_texture_create(HdTexture *texture, uint32_t width, uint32_t height, const char *name,
                           HdError *error);

/* Frees what the texture owns and clears it; it may be clear already. */
void hd_texture_clear(HdTexture *texture);

enum { HD_MOST_FURTHER = 64 }; /* what is beyond is passed over */

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

/* ---- formats ---- */

/* What a format is that frames are stored in. Each is defined in a file format_NAME.c, those of
   films in one. Functions are NULL where the format has no such thing; `path` and `name` are for
   messages. */
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

/* ---- writing frames ---- */

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

/* ---- textures ---- */

/* Reads a texture, PNG of any kind, JPEG of 8 bits that is grey or of three colours, or the data
   format, told apart by the first bytes, and takes its values off the curve; alpha is dropped. At
   most 65535 pixels a side, and 2^28 in all. */
HdStatus hd_texture_read(HdTexture *texture, const char *path, HdCurve curve, HdError *error);

/* The same from memory; `name` is for messages. */
HdStatus hd_texture_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                           const char *name, HdCurve curve, HdError *error);

/* ---- pictures to compare ---- */

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
