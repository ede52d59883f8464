/* SPDX-License-Identifier: MIT */
/* Reading OpenEXR in colour: a single part of lines, whose channels R, G and B are half or float.
 */
#ifndef HD_IMAGE_FORMAT_EXR_H
#define HD_IMAGE_FORMAT_EXR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/error.h"

/* A file that is being read. */
typedef struct HdExrRows HdExrRows;

typedef struct HdExrFacts {
    int width, height; /* of the data window, 1..65535 each */
    int bits;          /* of the channel with the most of R, G and B: 16 or 32 */
} HdExrFacts;

/* True where the bytes begin with OpenEXR's number. */
bool hd_image_is_exr(const unsigned char *bytes, size_t size);

/* Reads the head of a file, which remains the caller's, as the path does, and has to live as long.
   HD_BAD_INPUT where it is none, is of another kind, or has lines that take more than 1 GiB at a
   time; HD_UNAVAILABLE where the program was built without OpenEXR. */
HdStatus hd_exr_open(HdExrRows **rows, FILE *file, const char *path, HdExrFacts *facts,
                     HdError *error);

/* The next row from the top: 3 values for each pixel. */
HdStatus hd_exr_next_row(HdExrRows *rows, float *values, HdError *error);

/* NULL is allowed. */
void hd_exr_close(HdExrRows *rows);

#endif
