/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/picture_formats.h"

#include <errno.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#include "image/mark.h"
#include "image/png.h"

enum { SIGNATURE_SIZE = 8, SIZE_OFFSET = 16, SIZE_END = 24 };

/* Everything that must outlive a jump out of libpng lives here, not in local variables. */
typedef struct PngJob {
    png_structp png;
    png_infop info;
    const unsigned char *bytes; /* the part not read yet */
    size_t size;
    unsigned bits; /* of the rows that were read */
    HdPngSink sink;
    char message[HD_PNG_MESSAGE_SIZE];
} PngJob;

static void read_bytes(png_structp png, png_bytep out, size_t count) {
    PngJob *job = png_get_io_ptr(png);
    if (count > job->size)
        png_error(png, "the file ends too early");
    memcpy(out, job->bytes, count);
    job->bytes += count;
    job->size -= count;
}

bool hd_image_is_png(const unsigned char *bytes, size_t size) {
    return size >= SIGNATURE_SIZE && png_sig_cmp(bytes, 0, SIGNATURE_SIZE) == 0;
}

/* libpng refuses large pictures too, but does not say how large they are. */
static HdStatus create_texture(HdTexture *texture, const unsigned char *bytes, size_t size,
                               const char *name, HdError *error) {
    if (size < SIZE_END || memcmp(bytes + SIZE_OFFSET - 4, "IHDR", 4) != 0)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot read %s: expected PNG's IHDR chunk after the signature", name);
    return hd_texture_create(texture, png_get_uint_32(bytes + SIZE_OFFSET),
                             png_get_uint_32(bytes + SIZE_OFFSET + 4), name, error);
}

/* Runs under setjmp. Rows of 8 bits fill the first half of the texels' row. An interlaced picture
   passes over the same rows several times. */
static void read_rows(PngJob *job, const HdTexture *texture) {
    const size_t row_size = (size_t)texture->width * 6;
    png_set_read_fn(job->png, job, read_bytes);
    hd_png_limit_reading(job->png);
    png_read_info(job->png, job->info);
    hd_png_convert_to_rgb(job->png);
    int passes = png_set_interlace_handling(job->png);
    png_read_update_info(job->png, job->info);
    job->bits = png_get_bit_depth(job->png, job->info);
    if (png_get_rowbytes(job->png, job->info) * 16 != row_size * job->bits)
        png_error(job->png, "unexpected size of a row");
    for (int pass = 0; pass < passes; pass++)
        for (int y = 0; y < texture->height; y++)
            png_read_row(job->png, (png_bytep)texture->texels + row_size * (size_t)y, NULL);
    png_read_end(job->png, NULL);
}

static bool try_reading(PngJob *job, const HdTexture *texture) {
    if (setjmp(png_jmpbuf(job->png)) != 0)
        return false;
    read_rows(job, texture);
    return true;
}

/* PNG is big endian. */
static void take_off_curve16(HdTexture *texture, HdCurve curve) {
    size_t count = (size_t)texture->width * (size_t)texture->height * 3;
    const unsigned char *bytes = (const unsigned char *)texture->texels;
    for (size_t i = 0; i < count; i++)
        texture->texels[i] = (uint16_t)(bytes[2 * i] << 8 | bytes[2 * i + 1]);
    hd_curve_decode16(curve, texture->texels, count);
}

/* From the end of each row to its begin, since the bytes lie in the row that they become. */
static void take_off_curve8(HdTexture *texture, HdCurve curve) {
    const size_t values = (size_t)texture->width * 3;
    uint16_t decoded[256];
    hd_curve_decode8(curve, decoded);
    for (int y = 0; y < texture->height; y++) {
        uint16_t *row = texture->texels + values * (size_t)y;
        const unsigned char *bytes = (const unsigned char *)row;
        for (size_t i = values; i-- > 0;)
            row[i] = decoded[bytes[i]];
    }
}

HdStatus hd_image_png_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                             const char *name, HdCurve curve, HdError *error) {
    PngJob job = {.bytes = bytes, .size = size, .message = "out of memory"};
    HdStatus status = create_texture(texture, bytes, size, name, error);
    if (status != HD_OK)
        return status;
    job.png = hd_png_create_reader(job.message);
    if (job.png != NULL)
        job.info = png_create_info_struct(job.png);
    bool done = job.info != NULL && try_reading(&job, texture);
    png_destroy_read_struct(&job.png, &job.info, NULL);
    if (!done)
        return hd_fail(error, hd_png_reading_status(job.message), "cannot read %s as PNG: %s", name,
                       job.message);
    if (job.bits == 16)
        take_off_curve16(texture, curve);
    else
        take_off_curve8(texture, curve);
    return HD_OK;
}

/* Runs under setjmp. The alpha of each pixel is 255. */
static void read_rgba(PngJob *job, HdFrame *frame) {
    const size_t row_size = (size_t)frame->width * 4;
    png_set_read_fn(job->png, job, read_bytes);
    hd_png_limit_reading(job->png);
    png_read_info(job->png, job->info);
    png_set_filler(job->png, 255, PNG_FILLER_AFTER);
    png_read_update_info(job->png, job->info);
    if (png_get_image_width(job->png, job->info) != (png_uint_32)frame->width ||
        png_get_image_height(job->png, job->info) != (png_uint_32)frame->height ||
        png_get_rowbytes(job->png, job->info) != row_size)
        png_error(job->png, "unexpected size or kind of picture");
    for (int y = 0; y < frame->height; y++)
        png_read_row(job->png, frame->rgba + row_size * (size_t)y, NULL);
    png_read_end(job->png, NULL);
}

static bool try_reading_rgba(PngJob *job, HdFrame *frame) {
    if (setjmp(png_jmpbuf(job->png)) != 0)
        return false;
    read_rgba(job, frame);
    return true;
}

HdStatus hd_image_png_load(HdFrame *frame, const unsigned char *bytes, size_t size,
                           const char *name, HdError *error) {
    PngJob job = {.bytes = bytes, .size = size, .message = "out of memory"};
    job.png = hd_png_create_reader(job.message);
    if (job.png != NULL)
        job.info = png_create_info_struct(job.png);
    bool done = job.info != NULL && try_reading_rgba(&job, frame);
    png_destroy_read_struct(&job.png, &job.info, NULL);
    if (!done)
        return hd_fail(error, HD_FAILED, "cannot read %s as PNG: %s", name, job.message);
    frame->is_encoded = true;
    return HD_OK;
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

/* Runs under setjmp. */
static void write_end(PngJob *job, const uint64_t *fingerprint) {
    unsigned char end[HD_PICTURE_END_SIZE];
    if (fingerprint == NULL) {
        png_write_end(job->png, NULL);
        return;
    }
    hd_picture_end(*fingerprint, job->sink.hash, end);
    if (fwrite(end, 1, sizeof end, job->sink.stream) != sizeof end)
        png_error(job->png, strerror(errno));
}

/* Runs under setjmp. */
static void write_rows(PngJob *job, const HdFrame *frame, const HdPictureStyle *style,
                       const uint64_t *fingerprint, uint16_t *row) {
    const size_t width = (size_t)frame->width, values = width * 3;
    hd_png_begin_rgb(job->png, job->info, &job->sink, frame->width, frame->height, style->bits);
    if (style->curve == HD_CURVE_SRGB)
        png_set_sRGB(job->png, job->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(job->png, job->info);
    for (int y = 0; y < frame->height; y++) {
        if (frame->is_encoded)
            copy_row(frame->rgba + width * 4 * (size_t)y, width, (uint8_t *)row);
        else
            encode_row(style, frame->rgb + values * (size_t)y, values, row);
        png_write_row(job->png, (png_const_bytep)row);
    }
    write_end(job, fingerprint);
}

static bool try_writing(PngJob *job, const HdFrame *frame, const HdPictureStyle *style,
                        const uint64_t *fingerprint, uint16_t *row) {
    if (setjmp(png_jmpbuf(job->png)) != 0)
        return false;
    write_rows(job, frame, style, fingerprint, row);
    return true;
}

HdStatus hd_image_png_write(const HdFrame *frame, const HdPictureStyle *style,
                            const uint64_t *fingerprint, FILE *stream, const char *path,
                            HdError *error) {
    PngJob job = {.sink = {.stream = stream}, .message = "out of memory"};
    uint16_t *row = malloc((size_t)frame->width * 3 * sizeof *row);
    if (row != NULL)
        job.png = hd_png_create_writer(job.message);
    if (job.png != NULL)
        job.info = png_create_info_struct(job.png);
    bool done = job.info != NULL && try_writing(&job, frame, style, fingerprint, row);
    png_destroy_write_struct(&job.png, &job.info);
    free(row);
    if (!done)
        return hd_fail(error, HD_FAILED, "cannot write %s: %s", path, job.message);
    return HD_OK;
}
