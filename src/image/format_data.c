/* SPDX-License-Identifier: MIT */
/* The data format: int32 width, int32 height, then r g b a, little endian. */
#define _POSIX_C_SOURCE 200809L

#include "image/format.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/limits.h"

enum { HEAD_SIZE = 8 };

static void put_int32(unsigned char out[4], int value) {
    uint32_t bits = (uint32_t)value;
    for (int i = 0; i < 4; i++)
        out[i] = (unsigned char)(bits >> (8 * i) & 0xff);
}

static int64_t get_int32(const unsigned char bytes[4]) {
    uint32_t bits = 0;
    for (int i = 0; i < 4; i++)
        bits |= (uint32_t)bytes[i] << (8 * i);
    return bits > INT32_MAX ? (int64_t)bits - (INT64_C(1) << 32) : (int64_t)bits;
}

static bool write_all(const HdFrame *frame, HdCurve curve, FILE *stream, uint8_t *row) {
    unsigned char head[HEAD_SIZE];
    const size_t width = (size_t)frame->width;
    put_int32(head, frame->width);
    put_int32(head + 4, frame->height);
    bool good = fwrite(head, 1, HEAD_SIZE, stream) == HEAD_SIZE;
    for (int y = 0; y < frame->height && good; y++) {
        const uint8_t *pixels = row;
        if (frame->is_encoded)
            pixels = frame->rgba + width * 4 * (size_t)y;
        else
            hd_curve_encode_rgba(curve, frame->rgb + width * 3 * (size_t)y, width, row);
        good = fwrite(pixels, 4, width, stream) == width;
    }
    return good;
}

static HdStatus write(const HdFrame *frame, const HdPictureStyle *style,
                      const HdPictureLabel *label, FILE *stream, const char *path, HdError *error) {
    (void)label; /* there is no place for it */
    uint8_t *row = malloc((size_t)frame->width * 4);
    if (row == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to write %s", path);
    bool good = write_all(frame, style->curve, stream, row);
    int reason = errno;
    free(row);
    if (!good)
        return hd_fail(error, HD_FAILED, "cannot write %s: %s", path, strerror(reason));
    return HD_OK;
}

/* Anything that is neither PNG nor JPEG arrives here, so that wrong sizes most often mean another
 * format. */
static HdStatus check_head(const unsigned char *bytes, size_t size, const char *name,
                           HdError *error) {
    if (size < HEAD_SIZE)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is neither PNG, JPEG nor the data format: it has %zu bytes, expected at "
                       "least %d",
                       name, size, HEAD_SIZE);
    int64_t width = get_int32(bytes), height = get_int32(bytes + 4);
    if (width < 1 || width > HD_MAX_IMAGE_SIDE || height < 1 || height > HD_MAX_IMAGE_SIDE)
        return hd_fail(
            error, HD_BAD_INPUT,
            "%s is neither PNG, JPEG nor the data format: its first 8 bytes say %lld x %lld "
            "pixels, expected 1..%d each",
            name, (long long)width, (long long)height, HD_MAX_IMAGE_SIDE);
    uint64_t expected = HEAD_SIZE + (uint64_t)width * (uint64_t)height * 4;
    if (size != expected)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s has %zu bytes, expected %llu for %lld x %lld pixels in the data format",
                       name, size, (unsigned long long)expected, (long long)width,
                       (long long)height);
    return HD_OK;
}

static bool has_bytes(const unsigned char *bytes, size_t size, size_t at, const char *expected) {
    return size >= at + strlen(expected) && memcmp(bytes + at, expected, strlen(expected)) == 0;
}

/* By the first bytes, where they are no picture in the data format; NULL: unknown. */
static const char *foreign_format(const unsigned char *bytes, size_t size) {
    if (has_bytes(bytes, size, 0, "GIF8"))
        return "GIF";
    if (has_bytes(bytes, size, 0, "RIFF") && has_bytes(bytes, size, 8, "WEBP"))
        return "WebP";
    if (has_bytes(bytes, size, 0, "BM"))
        return "BMP";
    if (has_bytes(bytes, size, 0, "II*") ||
        (has_bytes(bytes, size, 0, "MM") && has_bytes(bytes, size, 3, "*")))
        return "TIFF";
    return NULL;
}

static HdStatus refuse_foreign(const unsigned char *bytes, size_t size, const char *name,
                               HdError *error) {
    const char *format = foreign_format(bytes, size);
    if (format == NULL)
        return HD_BAD_INPUT;
    return hd_fail(error, HD_BAD_INPUT, "%s is a %s picture, expected PNG, JPEG or the data format",
                   name, format);
}

static HdStatus decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdCurve curve, HdError *error) {
    HdStatus status = check_head(bytes, size, name, error);
    if (status != HD_OK)
        return refuse_foreign(bytes, size, name, error);
    status = hd_texture_create(texture, (uint32_t)get_int32(bytes), (uint32_t)get_int32(bytes + 4),
                               name, error);
    if (status != HD_OK)
        return status;
    uint16_t decoded[256];
    hd_curve_decode8(curve, decoded);
    const unsigned char *rgba = bytes + HEAD_SIZE;
    size_t pixels = (size_t)texture->width * (size_t)texture->height;
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < 3; c++)
            texture->texels[i * 3 + c] = decoded[rgba[i * 4 + c]];
    return HD_OK;
}

/* Its 8 bits are made of any style. */
const HdFormat hd_format_data = {
    .name = "the data format",
    .write = write,
    .most_encoded_bits = 16,
    .decode = decode,
};
