/* SPDX-License-Identifier: MIT */
/* libpng as every reader and writer here wants it. It reports an error by a jump to png_jmpbuf. */
#ifndef HD_IMAGE_PNG_H
#define HD_IMAGE_PNG_H

#include <stdint.h>
#include <stdio.h>

#include <png.h>

#include "base/error.h"

enum { HD_PNG_MESSAGE_SIZE = 256 };

/* Structures for reading and writing; NULL where there is no memory. Before the jump an error's
   sentence goes to `message`, which has to live as long; warnings are dropped. */
png_structp hd_png_create_reader(char message[HD_PNG_MESSAGE_SIZE]);
png_structp hd_png_create_writer(char message[HD_PNG_MESSAGE_SIZE]);

/* What a reader's error is: HD_FAILED where memory was short, else HD_BAD_INPUT. */
HdStatus hd_png_reading_status(const char *message);

/* Refuses more than 65535 pixels a side and chunks without measure, and skips all that is not
   needed for the pixels. Jumps on error, as all that follows. */
void hd_png_limit_reading(png_structp png);

/* Every kind of PNG becomes RGB, with 16 bits where it has as many, otherwise with 8. */
void hd_png_convert_to_rgb(png_structp png);

/* Where a picture is written to. */
typedef struct HdPngSink {
    FILE *stream;
    uint64_t hash; /* of the bytes so far (hash.h) */
} HdPngSink;

/* Writes to `sink`, which has to live as long, and prepares the head of an RGB picture of `bits`
   bits that is not interlaced. Speed comes before size. */
void hd_png_begin_rgb(png_structp png, png_infop info, HdPngSink *sink, int width, int height,
                      int bits);

#endif
