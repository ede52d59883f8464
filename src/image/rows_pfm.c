/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/row_formats.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

#include "base/limits.h"

struct HdPfmRows {
    FILE *file;
    const char *path;
    off_t begin; /* of the values */
    int width, height, next;
    bool is_big_endian;
    unsigned char *bytes; /* owned; a row */
};

static HdStatus fail_head(const char *path, HdError *error) {
    return hd_fail(error, HD_BAD_INPUT,
                   "cannot read %s as PFM: expected the lines PF, WIDTH HEIGHT (1..%d each) and "
                   "-1.0 or 1.0",
                   path, HD_MAX_IMAGE_SIDE);
}

/* The scale's sign is the byte order; its size has no agreed meaning, so that 1 alone is taken. One
   byte of white space comes before the values. */
static bool read_head(HdPfmRows *rows) {
    char text[96], *at, *end;
    size_t count = fread(text, 1, sizeof text - 1, rows->file);
    text[count] = '\0';
    if (strncmp(text, "PF\n", 3) != 0)
        return false;
    long width = strtol(text + 3, &at, 10);
    long height = strtol(at, &end, 10);
    if (end == at || width < 1 || width > HD_MAX_IMAGE_SIDE || height < 1 ||
        height > HD_MAX_IMAGE_SIDE)
        return false;
    double scale = strtod(end, &at);
    if (at == end || (scale != -1.0 && scale != 1.0) || *at != '\n')
        return false;
    rows->width = (int)width;
    rows->height = (int)height;
    rows->is_big_endian = scale > 0.0;
    rows->begin = at + 1 - text;
    return true;
}

static HdStatus check_size(const HdPfmRows *rows, HdError *error) {
    off_t expected = rows->begin + (off_t)rows->width * rows->height * 12;
    if (fseeko(rows->file, 0, SEEK_END) != 0 || ftello(rows->file) != expected)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s has %lld bytes, expected %lld for %d x %d pixels in PFM", rows->path,
                       (long long)ftello(rows->file), (long long)expected, rows->width,
                       rows->height);
    return HD_OK;
}

static HdStatus open_rows(HdPfmRows *rows, HdError *error) {
    if (!read_head(rows))
        return fail_head(rows->path, error);
    HdStatus status = check_size(rows, error);
    if (status != HD_OK)
        return status;
    rows->bytes = malloc((size_t)rows->width * 12);
    if (rows->bytes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", rows->path);
    return HD_OK;
}

HdStatus hd_pfm_rows_open(HdPfmRows **out, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error) {
    HdPfmRows *rows = calloc(1, sizeof *rows);
    if (rows == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", path);
    *rows = (HdPfmRows){.file = file, .path = path};
    HdStatus status = open_rows(rows, error);
    if (status != HD_OK) {
        hd_pfm_rows_close(rows);
        return status;
    }
    *facts = (HdPictureFacts){
        .format = HD_PICTURE_PFM,
        .width = rows->width,
        .height = rows->height,
        .bits = 32,
        .curve = HD_CURVE_LINEAR,
    };
    *out = rows;
    return HD_OK;
}

static float get_float(const unsigned char bytes[4], bool is_big_endian) {
    uint32_t bits = 0;
    float value;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)bytes[is_big_endian ? 3 - i : i] << (8 * i);
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The file has its rows from the bottom. */
HdStatus hd_pfm_rows_next(HdPfmRows *rows, float *values, HdError *error) {
    const size_t count = (size_t)rows->width * 3;
    off_t place = rows->begin + (off_t)(rows->height - 1 - rows->next) * rows->width * 12;
    if (fseeko(rows->file, place, SEEK_SET) != 0 ||
        fread(rows->bytes, 4, count, rows->file) != count)
        return hd_fail(error, HD_BAD_INPUT, "cannot read row %d of %s", rows->next, rows->path);
    for (size_t i = 0; i < count; i++)
        values[i] = get_float(rows->bytes + 4 * i, rows->is_big_endian);
    rows->next++;
    return HD_OK;
}

void hd_pfm_rows_close(HdPfmRows *rows) {
    if (rows == NULL)
        return;
    free(rows->bytes);
    free(rows);
}
