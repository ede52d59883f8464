/* SPDX-License-Identifier: MIT */
#include "image/row_formats.h"

#include <setjmp.h>
#include <stdbool.h>
#include <stdlib.h>

#include "image/png.h"

/* Everything that must outlive a jump out of libpng lives here. */
struct HdPngRows {
    png_structp png;
    png_infop info;
    FILE *file;
    const char *path;
    int width, height, bits, next;
    bool is_interlaced;
    char message[HD_PNG_MESSAGE_SIZE];
};

static void read_bytes(png_structp png, png_bytep out, size_t count) {
    if (fread(out, 1, count, png_get_io_ptr(png)) != count)
        png_error(png, "the file ends too early");
}

/* Runs under setjmp. */
static void read_head(HdPngRows *rows, HdPictureFacts *facts) {
    png_structp png = rows->png;
    png_set_read_fn(png, rows->file, read_bytes);
    hd_png_limit_reading(png);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, (png_const_bytep) "sRGB", 1);
    png_read_info(png, rows->info);
    rows->is_interlaced = png_get_interlace_type(png, rows->info) != PNG_INTERLACE_NONE;
    hd_png_convert_to_rgb(png);
    png_read_update_info(png, rows->info);
    rows->width = (int)png_get_image_width(png, rows->info);
    rows->height = (int)png_get_image_height(png, rows->info);
    rows->bits = png_get_bit_depth(png, rows->info);
    if (png_get_rowbytes(png, rows->info) * 8 != (size_t)rows->width * 3 * (size_t)rows->bits)
        png_error(png, "unexpected size of a row");
    bool is_srgb = png_get_valid(png, rows->info, PNG_INFO_sRGB) != 0;
    *facts = (HdPictureFacts){
        .format = HD_PICTURE_PNG,
        .width = rows->width,
        .height = rows->height,
        .bits = rows->bits,
        .curve = is_srgb ? HD_CURVE_SRGB : HD_CURVE_LINEAR,
    };
}

static bool try_head(HdPngRows *rows, HdPictureFacts *facts) {
    if (setjmp(png_jmpbuf(rows->png)) != 0)
        return false;
    read_head(rows, facts);
    return true;
}

HdStatus hd_png_rows_open(HdPngRows **out, FILE *file, const char *path, HdPictureFacts *facts,
                          HdError *error) {
    HdPngRows *rows = calloc(1, sizeof *rows);
    if (rows == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to read %s", path);
    *rows = (HdPngRows){.file = file, .path = path, .message = "out of memory"};
    rows->png = hd_png_create_reader(rows->message);
    if (rows->png != NULL)
        rows->info = png_create_info_struct(rows->png);
    HdStatus status = HD_OK;
    if (rows->info == NULL || !try_head(rows, facts))
        status = hd_fail(error, hd_png_reading_status(rows->message), "cannot read %s as PNG: %s",
                         path, rows->message);
    else if (rows->is_interlaced)
        status =
            hd_fail(error, HD_BAD_INPUT,
                    "%s is an interlaced PNG, expected one whose rows follow each other", path);
    if (status != HD_OK)
        hd_png_rows_close(rows);
    else
        *out = rows;
    return status;
}

/* The last row is followed by the end of the file, which has to be there. */
static bool try_row(HdPngRows *rows, unsigned char *bytes) {
    if (setjmp(png_jmpbuf(rows->png)) != 0)
        return false;
    png_read_row(rows->png, bytes, NULL);
    if (++rows->next == rows->height)
        png_read_end(rows->png, NULL);
    return true;
}

/* The bytes lie in the row that they become: PNG's 16 bits are big endian, and 8 bits fill the
   first half, so that the way goes from the end. */
static void make_codes(const HdPngRows *rows, uint16_t *codes) {
    const unsigned char *bytes = (const unsigned char *)codes;
    for (size_t i = (size_t)rows->width * 3; i-- > 0;)
        codes[i] =
            (uint16_t)(rows->bits == 16 ? bytes[2 * i] << 8 | bytes[2 * i + 1] : bytes[i] * 257);
}

HdStatus hd_png_rows_next(HdPngRows *rows, uint16_t *codes, HdError *error) {
    if (!try_row(rows, (unsigned char *)codes))
        return hd_fail(error, hd_png_reading_status(rows->message), "cannot read %s as PNG: %s",
                       rows->path, rows->message);
    make_codes(rows, codes);
    return HD_OK;
}

void hd_png_rows_close(HdPngRows *rows) {
    if (rows == NULL)
        return;
    png_destroy_read_struct(&rows->png, &rows->info, NULL);
    free(rows);
}
