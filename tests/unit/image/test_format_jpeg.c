/* SPDX-License-Identifier: MIT */
/* Errors of JPEG files; test_picture.c reads each kind of JPEG. */
#define _XOPEN_SOURCE 700

#include <stdio.h>

#include <jpeglib.h>

#include "picture_files.h"

enum { SIDE = 24 };

static HdError error;
static unsigned char bytes[65536];

/* Checks a copy of its own size, so that the sanitizer detects a read past the end. */
static void check_refused(const unsigned char *file, size_t size, const char *part) {
    HdTexture texture;
    unsigned char *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, file, size);
    assert_int_equal(hd_texture_decode(&texture, copy, size, "a.jpg", HD_CURVE_SRGB, &error),
                     HD_BAD_INPUT);
    assert_null(texture.texels);
    expect_contains(error.message, "a.jpg");
    expect_contains(error.message, part);
    free(copy);
}

TEST(texels_come_off_the_curve) {
    HdTexture linear, srgb;
    const size_t size = load_texture_file("jpeg_444", bytes, sizeof bytes);
    assert_int_equal(hd_texture_decode(&linear, bytes, size, "a", HD_CURVE_LINEAR, &error), HD_OK);
    assert_int_equal(hd_texture_decode(&srgb, bytes, size, "a", HD_CURVE_SRGB, &error), HD_OK);
    const size_t count = (size_t)linear.width * (size_t)linear.height * 3;
    hd_curve_decode16(HD_CURVE_SRGB, linear.texels, count);
    assert_memory_equal(srgb.texels, linear.texels, count * sizeof *srgb.texels);
    hd_texture_clear(&linear);
    hd_texture_clear(&srgb);
}

/* With and without an end marker: the first rows are as in the whole file, the last ones grey. */
TEST(cut_files_are_read_up_to_the_cut) {
    HdTexture whole, cut;
    const size_t size = load_texture_file("jpeg_444", bytes, sizeof bytes);
    assert_int_equal(hd_texture_decode(&whole, bytes, size, "a", HD_CURVE_LINEAR, &error), HD_OK);
    const size_t row = (size_t)whole.width * 3, count = row * (size_t)whole.height;
    for (size_t kept = 3; kept < 200; kept++)
        check_refused(bytes, kept, "");
    for (int i = 0; i < 2; i++) {
        memcpy(bytes + size - 400, "\xff\xd9", i == 0 ? 0 : 2);
        assert_int_equal(hd_texture_decode(&cut, bytes, size - 398, "a", HD_CURVE_LINEAR, &error),
                         HD_OK);
        assert_true(cut.is_cut_short && !whole.is_cut_short);
        assert_memory_equal(cut.texels, whole.texels, 8 * row * sizeof *cut.texels);
        assert_int_equal(cut.texels[count - 1], 128 * 257);
        hd_texture_clear(&cut);
    }
    hd_texture_clear(&whole);
}

TEST(malicious_files_are_refused) {
    const size_t size = load_texture_file("jpeg_444", bytes, sizeof bytes);
    unsigned char *frame = bytes; /* its head, then its length, bits, height and width */
    while (frame[0] != 0xff || frame[1] != 0xc0)
        frame++;
    frame[4] = 12;
    check_refused(bytes, size, "Unsupported JPEG data precision 12");
    frame[4] = 8;
    memset(frame + 5, 0xff, 4);
    check_refused(bytes, size, "Maximum supported image dimension is 65500 pixels");
    memset(frame + 5, 0xf0, 4);
    check_refused(bytes, size, "61680 x 61680 pixels, expected at most 268435456 in all");
    memset(frame + 5, 0x30, 4);
    check_refused(bytes, size, "premature end of data segment"); /* too few bytes for the size */
    memset(frame + 5, 0, 4);
    check_refused(bytes, size, "Empty JPEG image");
}

/* Writes a picture of SIDE x SIDE pixels into `bytes`; returns its size. A grey one has two scans,
   each with all bits of its coefficients. */
static unsigned long encode(J_COLOR_SPACE space, int channels) {
    static const jpeg_scan_info whole_bits[] = {{1, {0}, 0, 0, 0, 0}, {1, {0}, 1, 63, 0, 0}};
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    unsigned char *encoded = bytes;
    unsigned long size = sizeof bytes;
    JSAMPLE row[SIDE * 4];
    JSAMPROW rows[1] = {row};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &encoded, &size);
    jpeg.image_width = jpeg.image_height = SIDE;
    jpeg.input_components = channels;
    jpeg.in_color_space = space;
    jpeg_set_defaults(&jpeg);
    jpeg.scan_info = channels == 1 ? whole_bits : NULL;
    jpeg.num_scans = channels == 1 ? 2 : 0;
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < SIDE; y++) {
        for (int i = 0; i < SIDE * channels; i++)
            row[i] = (JSAMPLE)(i * 7 + y * y * 3);
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    assert_ptr_equal(encoded, bytes);
    return size;
}

TEST(print_colours_are_refused) {
    const unsigned long size = encode(JCS_CMYK, 4);
    check_refused(bytes, size,
                  "is a JPEG of 4 colours (4 are those of print, CMYK), expected 1 or 3");
}

/* Repeats the last scan of a progressive file: each costs the time of the whole picture. Scans
   without new bits are errors without a limit. */
TEST(endless_scans_are_refused) {
    size_t size = encode(JCS_GRAYSCALE, 1) - 2, last = size;
    while (bytes[last] != 0xff || bytes[last + 1] != 0xda)
        last--;
    const size_t length = size - last;
    assert_true(size + 100 * length + 2 <= sizeof bytes);
    for (int i = 0; i < 100; i++, size += length)
        memcpy(bytes + size, bytes + last, length);
    memcpy(bytes + size, "\xff\xd9", 2);
    check_refused(bytes, size + 2, "more than 64 scans");
}
