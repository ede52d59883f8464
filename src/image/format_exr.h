/* SPDX-License-Identifier: MIT */
/* Reading OpenEXR in colour: a single part of lines, whose channels R, G and B are half or float,
   and those further channels that are so too. */
#ifndef HD_IMAGE_FORMAT_EXR_H
#define HD_IMAGE_FORMAT_EXR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "base/error.h"

/* A file that is being read. */
typedef struct HdExrRows HdExrRows;

enum { HD_MOST_FURTHER = 64 }; /* what is beyond is passed over */

typedef struct HdExrFacts {
    int width, height;        /* of the data window, 1..65535 each */
    int bits;                 /* of the channel with the most of R, G and B: 16 or 32 */
    int further;              /* channels beside R, G and B */
    const char *const *names; /* theirs; they live as long as the rows */
} HdExrFacts;

/* True where the bytes begin with OpenEXR's number. */
bool hd_image_is_exr(const unsigned char *bytes, size_t size);

/* Reads the head of a file, which remains the caller's, as the path does, and has to live as long.
   HD_BAD_INPUT where it is none, is of another kind, or has lines that take more than 1 GiB at a
   time; HD_UNAVAILABLE where the program was built without OpenEXR. */
HdStatus hd_exr_open(HdExrRows **rows, FILE *file, const char *path, HdExrFacts *facts,
                     HdError *error);

/* Goes on to the next row, the first one from the top. */
HdStatus hd_exr_next_row(HdExrRows *rows, HdError *error);

/* The row's values of a channel: R, G, B, then the further ones; until the next row. */
const float *hd_exr_channel(const HdExrRows *rows, int channel);

/* NULL is allowed. */
void hd_exr_close(HdExrRows *rows);

#endif
