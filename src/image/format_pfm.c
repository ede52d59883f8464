/* SPDX-License-Identifier: MIT */
/* PFM: three lines of text, then r g b in float, row by row from the bottom. */
#define _POSIX_C_SOURCE 200809L

#include "image/picture_formats.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Little endian, which the negative scale of the head stands for. */
static void put_float(unsigned char out[4], float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; i++)
        out[i] = (unsigned char)(bits >> (8 * i) & 0xff);
}

static bool write_all(const HdFrame *frame, FILE *stream, unsigned char *row) {
    const size_t values = (size_t)frame->width * 3;
    bool good = fprintf(stream, "PF\n%d %d\n-1.0\n", frame->width, frame->height) > 0;
    for (int y = frame->height - 1; y >= 0 && good; y--) {
        const float *rgb = frame->rgb + values * (size_t)y;
        for (size_t i = 0; i < values; i++)
            put_float(row + 4 * i, rgb[i]);
        good = fwrite(row, 4, values, stream) == values;
    }
    return good;
}

HdStatus hd_image_pfm_write(const HdFrame *frame, FILE *stream, const char *path, HdError *error) {
    unsigned char *row = malloc((size_t)frame->width * 12);
    if (row == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to write %s", path);
    bool good = write_all(frame, stream, row);
    int reason = errno;
    free(row);
    if (!good)
        return hd_fail(error, HD_FAILED, "cannot write %s: %s", path, strerror(reason));
    return HD_OK;
}
