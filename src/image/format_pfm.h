/* SPDX-License-Identifier: MIT */
/* Reading PFM in colour: three lines of text, then r g b in float, row by row from the bottom. */
#ifndef HD_IMAGE_FORMAT_PFM_H
#define HD_IMAGE_FORMAT_PFM_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"

/* A file that is being read. */
typedef struct HdPfmRows {
    FILE *file;       /* the caller's */
    const char *path; /* the caller's; for messages */
    int width, height, next;
    int64_t begin; /* of the values */
    bool is_big_endian;
} HdPfmRows;

/* Reads the head of a file that stands at its begin. There is nothing to close. */
HdStatus hd_pfm_open(HdPfmRows *rows, FILE *file, const char *path, HdError *error);

/* The next row from the top: 3 values for each pixel. */
HdStatus hd_pfm_next_row(HdPfmRows *rows, float *values, HdError *error);

#endif
