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

#include "image/picture_formats.h"
#include "image/row_formats.h"

enum { CODES = 65536 };

struct HdPictureReader {
    FILE *file;
    const char *path; /* the caller's */
    HdPictureFacts facts;
    HdCurve curve;
    HdPngRows *png; /* one of these two */
    HdPfmRows *pfm;
    uint16_t *codes;         /* owned; a row of PNG */
    float *radiances;        /* owned; a row of PFM */
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

static HdStatus open_format(HdPictureReader *reader, HdError *error) {
    unsigned char head[8];
    size_t count = fread(head, 1, sizeof head, reader->file);
    rewind(reader->file);
    if (hd_image_is_png(head, count))
        return hd_png_rows_open(&reader->png, reader->file, reader->path, &reader->facts, error);
    if (count >= 2 && memcmp(head, "PF", 2) == 0)
        return hd_pfm_rows_open(&reader->pfm, reader->file, reader->path, &reader->facts, error);
    if (count >= 2 && memcmp(head, "Pf", 2) == 0)
        return hd_fail(error, HD_BAD_INPUT, "%s is a PFM without colour, expected one with r, g, b",
                       reader->path);
    return hd_fail(error, HD_BAD_INPUT, "%s is neither PNG nor PFM, expected one of these",
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
    const size_t count = (size_t)reader->facts.width * 3;
    reader->curve = curve;
    if (reader->facts.format == HD_PICTURE_PNG) {
        reader->codes = malloc(count * sizeof *reader->codes);
        reader->by_code = malloc(CODES * sizeof *reader->by_code);
    } else {
        reader->radiances = malloc(count * sizeof *reader->radiances);
    }
    bool has_room = reader->radiances != NULL || (reader->codes != NULL && reader->by_code != NULL);
    if (!has_room)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", reader->path);
    if (reader->facts.format == HD_PICTURE_PNG)
        fill_codes(reader);
    return HD_OK;
}

HdStatus hd_picture_reader_next(HdPictureReader *reader, HdPictureValue *values, HdError *error) {
    const size_t count = (size_t)reader->facts.width * 3;
    HdStatus status = reader->facts.format == HD_PICTURE_PNG
                          ? hd_png_rows_next(reader->png, reader->codes, error)
                          : hd_pfm_rows_next(reader->pfm, reader->radiances, error);
    for (size_t i = 0; i < count && status == HD_OK; i++) {
        if (reader->facts.format == HD_PICTURE_PNG) {
            values[i] = reader->by_code[reader->codes[i]];
        } else {
            const double linear = (double)reader->radiances[i];
            values[i].linear = linear;
            values[i].display = HD_DISPLAY_TOP * hd_curve_to_display(reader->curve, linear);
        }
    }
    return status;
}

void hd_picture_reader_close(HdPictureReader *reader) {
    if (reader == NULL)
        return;
    hd_png_rows_close(reader->png);
    hd_pfm_rows_close(reader->pfm);
    if (reader->file != NULL)
        fclose(reader->file);
    free(reader->codes);
    free(reader->radiances);
    free(reader->by_code);
    free(reader);
}
