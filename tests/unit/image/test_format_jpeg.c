/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include <stdio.h>
#include <stdlib.h>

#include <jpeglib.h>

#include "image/picture.h"
#include "unit_test.h"

enum { SIDE = 24 };

typedef struct Bytes {
    unsigned char *at; /* owned */
    unsigned long size;
} Bytes;

/* Scans of a grey picture that have all bits of their coefficients. */
static const jpeg_scan_info whole_bits[] = {{1, {0}, 0, 0, 0, 0}, {1, {0}, 1, 63, 0, 0}};

/* A picture of SIDE x SIDE pixels, whose pixel (x, y) has `channels` values made of a few primes;
   `flat`: all of them 10, 100, 200, 50. */
static Bytes encode(J_COLOR_SPACE space, int channels, bool flat, bool progressive) {
    static const JSAMPLE values[4] = {10, 100, 200, 50};
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    Bytes bytes = {NULL, 0};
    JSAMPLE row[SIDE * 4];
    JSAMPROW rows[1] = {row};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes.at, &bytes.size);
    jpeg.image_width = jpeg.image_height = SIDE;
    jpeg.input_components = channels;
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    if (progressive && channels == 1) {
        jpeg.scan_info = whole_bits;
        jpeg.num_scans = 2;
    } else if (progressive)
        jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < SIDE; y++) {
        for (int i = 0; i < SIDE * channels; i++)
            row[i] = flat ? values[i % channels] : (JSAMPLE)(i * 7 + y * y * 3);
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    return bytes;
}

/* A copy of its own size lets the sanitizer see a read past the end. */
static HdStatus decode(HdTexture *texture, const unsigned char *bytes, size_t size, HdCurve curve,
                       HdError *error) {
    unsigned char *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    const HdStatus status = hd_texture_decode(texture, copy, size, "a.jpg", curve, error);
    assert_true((status == HD_OK) == (texture->texels != NULL));
    free(copy);
    return status;
}

static void expect_flat(Bytes bytes, HdCurve curve, int red, int green, int blue) {
    const int codes[3] = {red, green, blue};
    HdError error = {0};
    HdTexture texture;
    assert_int_equal(decode(&texture, bytes.at, bytes.size, curve, &error), HD_OK);
    assert_int_equal(texture.width, SIDE);
    assert_int_equal(texture.height, SIDE);
    for (int i = 0; i < SIDE * SIDE * 3; i++) {
        const double texel = hd_curve_to_display(curve, texture.texels[i] / 65535.0);
        expect_near(texel * 255.0, codes[i % 3], 1.0);
    }
    hd_texture_clear(&texture);
    free(bytes.at);
}

TEST(grey_and_colours_are_read) {
    expect_flat(encode(JCS_GRAYSCALE, 1, true, false), HD_CURVE_LINEAR, 10, 10, 10);
    expect_flat(encode(JCS_RGB, 3, true, false), HD_CURVE_LINEAR, 10, 100, 200);
    expect_flat(encode(JCS_RGB, 3, true, true), HD_CURVE_SRGB, 10, 100, 200);
}

static void check_refused(const unsigned char *bytes, size_t size, const char *part) {
    HdError error = {0};
    HdTexture texture;
    assert_int_equal(decode(&texture, bytes, size, HD_CURVE_LINEAR, &error), HD_BAD_INPUT);
    expect_contains(error.message, "a.jpg");
    expect_contains(error.message, part);
}

TEST(print_colours_are_refused) {
    Bytes bytes = encode(JCS_CMYK, 4, true, false);
    check_refused(bytes.at, bytes.size,
                  "is a JPEG of 4 colours (4 are those of print, CMYK), "
                  "expected 1 or 3");
    free(bytes.at);
}

TEST(cut_files_are_refused) {
    for (int progressive = 0; progressive < 2; progressive++) {
        HdError error = {0};
        HdTexture texture;
        Bytes bytes = encode(JCS_RGB, 3, false, progressive);
        for (size_t size = 3; size < bytes.size; size++)
            assert_int_equal(decode(&texture, bytes.at, size, HD_CURVE_LINEAR, &error),
                             HD_BAD_INPUT);
        check_refused(bytes.at, bytes.size / 2, "cannot read a.jpg as JPEG: Premature end of JPEG");
        /* The end is there, but pixels are not. */
        memcpy(bytes.at + bytes.size / 2, "\xff\xd9", 2);
        check_refused(bytes.at, bytes.size / 2 + 2, "premature end of data segment");
        free(bytes.at);
    }
}

/* The place of the frame's head: its length, bits, height and width follow. */
static unsigned char *find_frame(Bytes bytes) {
    for (size_t i = 0; i + 1 < bytes.size; i++)
        if (bytes.at[i] == 0xff && (bytes.at[i + 1] == 0xc0 || bytes.at[i + 1] == 0xc2))
            return bytes.at + i;
    fail_msg("%s", "no frame in the file");
    return NULL;
}

TEST(hostile_files_are_refused) {
    Bytes bytes = encode(JCS_RGB, 3, false, false);
    unsigned char *frame = find_frame(bytes);
    frame[4] = 12;
    check_refused(bytes.at, bytes.size, "Unsupported JPEG data precision 12");
    frame[4] = 8;
    memset(frame + 5, 0xff, 4);
    check_refused(bytes.at, bytes.size, "Maximum supported image dimension is 65500 pixels");
    memset(frame + 5, 0xf0, 4);
    check_refused(bytes.at, bytes.size, "61680 x 61680 pixels, expected at most 268435456 in all");
    memset(frame + 5, 0x30, 4);
    check_refused(bytes.at, bytes.size, "premature end of data segment");
    memset(frame + 5, 0, 4);
    check_refused(bytes.at, bytes.size, "Empty JPEG image");
    free(bytes.at);
}

/* The last scan of a progressive file over and over: each costs the time of the whole picture.
   Those that bring no bits of their own are errors without a limit. */
TEST(endless_scans_are_refused) {
    Bytes bytes = encode(JCS_GRAYSCALE, 1, false, true);
    size_t last = bytes.size;
    while (bytes.at[last - 1] != 0xff || bytes.at[last] != 0xda)
        last--;
    last--;
    const size_t length = bytes.size - 2 - last;
    unsigned char *many = malloc(last + 100 * length + 2);
    assert_non_null(many);
    memcpy(many, bytes.at, last);
    for (size_t i = 0; i < 100; i++)
        memcpy(many + last + i * length, bytes.at + last, length);
    memcpy(many + last + 100 * length, "\xff\xd9", 2);
    check_refused(many, last + 100 * length + 2, "more than 64 scans");
    free(many);
    free(bytes.at);
}
