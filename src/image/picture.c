/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/picture.h"

#include <stdlib.h>
#include <string.h>

#include "system/path.h"

/* ---- formats ---- */

#define ROW(name) {"." #name, &hd_format_##name},

static const struct {
    const char *ending;
    const HdFormat *format;
} formats[] = {HD_FILM_FORMATS(ROW, ROW, ROW) HD_PICTURE_FORMATS(ROW, ROW, ROW)};

const HdFormat *hd_format_of(const char *path) {
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (hd_path_has_ending(path, formats[i].ending))
            return formats[i].format;
    return NULL;
}

bool hd_format_is_film(const HdFormat *format) {
    return format != NULL && format->film_arguments[0] != NULL;
}

bool hd_format_has_alpha(const HdFormat *format) {
    return format->has_layers || format->has_alpha;
}

double hd_frame_rate(const HdOutputStyle *style) {
    return style->frames_per_second * (style->is_ntsc ? 1000.0 / 1001.0 : 1.0);
}

HdStatus hd_format_check_style(const char *path, const HdPictureStyle *style, HdError *error) {
    const HdFormat *format = hd_format_of(path);
    if (format != NULL && format->is_srgb_only && style->curve != HD_CURVE_SRGB)
        return hd_fail(
            error, HD_BAD_INPUT,
            "%s cannot be linear, because %s files cannot state it: expected output.curve "
            "\"srgb\", or another film",
            path, format->name);
    if (format == &hd_format_png && style->bits > 16)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s cannot have %d bits a channel: expected output.bits 8 or 16, or another "
                       "ending, such as .exr",
                       path, style->bits);
    return HD_OK;
}

/* ---- writing frames ---- */

HdStatus hd_picture_prepare(HdAtomicFile *file, const HdFrame *frame, const HdFormat *format,
                            const HdPictureStyle *style, const HdPictureLabel *label,
                            const char *path, HdError *error) {
    if (format->write == NULL)
        return hd_fail(error, HD_BAD_INPUT,
                       "cannot write %s as a picture: its ending is that of a film", path);
    HD_TRY(hd_frame_check_size(frame, error));
    HD_TRY(hd_atomic_file_open(file, path, error));
    const HdStatus status = format->write(frame, style, label, file->stream, path, error);
    if (status != HD_OK)
        hd_atomic_file_discard(file);
    return status;
}

HdStatus hd_picture_write(const HdFrame *frame, const HdPictureStyle *style, const char *path,
                          HdError *error) {
    const HdFormat *format = hd_format_of(path);
    HdAtomicFile file;
    HD_TRY(hd_picture_prepare(&file, frame, format != NULL ? format : &hd_format_data, style, NULL,
                              path, error));
    return hd_atomic_file_commit(&file, HD_DURABLE, error);
}

/* ---- textures ---- */

/* The largest texture as PNG with four 16-bit channels has 2 GiB before compression. */
static const int64_t MAX_TEXTURE_FILE = INT64_C(4) << 30;

/* Everything except PNG and JPEG may be the data format, which has no signature. */
static HdStatus decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                       const char *name, HdError *error) {
    const HdFormat *format = hd_format_png.begins(bytes, size)    ? &hd_format_png
                             : hd_format_jpeg.begins(bytes, size) ? &hd_format_jpeg
                                                                  : &hd_format_data;
    const HdStatus status = format->decode(texture, bytes, size, name, error);
    if (status != HD_OK)
        hd_texture_clear(texture);
    return status;
}

static size_t texels_of(const HdTexture *texture) {
    return (size_t)texture->width * (size_t)texture->height;
}

HdStatus hd_texture_decode(HdTexture *texture, const unsigned char *bytes, size_t size,
                           const char *name, HdCurve curve, HdError *error) {
    *texture = (HdTexture){0};
    HD_TRY(decode(texture, bytes, size, name, error));
    hd_curve_decode16(curve, texture->texels, texels_of(texture) * 3);
    return HD_OK;
}

HdStatus hd_texture_read(HdTexture *texture, const char *path, HdCurve curve, HdError *error) {
    unsigned char *bytes = NULL;
    size_t size = 0;
    *texture = (HdTexture){0};
    HD_TRY(hd_file_read(path, "texture", MAX_TEXTURE_FILE, &bytes, &size, error));
    const HdStatus status = hd_texture_decode(texture, bytes, size, path, curve, error);
    free(bytes);
    return status;
}

/* ---- masks ---- */

static bool is_white(const HdTexture *texture) {
    for (size_t i = 0; i < texels_of(texture) * 3; i++)
        if (texture->texels[i] != UINT16_MAX)
            return false;
    return true;
}

static HdStatus decode_mask(HdTexture *mask, const unsigned char *bytes, size_t size,
                            const char *name, HdError *error) {
    mask->is_mask = true;
    HD_TRY(decode(mask, bytes, size, name, error));
    if (is_white(mask)) {
        hd_texture_clear(mask);
        HD_TRY(decode(mask, bytes, size, name, error));
        mask->is_mask = true;
    }
    for (size_t i = 0; i < texels_of(mask); i++) {
        uint16_t *at = mask->texels + 3 * i;
        at[0] = at[1] = at[2] = (uint16_t)((at[0] + at[1] + at[2]) / 3);
    }
    return HD_OK;
}

HdStatus hd_mask_read(HdTexture *mask, const char *path, HdError *error) {
    unsigned char *bytes = NULL;
    size_t size = 0;
    *mask = (HdTexture){0};
    HD_TRY(hd_file_read(path, "texture", MAX_TEXTURE_FILE, &bytes, &size, error));
    const HdStatus status = decode_mask(mask, bytes, size, path, error);
    free(bytes);
    return status;
}

/* ---- pictures to compare ---- */

enum { CODES = 65536 };

struct HdPictureReader {
    FILE *file;
    const char *path; /* not owned */
    HdPictureFacts facts;
    HdCurve curve;
    void *rows;              /* owned, of the format */
    float *row;              /* owned */
    HdPictureValue *by_code; /* owned; CODES values for a picture on a curve */
};

static HdStatus open_file(HdPictureReader *reader, HdError *error) {
    struct stat found;
    const char *reason;
    reader->file = hd_file_open(reader->path, &found, &reason);
    return reader->file != NULL ? HD_OK
                                : hd_fail(error, HD_BAD_INPUT, "cannot read the picture %s: %s",
                                          reader->path, reason);
}

static HdStatus open_format(HdPictureReader *reader, HdError *error) {
    unsigned char head[8];
    size_t count = fread(head, 1, sizeof head, reader->file);
    rewind(reader->file);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        const HdFormat *format = formats[i].format;
        if (format->open_rows == NULL || !format->begins(head, count))
            continue;
        HdStatus status =
            format->open_rows(&reader->rows, reader->file, reader->path, &reader->facts, error);
        reader->facts.format = format;
        return status;
    }
    return hd_fail(error, HD_BAD_INPUT, "%s is neither PNG, OpenEXR nor PFM, expected one of these",
                   reader->path);
}

HdStatus hd_picture_reader_open(HdPictureReader **out, const char *path, HdError *error) {
    HdPictureReader *reader = calloc(1, sizeof *reader);
    if (reader == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", path);
    reader->path = path;
    HdStatus status = open_file(reader, error);
    if (status == HD_OK)
        status = open_format(reader, error);
    if (status != HD_OK)
        hd_picture_reader_close(reader);
    else
        *out = reader;
    return status;
}

const HdPictureFacts *hd_picture_reader_facts(const HdPictureReader *reader) {
    return &reader->facts;
}

HdStatus hd_picture_reader_start(HdPictureReader *reader, HdCurve curve, HdError *error) {
    const bool is_on_curve = reader->facts.format->is_on_curve;
    const int step = reader->facts.bits == 8 ? 257 : 1; /* 8 bits give no other codes */
    reader->curve = curve;
    reader->row = malloc((size_t)reader->facts.width * 3 * sizeof *reader->row);
    if (is_on_curve)
        reader->by_code = malloc(CODES * sizeof *reader->by_code);
    if (reader->row == NULL || (is_on_curve && reader->by_code == NULL))
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", reader->path);
    for (int code = 0; code < CODES && is_on_curve; code += step)
        reader->by_code[code] =
            (HdPictureValue){hd_curve_to_linear(curve, code / HD_DISPLAY_TOP), code};
    return HD_OK;
}

static HdPictureValue value_of(const HdPictureReader *reader, float number) {
    const double linear = (double)number;
    if (reader->by_code != NULL)
        return reader->by_code[(int)number];
    return (HdPictureValue){
        .linear = linear,
        .display = HD_DISPLAY_TOP * hd_curve_to_display(reader->curve, linear),
    };
}

HdStatus hd_picture_reader_next(HdPictureReader *reader, HdPictureValue *values, HdError *error) {
    const HdStatus status = reader->facts.format->next_row(reader->rows, reader->row, error);
    for (size_t i = 0; i < (size_t)reader->facts.width * 3 && status == HD_OK; i++)
        values[i] = value_of(reader, reader->row[i]);
    return status;
}

const float *hd_picture_reader_further(const HdPictureReader *reader, int channel) {
    return reader->facts.format->further_channel(reader->rows, channel);
}

void hd_picture_reader_close(HdPictureReader *reader) {
    if (reader == NULL)
        return;
    if (reader->rows != NULL)
        reader->facts.format->close_rows(reader->rows);
    if (reader->file != NULL)
        fclose(reader->file);
    free(reader->row);
    free(reader->by_code);
    free(reader);
}
