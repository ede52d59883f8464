/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/row_reader.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/format_exr.h"
#include "image/format_pfm.h"
#include "image/png.h"

enum { CODES = 65536 };

struct HdPictureReader {
    FILE *file;
    const char *path; /* the caller's */
    HdPictureFacts facts;
    HdCurve curve;
    HdPngReader *png; /* owned; this and the next NULL: PFM is read */
    HdExrRows *exr;   /* owned */
    HdPfmRows pfm;
    void *row;               /* owned; codes of PNG, radiances of PFM */
    HdPictureValue *by_code; /* owned; of PNG: CODES of them */
};

/* Not blocking, lest a named pipe stops the program before it is refused. */
static HdStatus open_file(HdPictureReader *reader, HdError *error) {
    struct stat found;
    int descriptor = open(reader->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor >= 0 && fstat(descriptor, &found) == 0 && !S_ISREG(found.st_mode)) {
        close(descriptor);
        return hd_fail(error, HD_BAD_INPUT, "cannot read the picture %s: it is not a regular file",
                       reader->path);
    }
    if (descriptor >= 0)
        reader->file = fdopen(descriptor, "rb");
    if (reader->file != NULL)
        return HD_OK;
    int reason = errno;
    if (descriptor >= 0)
        close(descriptor);
    return hd_fail(error, HD_BAD_INPUT, "cannot read the picture %s: %s", reader->path,
                   strerror(reason));
}

static HdStatus open_png(HdPictureReader *reader, HdError *error) {
    const HdPngSource source = {.file = reader->file};
    HdPngFacts facts;
    HdStatus status = hd_png_open(&reader->png, &source, reader->path, &facts, error);
    if (status != HD_OK)
        return status;
    if (facts.is_interlaced)
        return hd_fail(error, HD_BAD_INPUT,
                       "%s is an interlaced PNG, expected one whose rows follow each other",
                       reader->path);
    reader->facts = (HdPictureFacts){
        .format = &hd_format_png,
        .width = facts.width,
        .height = facts.height,
        .bits = facts.bits,
        .curve = facts.is_srgb ? HD_CURVE_SRGB : HD_CURVE_LINEAR,
    };
    return HD_OK;
}

static HdStatus open_exr(HdPictureReader *reader, HdError *error) {
    HdExrFacts facts = {0};
    const HdStatus status = hd_exr_open(&reader->exr, reader->file, reader->path, &facts, error);
    reader->facts = (HdPictureFacts){
        .format = &hd_format_exr,
        .width = facts.width,
        .height = facts.height,
        .bits = facts.bits,
        .curve = HD_CURVE_LINEAR,
        .further = facts.further,
        .names = facts.names,
    };
    return status;
}

static HdStatus open_pfm(HdPictureReader *reader, HdError *error) {
    const HdStatus status = hd_pfm_open(&reader->pfm, reader->file, reader->path, error);
    reader->facts = (HdPictureFacts){
        .format = &hd_format_pfm,
        .width = reader->pfm.width,
        .height = reader->pfm.height,
        .bits = 32,
        .curve = HD_CURVE_LINEAR,
    };
    return status;
}

static HdStatus open_format(HdPictureReader *reader, HdError *error) {
    unsigned char head[8];
    size_t count = fread(head, 1, sizeof head, reader->file);
    rewind(reader->file);
    if (hd_image_is_png(head, count))
        return open_png(reader, error);
    if (hd_image_is_exr(head, count))
        return open_exr(reader, error);
    if (count >= 2 && memcmp(head, "PF", 2) == 0)
        return open_pfm(reader, error);
    if (count >= 2 && memcmp(head, "Pf", 2) == 0)
        return hd_fail(error, HD_BAD_INPUT, "%s is a PFM without colour, expected one with r, g, b",
                       reader->path);
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

/* With 8 bits only every 257th code is there. */
static void fill_codes(HdPictureReader *reader) {
    int step = reader->facts.bits == 8 ? 257 : 1;
    for (int code = 0; code < CODES; code += step) {
        reader->by_code[code] = (HdPictureValue){
            .linear = hd_curve_to_linear(reader->curve, code / HD_DISPLAY_TOP),
            .display = code,
        };
    }
}

HdStatus hd_picture_reader_start(HdPictureReader *reader, HdCurve curve, HdError *error) {
    reader->curve = curve;
    reader->row = malloc((size_t)reader->facts.width * 3 * sizeof(float));
    if (reader->png != NULL)
        reader->by_code = malloc(CODES * sizeof *reader->by_code);
    if (reader->row == NULL || (reader->png != NULL && reader->by_code == NULL))
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", reader->path);
    if (reader->png != NULL)
        fill_codes(reader);
    return HD_OK;
}

static HdStatus next_of_png(HdPictureReader *reader, HdPictureValue *values, HdError *error) {
    const uint16_t *codes = reader->row;
    const HdStatus status = hd_png_read_rows(reader->png, reader->row, 1, error);
    for (size_t i = 0; i < (size_t)reader->facts.width * 3 && status == HD_OK; i++)
        values[i] = reader->by_code[codes[i]];
    return status;
}

static HdPictureValue value_of(const HdPictureReader *reader, float radiance) {
    const double linear = (double)radiance;
    return (HdPictureValue){
        .linear = linear,
        .display = HD_DISPLAY_TOP * hd_curve_to_display(reader->curve, linear),
    };
}

static HdStatus next_of_exr(HdPictureReader *reader, HdPictureValue *values, HdError *error) {
    const HdStatus status = hd_exr_next_row(reader->exr, error);
    for (int channel = 0; channel < 3 && status == HD_OK; channel++) {
        const float *radiances = hd_exr_channel(reader->exr, channel);
        for (int x = 0; x < reader->facts.width; x++)
            values[3 * x + channel] = value_of(reader, radiances[x]);
    }
    return status;
}

static HdStatus next_of_pfm(HdPictureReader *reader, HdPictureValue *values, HdError *error) {
    const float *radiances = reader->row;
    const HdStatus status = hd_pfm_next_row(&reader->pfm, reader->row, error);
    for (int i = 0; i < reader->facts.width * 3 && status == HD_OK; i++)
        values[i] = value_of(reader, radiances[i]);
    return status;
}

HdStatus hd_picture_reader_next(HdPictureReader *reader, HdPictureValue *values, HdError *error) {
    if (reader->png != NULL)
        return next_of_png(reader, values, error);
    return reader->exr != NULL ? next_of_exr(reader, values, error)
                               : next_of_pfm(reader, values, error);
}

const float *hd_picture_reader_further(const HdPictureReader *reader, int channel) {
    return hd_exr_channel(reader->exr, 3 + channel);
}

void hd_picture_reader_close(HdPictureReader *reader) {
    if (reader == NULL)
        return;
    hd_png_close(reader->png);
    hd_exr_close(reader->exr);
    if (reader->file != NULL)
        fclose(reader->file);
    free(reader->row);
    free(reader->by_code);
    free(reader);
}
