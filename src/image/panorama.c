/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/panorama.h"

#include <math.h>
#include <stdlib.h>

#include "image/picture.h"
#include "system/path.h"

/* What a file's first bytes tell. */
typedef enum Kind { KIND_TEXTURE, KIND_LINEAR, KIND_OTHER } Kind;

static HdStatus find_kind(Kind *kind, const char *path, HdError *error) {
    unsigned char head[8];
    struct stat found;
    const char *reason;
    FILE *file = hd_file_open(path, &found, &reason);
    if (file == NULL)
        return hd_fail(error, HD_BAD_INPUT, "cannot read the environment %s: %s", path, reason);
    const size_t count = fread(head, 1, sizeof head, file);
    fclose(file);
    *kind = KIND_OTHER;
    if (hd_format_exr.begins(head, count) || hd_format_pfm.begins(head, count))
        *kind = KIND_LINEAR;
    else if (hd_format_png.begins(head, count) || hd_format_jpeg.begins(head, count))
        *kind = KIND_TEXTURE;
    return HD_OK;
}

/* Uses a row of `count` values from the top. */
typedef void UseRow(void *context, const HdPictureValue *values, size_t count);

typedef struct Light {
    double top;
    int64_t wrong; /* values that are infinite or NaN */
} Light;

static void find_top(void *context, const HdPictureValue *values, size_t count) {
    Light *light = context;
    for (size_t i = 0; i < count; i++) { /* NaN is skipped */
        light->top = fmax(light->top, values[i].linear);
        light->wrong += !isfinite(values[i].linear);
    }
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
    if (values == NULL)
        return HD_NO_ROOM(error, "a row of a picture");
    HdStatus status = hd_picture_reader_start(reader, HD_CURVE_LINEAR, error);
    for (int row = 0; row < facts->height && status == HD_OK; row++) {
        status = hd_picture_reader_next(reader, values, error);
        if (status == HD_OK)
            use(context, values, count);
    }
    free(values);
    return status;
}

static void note_light(const Light *light, const char *path, HdProblems *notes) {
    if (notes == NULL)
        return;
    if (light->wrong > 0)
        hd_problem(notes,
                   "%s has infinite or NaN values (%lld): infinite ones count as %g, NaN as 0",
                   path, (long long)light->wrong, HD_MAX_PANORAMA_LIGHT);
    if (isfinite(light->top) && light->top > HD_MAX_PANORAMA_LIGHT)
        hd_problem(notes, "%s: light up to %.3g is clamped to %g", path, light->top,
                   HD_MAX_PANORAMA_LIGHT);
}

/* Reads twice, which needs no memory for floats. */
static HdStatus read_linear(HdTexture *texture, double *top, const char *path, HdProblems *notes,
                            HdError *error) {
    HdPictureReader *reader;
    Light light = {0};
    HD_TRY(hd_picture_reader_open(&reader, path, error));
    const HdPictureFacts *facts = hd_picture_reader_facts(reader);
    HdStatus status =
        hd_texture_create(texture, (uint32_t)facts->width, (uint32_t)facts->height, path, error);
    if (status == HD_OK)
        status = use_rows(reader, find_top, &light, error);
    hd_picture_reader_close(reader);
    HD_TRY(status);
    note_light(&light, path, notes);
    *top = light.top > 0.0 ? fmin(light.top, HD_MAX_PANORAMA_LIGHT) : 1.0;
    HD_TRY(hd_picture_reader_open(&reader, path, error));
    Rounding rounding = {*top, texture->texels};
    status = use_rows(reader, round_row, &rounding, error);
    hd_picture_reader_close(reader);
    return status;
}

static HdStatus read_texture(HdTexture *texture, Kind kind, const char *path, HdCurve curve,
                             HdError *error) {
    const HdStatus status = hd_texture_read(texture, path, curve, error);
    if (status != HD_BAD_INPUT || kind != KIND_OTHER || error == NULL)
        return status;
    const HdError cause = *error;
    return hd_fail(error, status,
                   "%s; an environment may also be OpenEXR or PFM, and a Radiance .hdr must be "
                   "converted to OpenEXR",
                   cause.message);
}

HdStatus hd_panorama_read(HdTexture *texture, double *top, const char *path, HdCurve curve,
                          HdProblems *notes, HdError *error) {
    Kind kind = KIND_OTHER;
    *top = 1.0;
    *texture = (HdTexture){0};
    HD_TRY(find_kind(&kind, path, error));
    if (kind != KIND_LINEAR)
        return read_texture(texture, kind, path, curve, error);
    const HdStatus status = read_linear(texture, top, path, notes, error);
    if (status != HD_OK)
        hd_texture_clear(texture);
    return status;
}
