/* SPDX-License-Identifier: MIT */
/* PNG that is written row by row, and what finished frames end with. */
#ifndef HD_IMAGE_PNG_H
#define HD_IMAGE_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "image/format.h"

typedef struct HdPngWriter HdPngWriter;

/* Writes the head of a picture that is not interlaced. `path` is for messages, and has to live as
   long as the writer; so has the stream, which remains the caller's. Speed comes before size. What
   the label says becomes texts (Software, Scene, Frame, Options); NULL: none. All errors are
   HD_FAILED. */
HdStatus hd_png_begin(HdPngWriter **writer, FILE *stream, const char *path,
                      const HdPictureFacts *facts, const HdPictureLabel *label, HdError *error);

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
