/* SPDX-License-Identifier: MIT */
/* The formats behind picture_reader.h. `path` is for messages, and has to live as long as the rows;
   so has the file, which remains the caller's. */
#ifndef HD_IMAGE_ROW_FORMATS_H
#define HD_IMAGE_ROW_FORMATS_H

#include <stdint.h>
#include <stdio.h>

#include "image/row_reader.h"

typedef struct HdPngRows HdPngRows;
typedef struct HdPfmRows HdPfmRows;

/* Read the head of a file that stands at its begin. On failure there is nothing to close. */
HdStatus hd_png_rows_open(HdPngRows **rows, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error);
HdStatus hd_pfm_rows_open(HdPfmRows **rows, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error);

/* The next row from the top, 3 values a pixel: 0..65535 whatever the bits, and floats. */
HdStatus hd_png_rows_next(HdPngRows *rows, uint16_t *codes, HdError *error);
HdStatus hd_pfm_rows_next(HdPfmRows *rows, float *values, HdError *error);

void hd_png_rows_close(HdPngRows *rows);
void hd_pfm_rows_close(HdPfmRows *rows);

#endif
