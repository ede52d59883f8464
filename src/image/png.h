/* SPDX-License-Identifier: MIT */
/* PNG row by row: of every kind that there is as r, g, b, and r, g, b as a file. */
#ifndef HD_IMAGE_PNG_H
#define HD_IMAGE_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "image/picture.h"

typedef struct HdPngFacts {
    int width, height; /* 1..65535 each */
    int bits;          /* of a channel: 8 or 16 */
    bool is_srgb;      /* a chunk says so */
    bool is_interlaced;
} HdPngFacts;

/* True where the bytes begin with PNG's signature. */
bool hd_image_is_png(const unsigned char *bytes, size_t size);

/* Where a PNG is read from: a file that stands at its begin, or, where that is NULL, memory. It has
   to live as long as the reader. */
typedef struct HdPngSource {
    FILE *file;
    const unsigned char *bytes;
    size_t size;
} HdPngSource;

typedef struct HdPngReader HdPngReader;

/* Reads the head. `name` is for messages, and has to live as long as the reader. Chunks without
   measure are refused, and all but those of pixels and sRGB are passed over. A file of more than 16
   MiB and twice what its pixels take is wrong, and not read on. What is wrong with the file is
   HD_BAD_INPUT, here and below; HD_FAILED: memory is short. */
HdStatus hd_png_open(HdPngReader **reader, const HdPngSource *source, const char *name,
                     HdPngFacts *facts, HdError *error);

/* The next `count` rows from the top, which must be all of an interlaced picture: r, g, b of each
   pixel, 0..65535 whatever the bits; without alpha. */
HdStatus hd_png_read_rows(HdPngReader *reader, uint16_t *codes, int count, HdError *error);

/* NULL is allowed. */
void hd_png_close(HdPngReader *reader);

typedef struct HdPngWriter HdPngWriter;

/* Writes the head of a picture that is not interlaced. `path` is for messages, and has to live as
   long as the writer; so has the stream, which remains the caller's. Speed comes before size. What
   the label says becomes texts (Software, Scene, Frame, Options); NULL: none. All errors are
   HD_FAILED. */
HdStatus hd_png_begin(HdPngWriter **writer, FILE *stream, const char *path, const HdPngFacts *facts,
                      const HdPictureLabel *label, HdError *error);

/* The next row from the top as the file has it: with 16 bits the high byte comes first. */
HdStatus hd_png_write_row(HdPngWriter *writer, const unsigned char *row, HdError *error);

/* Ends the file after its last row. A label's fingerprint comes last but IEND, in a chunk of the
   type tEXt, with a hash of all bytes before (hash.h). */
HdStatus hd_png_end(HdPngWriter *writer, const HdPictureLabel *label, HdError *error);

/* That chunk and IEND. */
enum { HD_PNG_END_SIZE = 12 + 7 + 45 + 12 };

/* Whether these bytes are those of a PNG that ends with that fingerprint: not one has changed since
   it was written. */
bool hd_png_is_whole(const unsigned char *bytes, size_t size, uint64_t fingerprint);

/* In any case, at the end. NULL is allowed. */
void hd_png_free(HdPngWriter *writer);

#endif
