/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE

#include <signal.h>
#include <sys/resource.h>

#include <zlib.h>

#include "base/hash.h"
#include "picture_files.h"

static const HdPictureStyle LINEAR_8 = {HD_CURVE_LINEAR, 8, false};
static HdError error;
static unsigned char bytes[65536];

/* Returns numbers so random that no compression makes them small. */
static uint32_t next_random(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 16;
}

/* Values of whole bytes. */
static HdFrame make_frame(int width, int height) {
    HdFrame frame;
    uint32_t seed = 1;
    assert_int_equal(hd_frame_create(&frame, width, height, &error), HD_OK);
    for (size_t i = 0; i < (size_t)width * (size_t)height * 3; i++)
        frame.rgb[i] = (float)(next_random(&seed) & 255) / 255.0f;
    return frame;
}

TEST(sizes_are_checked) {
    const int sizes[][2] = {{65535, 1}, {0, 1}, {1, 0}, {-1, 1}, {65536, 1}, {1, 65536}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        HdFrame frame = {.width = sizes[i][0], .height = sizes[i][1]};
        assert_int_equal(hd_frame_add_rgba(&frame, &error), i == 0 ? HD_OK : HD_BAD_INPUT);
        if (i > 0)
            expect_contains(error.message, "1..65535");
        assert_int_equal(frame.rgba != NULL, i == 0);
        hd_frame_free(&frame);
        assert_null(frame.rgba);
    }
}

/* Decoded, the values are those of the frame except for rounding. The classic mode's names need no
   extension. */
TEST(textures_come_off_the_curve) {
    static const struct {
        const char *path;
        HdPictureStyle style;
        double tolerance;
    } files[] = {{"off.PNG", {HD_CURVE_SRGB, 16, false}, 5e-5},
                 {"off.png", {HD_CURVE_SRGB, 8, false}, 5e-3},
                 {"off/a/b.data", {HD_CURVE_SRGB, 8, false}, 5e-3},
                 {"png", {HD_CURVE_LINEAR, 8, false}, 1e-7}};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        HdTexture texture;
        HdFrame frame = make_frame(259, 7);
        for (int i = 0; i < 259 * 7 * 3 && files[f].style.curve == HD_CURVE_SRGB; i++)
            frame.rgb[i] = (float)i / (float)(259 * 7 * 3 - 1); /* between the steps of 8 bits */
        assert_int_equal(hd_picture_write(&frame, &files[f].style, files[f].path, &error), HD_OK);
        assert_int_equal(hd_texture_read(&texture, files[f].path, files[f].style.curve, &error),
                         HD_OK);
        assert_int_equal(texture.width, 259);
        assert_int_equal(texture.height, 7);
        for (int i = 0; i < 259 * 7 * 3; i++)
            expect_near(texture.texels[i] / 65535.0, (double)frame.rgb[i], files[f].tolerance);
        hd_texture_clear(&texture);
        hd_frame_free(&frame);
    }
    assert_int_equal(read_bytes("png", bytes, sizeof bytes), 8 + 259 * 7 * 4);
    assert_memory_equal(bytes, "\3\1\0\0\7\0\0\0", 8);
    assert_int_equal(bytes[11], 255);
}

/* The colours are those of the objects alone, with the background taken away. */
TEST(png_has_alpha_if_the_style_asks_for_it) {
    static const float seen[] = {0.5f, 0.25f, 1.0f, 0.0f, 0.125f, 0.5f, 0.25f, 0.25f, 0.25f},
                       alphas[] = {1.0f, 0.0f, 0.25f};
    static const unsigned char png8[] = {128, 64, 255, 255, 0, 0, 0, 0, 255, 159, 0, 64},
                               png16[] = {0xff, 0xff, 0x9f, 0xff, 0, 0, 0x40, 0};
    const HdPictureLabel label = {
        .scene = "", .options = "", .background = hd_vec3(0.0, 0.125, 0.5)};
    for (int k = 0; k < 3; k++) {
        HdPictureStyle style = {HD_CURVE_LINEAR, k == 1 ? 16 : 8, k < 2};
        unsigned char raw[64];
        unsigned long size = sizeof raw;
        HdFrame frame;
        assert_int_equal(hd_frame_create(&frame, 3, 1, &error), HD_OK);
        assert_int_equal(hd_frame_add_layers(&frame, HD_LAYER_BIT(HD_LAYER_ALPHA), &error), HD_OK);
        memcpy(frame.rgb, seen, sizeof seen);
        memcpy(frame.first, alphas, sizeof alphas);
        write_frame(&frame, &hd_format_png, &style, &label, "alpha.png");
        const size_t count = read_bytes("alpha.png", bytes, sizeof bytes);
        unsigned char *data = memmem(bytes, count, "IDAT", 4);
        assert_int_equal(bytes[25], k < 2 ? 6 : 2);
        assert_int_equal(uncompress(raw, &size, data + 4, (unsigned long)(bytes + count - data)),
                         Z_OK);
        assert_int_equal(size, k == 0 ? 13 : k == 1 ? 25 : 10);
        const int step = k == 1 ? 8 : 4;
        for (int i = 1 + step; i < (int)size && k < 2; i++) /* each byte less that to the left */
            raw[i] = (unsigned char)(raw[i] + raw[i - step]);
        if (k == 0)
            assert_memory_equal(raw + 1, png8, sizeof png8);
        if (k == 1)
            assert_memory_equal(raw + 1 + 16, png16, sizeof png16);
    }
}

/* A limit on the size of files simulates a full disk: large pictures fail while they are written,
   small ones when the file is closed. */
TEST(full_disks_leave_older_files) {
    static const char *const paths[] = {"full/a.data", "full/a.png", "full/a.pfm"};
    struct rlimit old, small;
    assert_int_equal(mkdir("full", 0777), 0);
    void (*old_action)(int) = signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
    for (int i = 0; i < 6; i++) {
        const char *path = paths[i / 2];
        const int side = i % 2 == 0 ? 2 : 300;
        HdFrame frame = make_frame(side, side);
        write_bytes(path, "older", 5);
        small = old;
        small.rlim_cur = i % 2 == 0 ? 4 : 10000;
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
        const HdStatus status = hd_picture_write(&frame, &LINEAR_8, path, &error);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
        assert_int_equal(status, HD_FAILED);
        expect_contains(error.message, path);
        expect_contains(error.message, "File too large");
        assert_int_equal(read_bytes(path, bytes, sizeof bytes), 5);
        assert_memory_equal(bytes, "older", 5);
        hd_frame_free(&frame);
    }
    signal(SIGXFSZ, old_action);
    assert_int_equal(count_entries("full"), 3);
}

TEST(targets_that_are_no_files_are_refused) {
    static const struct {
        const char *path;
        HdStatus status;
        const char *part;
    } targets[] = {{"targets/folder.png", HD_BAD_INPUT, "not a regular file"},
                   {"targets/pipe.png", HD_BAD_INPUT, "not a regular file"},
                   {"targets/", HD_BAD_INPUT, "expected the name of a file"},
                   {"", HD_BAD_INPUT, "expected the name of a file"},
                   {"targets/file/a.png", HD_FAILED, "a file has that name"},
                   {"targets/film.mp4", HD_BAD_INPUT, "its ending is that of a film"}};
    struct stat found;
    mkdir("targets", 0777);
    mkdir("targets/folder.png", 0777);
    write_bytes("targets/file", "", 0);
    assert_int_equal(mkfifo("targets/pipe.png", 0666), 0);
    HdFrame frame = make_frame(3, 2);
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
        assert_int_equal(hd_picture_write(&frame, &LINEAR_8, targets[i].path, &error),
                         targets[i].status);
        expect_contains(error.message, targets[i].part);
        expect_contains(error.message, targets[i].path);
    }
    hd_frame_free(&frame);
    assert_int_equal(stat("targets/pipe.png", &found), 0);
    assert_true(S_ISFIFO(found.st_mode));
    assert_int_equal(count_entries("targets"), 3);
}

static void check_refused(const void *file, size_t size, const char *part) {
    HdTexture texture = {.width = 1, .height = 1};
    assert_int_equal(hd_texture_decode(&texture, file, size, "a name", HD_CURVE_LINEAR, &error),
                     HD_BAD_INPUT);
    assert_int_equal(texture.width, 0);
    assert_null(texture.texels);
    expect_contains(error.message, "a name");
    expect_contains(error.message, part);
}

TEST(wrong_data_is_refused) {
    static const struct {
        const char *bytes;
        size_t size;
        const char *part;
    } cases[] = {
        {"\0\0\0\0\1\0\0\0\0\0\0\0", 12, "say 0 x 1"},
        {"\1\0\0\0\xff\xff\xff\xff\0\0\0\0", 12, "say 1 x -1"},
        {"\0\0\0\x80\1\0\0\0\0\0\0\0", 12, "say -2147483648 x 1"},
        {"\0\0\1\0\1\0\0\0\0\0\0\0", 12, "65536 x 1 pixels, expected 1..65535"},
        {"\1\0\0\0\0\0\1\0\0\0\0\0", 12, "1 x 65536 pixels, expected 1..65535"},
        {"\2\0\0\0\1\0\0\0\0\0\0\0", 12, "has 12 bytes, expected 16 for 2 x 1"},
        {"\xff\xff\0\0\xff\xff\0\0\0\0\0\0", 12, "expected 17179344908"},
        {"\1\0\0\0\1\0\0\0\0\0\0\0", 11, "has 11 bytes, expected 12"},
        {"\1\0\0\0\1\0\0\0\0\0\0\0\0", 13, "has 13 bytes, expected 12"},
        {"\1\0\0\0\1\0\0", 7, "has 7 bytes"},
        {"", 0, " is an empty file, expected PNG, JPEG or the data format"},
        {"# A picture as text", 19, "neither PNG, JPEG nor the data format"},
        {"GIF89a\1\0\1\0", 10, " is a GIF picture, expected PNG, JPEG or the data format"},
        {"RIFF\x24\0\0\0WEBPVP8 ", 16, "is a WebP picture"},
        {"BM\x46\0\0\0\0\0\0\0", 10, "is a BMP picture"},
        {"MM\0*\0\0\0\x08", 8, "is a TIFF picture"},
        {"\0\0\0 ftypavif\0\0\0\0", 16, "is an AVIF picture"},
        {" \n<!DOCTYPE html><html>", 23, "is a web page (HTML)"},
        {"\xef\xbb\xbf<?xml?><svg/>", 16, "is an SVG or XML file"},
        {"version https://git-lfs.github.com/spec/v1\n", 43, "is a pointer of Git LFS"},
        {"\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x28\1\2\3\4", 22, "is a TGA picture"},
        {"\0\1\x09\0\0\0\1\x18\0\0\0\0\4\0\4\0\x08\0", 18, "is a TGA picture"},
        {"\0\0\7\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x28", 18, "neither PNG, JPEG"},
        {"\xff\0\0\xff\xff TRUEVISION-XFILE.", 24, "is a TGA picture"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        check_refused(cases[i].bytes, cases[i].size, cases[i].part);
}

TEST(the_largest_side_is_read) {
    static unsigned char largest[8 + 65535 * 4] = {1, 0, 0, 0, 0xff, 0xff};
    HdTexture texture;
    assert_int_equal(
        hd_texture_decode(&texture, largest, sizeof largest, "x", HD_CURVE_LINEAR, &error), HD_OK);
    assert_int_equal(texture.height, 65535);
    hd_texture_clear(&texture);
    HdTexture kept = {.width = 1, .height = 1};
    write_bytes("sparse", "", 0);
    assert_int_equal(truncate("sparse", (off_t)5 << 30), 0);
    assert_int_equal(hd_texture_read(&kept, "sparse", HD_CURVE_LINEAR, &error), HD_BAD_INPUT);
    assert_int_equal(kept.width, 0);
    expect_contains(error.message, "sparse: it has 5368709120 bytes, expected at most 4294967296");
}

static void expect_hash(HdTexture *texture, const char *name, uint64_t expected) {
    const size_t texels = (size_t)texture->width * (size_t)texture->height;
    const uint64_t hash = hd_hash_numbers(HD_HASH_START, texture->texels, texels * 6, 2);
    if (hash != expected)
        fail_msg("%s has the hash 0x%016llx", name, (unsigned long long)hash);
    hd_texture_clear(texture);
}

/* The hashes are of other programs' output, each channel as 16 bits, the lower ones first. For PNG
   (named by colour type, bits and whether it is interlaced) that is a reader in another language,
   for JPEG Pillow, with the libjpeg-turbo that it brings. */
TEST(every_kind_is_read) {
    static const struct {
        const char *name;
        uint64_t hash;
    } files[] = {{"chunks", UINT64_C(0x1ed79d2c8c9ab105)},
                 {"png0_16_0", UINT64_C(0x43e21740e45edb1a)},
                 {"png0_16_1", UINT64_C(0x4585c31ca8bae06d)},
                 {"png0_1_0", UINT64_C(0x4ab378e27f3fd4a7)},
                 {"png0_2_0_trns", UINT64_C(0x46ce2e8ca27fe3f5)},
                 {"png0_4_0", UINT64_C(0x97153ff82385cb5b)},
                 {"png0_8_0", UINT64_C(0x57075d5c65b586a3)},
                 {"png2_16_0", UINT64_C(0xe4b46c20893c582d)},
                 {"png2_8_0", UINT64_C(0xb3d27eb378cfc601)},
                 {"png2_8_1", UINT64_C(0x7e5922802850c5d7)},
                 {"png3_1_0", UINT64_C(0x010180d6043f29ff)},
                 {"png3_4_1_trns", UINT64_C(0x5c2ebba59f3f2d8f)},
                 {"png4_16_0", UINT64_C(0xe3ebe3a68294a475)},
                 {"png4_8_0", UINT64_C(0x29bb161351c1aee5)},
                 {"png6_16_0", UINT64_C(0xf7253c2da4805769)},
                 {"png6_16_1", UINT64_C(0x67bee7119d7306c1)},
                 {"png6_8_0", UINT64_C(0x161225391189926b)},
                 {"jpeg_grey", UINT64_C(0x5dbe58cec83d2d6f)},
                 {"jpeg_444", UINT64_C(0x7a826930a8f8e845)},
                 {"jpeg_422", UINT64_C(0x95f48d9ed2fac121)},
                 {"jpeg_420", UINT64_C(0x39b7b84c61525e9d)},
                 {"jpeg_440", UINT64_C(0xcd326e9636f98b4b)},
                 {"jpeg_progressive", UINT64_C(0xb0b1b8aa8d615227)}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        HdTexture texture;
        const size_t size = load_texture_file(files[i].name, bytes, sizeof bytes);
        if (hd_texture_decode(&texture, bytes, size, "x", HD_CURVE_LINEAR, &error) != HD_OK)
            fail_msg("%s: %s", files[i].name, error.message);
        expect_hash(&texture, files[i].name, files[i].hash);
    }
}

/* The hashes are of Pillow's alpha, and of the mean of its channels. */
TEST(masks_are_alpha_or_grey) {
    static const struct {
        const char *name;
        uint64_t hash;
    } files[] = {{"png6_8_0", UINT64_C(0xf8a437ac0d5e91bf)},
                 {"png3_4_1_trns", UINT64_C(0x3a47d5cdb43d84ed)},
                 {"png2_8_0", UINT64_C(0xde8d8b0e5087cb3e)}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        HdTexture mask;
        const size_t size = load_texture_file(files[i].name, bytes, sizeof bytes);
        write_bytes("mask", bytes, size);
        assert_int_equal(hd_mask_read(&mask, "mask", &error), HD_OK);
        expect_hash(&mask, files[i].name, files[i].hash);
    }
}

TEST(messages_of_libpng_are_passed_on) {
    const size_t size = load_texture_file("png2_8_0", bytes, sizeof bytes);
    check_refused(bytes, size - 20, "the file ends too early");
    check_refused(bytes, 20, "IHDR");
    bytes[29] ^= 1;
    check_refused(bytes, size, "IHDR: CRC error");
    bytes[17] = 1; /* width 65536 + 5 */
    check_refused(bytes, size, "65541 x 6 pixels, expected 1..65535");
    bytes[17] = 0;
    bytes[23] = 0;
    check_refused(bytes, size, "5 x 0 pixels, expected 1..65535");
    bytes[20] = 0xff;
    check_refused(bytes, size, "5 x 4278190080 pixels");
    bytes[18] = bytes[19] = bytes[22] = bytes[23] = 0xff;
    bytes[20] = 0;
    check_refused(bytes, size, "65535 x 65535 pixels, expected at most 268435456");
}
