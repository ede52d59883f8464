/* SPDX-License-Identifier: MIT */
/* PFM in colour: three lines of text, then r g b in float, row by row from the bottom. */
#define _POSIX_C_SOURCE 200809L

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

#include "base/limits.h"
#include "base/low_bytes.h"
#include "base/minmax.h"
#include "image/format.h"

/* A file being read. */
typedef struct PfmRows {
    FILE *file;       /* not owned */
    const char *path; /* not owned; for messages */
    int width, height, next;
    int64_t begin; /* offset of the values */
    bool is_big_endian, is_grey;
} PfmRows;

static bool begins(const unsigned char *bytes, size_t size) {
    return size >= 2 && (memcmp(bytes, "PF", 2) == 0 || memcmp(bytes, "Pf", 2) == 0);
}

static HdStatus fail_head(const PfmRows *rows, HdError *error) {
    if (rows->is_grey)
        return hd_fail(error, HD_BAD_INPUT, "%s is a PFM without colour, expected one with r, g, b",
                       rows->path);
    return hd_fail(error, HD_BAD_INPUT,
                   "cannot read %s as PFM: expected the lines PF, WIDTH HEIGHT (1..%d each) and "
                   "-1.0 or 1.0",
                   rows->path, HD_MAX_IMAGE_SIDE);
}

/* The scale's sign is the byte order. Its size has no agreed meaning, so only 1 is accepted. One
   white-space byte precedes the values. */
static bool read_head(PfmRows *rows) {
    char text[96] = "", *at, *end;
    size_t count = fread(text, 1, sizeof text - 1, rows->file);
    text[count] = '\0';
    rows->is_grey = text[1] == 'f';
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

static HdStatus check_size(const PfmRows *rows, HdError *error) {
    const int64_t expected = rows->begin + (int64_t)rows->width * rows->height * 12;
    if (fseeko(rows->file, 0, SEEK_END) != 0 || ftello(rows->file) != expected)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s has %lld bytes, expected %lld for %d x %d pixels in PFM", rows->path,
                       (long long)ftello(rows->file), (long long)expected, rows->width,
                       rows->height);
    return HD_OK;
}

static HdStatus open_rows(void **out, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error) {
    PfmRows *rows = calloc(1, sizeof *rows);
    if (rows == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", path);
    rows->file = file;
    rows->path = path;
    const HdStatus status = read_head(rows) ? check_size(rows, error) : fail_head(rows, error);
    *facts = (HdPictureFacts){.width = rows->width, .height = rows->height, .bits = 32};
    if (status == HD_OK)
        *out = rows;
    else
        free(rows);
    return status;
}

static float get_float(const unsigned char bytes[4], bool is_big_endian) {
    uint32_t bits = 0;
    float value;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)bytes[is_big_endian ? 3 - i : i] << (8 * i);
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Reads bytes in place, where they become values; the file stores rows from the bottom. */
static HdStatus next_row(void *state, float *values, HdError *error) {
    PfmRows *rows = state;
    const size_t count = (size_t)rows->width * 3;
    const unsigned char *bytes = (const unsigned char *)values;
    const int64_t place = rows->begin + (int64_t)(rows->height - 1 - rows->next) * rows->width * 12;
    if (fseeko(rows->file, (off_t)place, SEEK_SET) != 0 ||
        fread(values, 4, count, rows->file) != count)
        return hd_fail(error, HD_BAD_INPUT, "cannot read row %d of %s", rows->next, rows->path);
    for (size_t i = 0; i < count; i++)
        values[i] = get_float(bytes + 4 * i, rows->is_big_endian);
    rows->next++;
    return HD_OK;
}

/* Writes each value with its low byte first, on every machine. */
static bool put_floats(const float *values, size_t count, FILE *stream) {
    enum { AT_ONCE = 1024 };
    unsigned char bytes[4 * AT_ONCE];
    bool good = true;
    for (size_t first = 0; first < count && good; first += AT_ONCE) {
        const size_t some = hd_min_size(count - first, AT_ONCE);
        for (size_t i = 0; i < some; i++) {
            uint32_t bits;
            memcpy(&bits, values + first + i, sizeof bits);
            hd_put_low_bytes(bytes + 4 * i, bits, 4);
        }
        good = fwrite(bytes, 4, some, stream) == some;
    }
    return good;
}

/* The scale's sign states the order of bytes. */
static HdStatus write(const HdFrame *frame, const HdPictureStyle *style,
                      const HdPictureLabel *label, FILE *stream, const char *path, HdError *error) {
    const size_t values = (size_t)frame->width * 3;
    (void)style; /* always linear */
    (void)label; /* cannot hold metadata */
    bool good = fprintf(stream, "PF\n%d %d\n-1.0\n", frame->width, frame->height) > 0;
    for (int y = frame->height - 1; y >= 0 && good; y--)
        good = put_floats(frame->rgb + values * (size_t)y, values, stream);
    return good ? HD_OK : hd_fail(error, HD_FAILED, "cannot write %s: %s", path, strerror(errno));
}

const HdFormat hd_format_pfm = {
    .name = "PFM",
    .write = write,
    .max_encoded_bits = 0,
    .begins = begins,
    .open_rows = open_rows,
    .next_row = next_row,
    .close_rows = free,
};
