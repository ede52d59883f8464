/* SPDX-License-Identifier: MIT */
/* Reading an endless PNG file stops at the bytes that its pixels may need. */
#define _XOPEN_SOURCE 700

#include <stdio.h>
#include <stdlib.h>

#include <zlib.h>

#include "image/picture.h"
#include "unit_test.h"

enum { CHUNK = 1 << 20, MANY = 24 };

static HdError error;

static void put_number(FILE *file, unsigned long number) {
    for (int shift = 24; shift >= 0; shift -= 8)
        putc((int)(number >> shift & 0xff), file);
}

static void put_chunk(FILE *file, const char *type, const unsigned char *bytes, unsigned size) {
    unsigned long sum = crc32(crc32(0, NULL, 0), (const unsigned char *)type, 4);
    put_number(file, size);
    fwrite(type, 1, 4, file);
    fwrite(bytes, 1, size, file);
    put_number(file, size > 0 ? crc32(sum, bytes, size) : sum);
}

/* Makes a white pixel, and so many chunks of a MiB after it or, by `before`, before it. */
static FILE *make_file(int surplus, bool before) {
    static const unsigned char head[13] = {0, 0, 0, 1, 0, 0, 0, 1, 8, 2, 0, 0, 0};
    static const unsigned char row[4] = {0, 255, 255, 255};
    unsigned char packed[64], *zeros = calloc(CHUNK, 1);
    unsigned long size = sizeof packed;
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_non_null(zeros);
    assert_int_equal(compress(packed, &size, row, sizeof row), Z_OK);
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, file);
    put_chunk(file, "IHDR", head, sizeof head);
    for (int i = 0; i < surplus && before; i++)
        put_chunk(file, "teSt", zeros, CHUNK);
    put_chunk(file, "IDAT", packed, (unsigned)size);
    for (int i = 0; i < surplus && !before; i++)
        put_chunk(file, "IDAT", zeros, CHUNK);
    put_chunk(file, "IEND", NULL, 0);
    rewind(file);
    free(zeros);
    return file;
}

static HdStatus read_pixel(FILE *file, float rgb[3]) {
    void *rows;
    HdPictureFacts facts;
    HdStatus status = hd_format_png.open_rows(&rows, file, "a.png", &facts, &error);
    if (status != HD_OK)
        return status;
    status = hd_format_png.next_row(rows, rgb, &error);
    hd_format_png.close_rows(rows);
    return status;
}

/* Some MiB besides the pixels are accepted, but a file without end is not read to it. */
TEST(surplus_bytes_have_a_limit) {
    float rgb[3] = {0};
    for (int i = 0; i < 3; i++) {
        FILE *file = make_file(i == 0 ? 8 : MANY, i < 2);
        assert_int_equal(read_pixel(file, rgb), i == 0 ? HD_OK : HD_BAD_INPUT);
        assert_true(i > 0 || rgb[0] == 65535.0F);
        if (i > 0)
            assert_string_equal(
                error.message,
                "cannot read a.png as PNG: the file has far more bytes than its pixels need");
        assert_true(ftell(file) < 18L * CHUNK);
        fclose(file);
    }
}
