/* SPDX-License-Identifier: MIT */
/* Frames and textures as PNG. */
#include <stdlib.h>
#include <string.h>

#include "image/format.h"
#include "image/png.h"

enum { SIZE_OFFSET = 16, SIZE_END = 24 };

static uint32_t get_uint32(const unsigned char bytes[4]) {
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

/* libpng refuses large pictures too, but does not say how large they are. */
static HdStatus create_texture(HdTexture *texture, const unsigned char *bytes, size_t size,
                               const char *name, HdError *error) {
    if (size < SIZE_END || memcmp(bytes + SIZE_OFFSET - 4, "IHDR", 4) != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot read %s: expected PNG's IHDR chunk after the signature", name);
    return hd_texture_create(texture, get_uint32(bytes + SIZE_OFFSET),
                             get_uint32(bytes + SIZE_OFFSET + 4), name, error);
}

static void take_off_curve(HdTexture *texture, HdCurve curve, int bits) {
    const size_t count = (size_t)texture->width * (size_t)texture->height * 3;
    uint16_t decoded[256];
    if (bits == 16) {
        hd_curve_decode16(curve, texture->texels, count);
        return;
    }
    hd_curve_decode8(curve, decoded);
    for (size_t i = 0; i < count; i++)
        texture->texels[i] = decoded[texture->texels[i] >> 8];
}

static HdStatus decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdCurve curve, HdError *error) {
    const HdPngSource source = {.bytes = bytes, .size = size};
    HdPngReader *reader = NULL;
    HdPngFacts facts;
    HdStatus status = create_texture(texture, bytes, size, name, error);
    if (status == HD_OK)
        status = hd_png_open(&reader, &source, name, &facts, error);
    if (status == HD_OK)
        status = hd_png_read_rows(reader, texture->texels, texture->height, error);
    hd_png_close(reader);
    if (status == HD_OK)
        take_off_curve(texture, curve, facts.bits);
    return status;
}

/* The alpha of each pixel is 255. */
static void fill_rgba(const uint16_t *codes, size_t pixels, uint8_t *rgba) {
    for (size_t i = 0; i < pixels; i++) {
        for (size_t c = 0; c < 3; c++)
            rgba[4 * i + c] = (uint8_t)(codes[3 * i + c] >> 8);
        rgba[4 * i + 3] = 255;
    }
}

static HdStatus load_rows(HdFrame *frame, HdPngReader *reader, const char *name, HdError *error) {
    const size_t width = (size_t)frame->width;
    uint16_t *codes = malloc(width * 3 * sizeof *codes);
    if (codes == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", name);
    HdStatus status = HD_OK;
    for (int y = 0; y < frame->height && status == HD_OK; y++) {
        status = hd_png_read_rows(reader, codes, 1, error);
        if (status == HD_OK)
            fill_rgba(codes, width, frame->rgba + width * 4 * (size_t)y);
    }
    free(codes);
    return status;
}

static HdStatus load(HdFrame *frame, const unsigned char *bytes, size_t size, const char *name,
                     HdError *error) {
    const HdPngSource source = {.bytes = bytes, .size = size};
    HdPngReader *reader;
    HdPngFacts facts;
    HdStatus status = hd_png_open(&reader, &source, name, &facts, error);
    if (status != HD_OK)
        return status;
    if (facts.width != frame->width || facts.height != frame->height || facts.bits != 8 ||
        facts.is_interlaced)
        status = hd_fail(error, HD_FAILED,
                         "cannot read %s as PNG: unexpected size or kind of picture", name);
    else
        status = load_rows(frame, reader, name, error);
    hd_png_close(reader);
    frame->is_encoded |= status == HD_OK;
    return status;
}

/* A row of the file; PNG is big endian. With 16 bits the codes are made in the row itself. */
static void encode_row(const HdPictureStyle *style, const float *rgb, size_t values,
                       uint16_t *row) {
    unsigned char *bytes = (unsigned char *)row;
    if (style->bits == 8) {
        hd_curve_encode8(style->curve, rgb, values, bytes);
        return;
    }
    hd_curve_encode16(style->curve, rgb, values, row);
    for (size_t i = 0; i < values; i++) {
        const unsigned code = row[i];
        bytes[2 * i] = (unsigned char)(code >> 8);
        bytes[2 * i + 1] = (unsigned char)(code & 0xff);
    }
}

/* Of a frame that is encoded: the same without alpha. */
static void copy_row(const uint8_t *rgba, size_t pixels, uint8_t *row) {
    for (size_t i = 0; i < pixels; i++)
        memcpy(row + 3 * i, rgba + 4 * i, 3);
}

static HdStatus write_rows(HdPngWriter *writer, const HdFrame *frame, const HdPictureStyle *style,
                           uint16_t *row, HdError *error) {
    const size_t width = (size_t)frame->width, values = width * 3;
    HdStatus status = HD_OK;
    for (int y = 0; y < frame->height && status == HD_OK; y++) {
        if (frame->is_encoded)
            copy_row(frame->rgba + width * 4 * (size_t)y, width, (uint8_t *)row);
        else
            encode_row(style, frame->rgb + values * (size_t)y, values, row);
        status = hd_png_write_row(writer, (const unsigned char *)row, error);
    }
    return status;
}

static HdStatus write(const HdFrame *frame, const HdPictureStyle *style,
                      const HdPictureLabel *label, FILE *stream, const char *path, HdError *error) {
    const HdPngFacts facts = {.width = frame->width,
                              .height = frame->height,
                              .bits = style->bits,
                              .is_srgb = style->curve == HD_CURVE_SRGB};
    HdPngWriter *writer = NULL;
    uint16_t *row = malloc((size_t)frame->width * 3 * sizeof *row);
    if (row == NULL)
        return hd_fail(error, HD_FAILED, "cannot write %s: out of memory", path);
    HdStatus status = hd_png_begin(&writer, stream, path, &facts, label, error);
    if (status == HD_OK)
        status = write_rows(writer, frame, style, row, error);
    if (status == HD_OK)
        status = hd_png_end(writer, label, error);
    hd_png_free(writer);
    free(row);
    return status;
}

const HdFormat hd_format_png = {
    .name = "PNG",
    .write = write,
    .most_encoded_bits = 8,
    .load = load,
    .decode = decode,
};
