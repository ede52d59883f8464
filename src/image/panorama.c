/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/panorama.h"

#include <math.h>
#include <stdlib.h>

#include "image/picture.h"
#include "system/path.h"

/* Returns false also if the file cannot be read, which the reader of textures reports. */
static bool is_linear(const char *path) {
    unsigned char head[8];
    struct stat found;
    const char *reason;
    FILE *file = hd_file_open(path, &found, &reason);
    if (file == NULL)
        return false;
    const size_t count = fread(head, 1, sizeof head, file);
    fclose(file);
    return hd_format_exr.begins(head, count) || hd_format_pfm.begins(head, count);
}

/* Uses a row of `count` values from the top. */
typedef void UseRow(void *context, const HdPictureValue *values, size_t count);

static void find_top(void *context, const HdPictureValue *values, size_t count) {
    double *top = context;
    for (size_t i = 0; i < count; i++) /* NaN is skipped */
        *top = fmax(*top, values[i].linear);
}

typedef struct Rounding {
    double top;
    uint16_t *next; /* texels of the next row */
} Rounding;

static void round_row(void *context, const HdPictureValue *values, size_t count) {
    Rounding *rounding = context;
    for (size_t i = 0; i < count; i++) {
        const double share = fmin(fmax(values[i].linear, 0.0) / rounding->top, 1.0);
        *rounding->next++ = (uint16_t)(share * UINT16_MAX + 0.5);
    }
}

static HdStatus use_rows(HdPictureReader *reader, UseRow *use, void *context, HdError *error) {
    const HdPictureFacts *facts = hd_picture_reader_facts(reader);
    const size_t count = (size_t)facts->width * 3;
    HdPictureValue *values = malloc(count * sizeof *values);
    HdStatus status = values != NULL ? hd_picture_reader_start(reader, HD_CURVE_LINEAR, error)
                                     : HD_NO_ROOM(error, "a row of a picture");
    for (int row = 0; row < facts->height && status == HD_OK; row++) {
        status = hd_picture_reader_next(reader, values, error);
        if (status == HD_OK)
            use(context, values, count);
    }
    free(values);
    return status;
}

/* Reads twice, which needs no memory for floats. */
static HdStatus read_linear(HdTexture *texture, double *top, const char *path, HdError *error) {
    HdPictureReader *reader;
    *top = 0.0;
    HD_TRY(hd_picture_reader_open(&reader, path, error));
    const HdPictureFacts *facts = hd_picture_reader_facts(reader);
    HdStatus status =
        hd_texture_create(texture, (uint32_t)facts->width, (uint32_t)facts->height, path, error);
    if (status == HD_OK)
        status = use_rows(reader, find_top, top, error);
    hd_picture_reader_close(reader);
    HD_TRY(status);
    *top = *top > 0.0 ? fmin(*top, HD_MAX_PANORAMA_LIGHT) : 1.0;
    HD_TRY(hd_picture_reader_open(&reader, path, error));
    Rounding rounding = {*top, texture->texels};
    status = use_rows(reader, round_row, &rounding, error);
    hd_picture_reader_close(reader);
    return status;
}

HdStatus hd_panorama_read(HdTexture *texture, double *top, const char *path, HdCurve curve,
                          HdError *error) {
    *top = 1.0;
    if (!is_linear(path))
        return hd_texture_read(texture, path, curve, error);
    *texture = (HdTexture){0};
    const HdStatus status = read_linear(texture, top, path, error);
    if (status != HD_OK)
        hd_texture_clear(texture);
    return status;
}
