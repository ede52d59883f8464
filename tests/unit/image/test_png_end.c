/* SPDX-License-Identifier: MIT */
/* A picture with a fingerprint is recognised, and with one byte less, more or other it is not. */
#define _GNU_SOURCE /* memmem */

#include <zlib.h>

#include "picture_files.h"

enum { WIDTH = 23, HEIGHT = 17 };
static const uint64_t FINGERPRINT = UINT64_C(0x123456789abcdef0);
static const HdPictureLabel LABEL = {.scene = "a.json",
                                     .options = "--size 23x17",
                                     .frame = 7,
                                     .has_fingerprint = true,
                                     .fingerprint = UINT64_C(0x123456789abcdef0)};

static HdError error;
static unsigned char bytes[65536];
static size_t size;

static bool is_whole(void) {
    return hd_png_is_whole(bytes, size, FINGERPRINT);
}

/* Reads the file into `bytes`. */
static void write_picture(const HdPictureLabel *label) {
    const HdPictureStyle style = {HD_CURVE_SRGB, 8, false};
    HdFrame frame;
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++)
        frame.rgb[i] = (float)(i % 251) / 251.0f;
    write_frame(&frame, &hd_format_png, &style, label, "a.png");
    size = read_bytes("a.png", bytes, sizeof bytes - 1);
}

TEST(every_change_is_noticed) {
    write_picture(&LABEL);
    assert_true(is_whole());
    for (size_t i = 0; i < 8 * size; i += 1 + i % 7) {
        bytes[i / 8] ^= (unsigned char)(1 << i % 8);
        assert_false(is_whole());
        bytes[i / 8] ^= (unsigned char)(1 << i % 8);
    }
    for (int bit = 0; bit < 64; bit++)
        assert_false(hd_png_is_whole(bytes, size, FINGERPRINT ^ UINT64_C(1) << bit));
    const size_t all = size;
    bytes[size++] = '\n';
    assert_false(is_whole());
    for (size = 0; size < all; size++)
        assert_false(is_whole());
    assert_true(is_whole());
}

TEST(the_picture_is_the_same_with_and_without) {
    static const char text[] = "tEXthedron\0frame 123456789abcdef0 bytes ";
    HdTexture known, plain;
    write_picture(&LABEL);
    const unsigned char *end = bytes + size - HD_PNG_END_SIZE;
    assert_memory_equal(end + 4, text, sizeof text - 1);
    const uLong sum = crc32(0, end + 4, HD_PNG_END_SIZE - 20);
    for (int i = 0; i < 4; i++)
        assert_int_equal(end[HD_PNG_END_SIZE - 16 + i], (sum >> (24 - 8 * i)) & 0xff);
    const size_t whole_size = size;
    assert_int_equal(hd_texture_read(&known, "a.png", HD_CURVE_SRGB, &error), HD_OK);
    HdPictureLabel label = LABEL;
    assert_non_null(memmem(bytes, size, "iTXtOptions", 11));
    label.has_fingerprint = false;
    label.options = "";
    write_picture(&label);
    assert_false(is_whole());
    assert_null(memmem(bytes, size, "iTXtOptions", 11));
    const size_t options = 12 + sizeof "Options" + 4 + strlen(LABEL.options);
    assert_int_equal(size + HD_PNG_END_SIZE - 12 + options, whole_size);
    assert_int_equal(hd_texture_read(&plain, "a.png", HD_CURVE_SRGB, &error), HD_OK);
    assert_memory_equal(known.texels, plain.texels, WIDTH * HEIGHT * 6);
    hd_texture_clear(&known);
    hd_texture_clear(&plain);
}
