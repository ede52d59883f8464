/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "image/picture.h"
#include "image/row_reader.h"
#include "test_folder.h"

enum { WIDTH = 5, HEIGHT = 3, VALUES = WIDTH * HEIGHT * 3 };

static HdFrame make_frame(void) {
    HdError error = {0};
    HdFrame frame;
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    for (int i = 0; i < VALUES; i++)
        frame.rgb[i] = (float)i / (float)(VALUES - 1);
    return frame;
}

/* Reads the whole picture. */
static HdPictureFacts read_picture(const char *path, HdCurve curve, HdPictureValue *values) {
    HdError error = {0};
    HdPictureReader *reader;
    assert_int_equal(hd_picture_reader_open(&reader, path, &error), HD_OK);
    const HdPictureFacts facts = *hd_picture_reader_facts(reader);
    assert_int_equal(hd_picture_reader_start(reader, curve, &error), HD_OK);
    for (int y = 0; y < facts.height; y++)
        assert_int_equal(
            hd_picture_reader_next(reader, values + (size_t)(3 * facts.width * y), &error), HD_OK);
    hd_picture_reader_close(reader);
    return facts;
}

TEST(png_has_the_codes_of_the_file) {
    HdError error = {0};
    HdFrame frame = make_frame();
    HdPictureValue values[VALUES];
    for (int bits = 8; bits <= 16; bits += 8)
        for (int curve = HD_CURVE_LINEAR; curve <= HD_CURVE_SRGB; curve++) {
            const HdPictureStyle style = {(HdCurve)curve, bits};
            uint16_t codes[VALUES];
            uint8_t bytes[VALUES];
            assert_int_equal(hd_picture_write(&frame, &style, "a.png", &error), HD_OK);
            hd_curve_encode16(style.curve, frame.rgb, VALUES, codes);
            hd_curve_encode8(style.curve, frame.rgb, VALUES, bytes);
            const HdPictureFacts facts = read_picture("a.png", style.curve, values);
            assert_ptr_equal(facts.format, &hd_format_png);
            assert_int_equal(facts.curve, curve);
            assert_int_equal(facts.bits, bits);
            assert_int_equal(facts.width, WIDTH);
            assert_int_equal(facts.height, HEIGHT);
            for (int i = 0; i < VALUES; i++) {
                const int code = bits == 8 ? bytes[i] * 257 : codes[i];
                assert_true(values[i].display == code);
                assert_true(values[i].linear == hd_curve_to_linear(style.curve, code / 65535.0));
            }
        }
    hd_frame_free(&frame);
}

TEST(pfm_has_the_values_of_the_frame) {
    HdError error = {0};
    const HdPictureStyle style = {HD_CURVE_SRGB, 8};
    HdFrame frame = make_frame();
    HdPictureValue values[VALUES];
    frame.rgb[0] = NAN;
    frame.rgb[1] = -INFINITY;
    frame.rgb[2] = -2.5f;
    frame.rgb[3] = 70000.0f;
    assert_int_equal(hd_picture_write(&frame, &style, "a.pfm", &error), HD_OK);
    for (int curve = HD_CURVE_LINEAR; curve <= HD_CURVE_SRGB; curve++) {
        const HdPictureFacts facts = read_picture("a.pfm", (HdCurve)curve, values);
        assert_ptr_equal(facts.format, &hd_format_pfm);
        assert_int_equal(facts.width, WIDTH);
        assert_int_equal(facts.height, HEIGHT);
        for (int i = 1; i < VALUES; i++) {
            const double linear = (double)frame.rgb[i];
            assert_true(values[i].linear == linear);
            assert_true(values[i].display == 65535.0 * hd_curve_to_display((HdCurve)curve, linear));
        }
        assert_true(isnan(values[0].linear) && values[1].display == 0.0);
        assert_true(values[2].display == 0.0 && values[3].display == 65535.0);
    }
    hd_frame_free(&frame);
}

TEST(pfm_may_be_big_endian) {
    const char bytes[] = "PF\n1 1\n1.0\n\x3f\x80\0\0\x3f\0\0\0\xc0\0\0\0";
    HdPictureValue values[3];
    write_bytes("big.pfm", bytes, sizeof bytes - 1);
    read_picture("big.pfm", HD_CURVE_LINEAR, values);
    assert_true(values[0].linear == 1.0 && values[1].linear == 0.5 && values[2].linear == -2.0);
}

static void check_refused(const char *path, const char *part) {
    HdError error = {0};
    HdPictureReader *reader = NULL;
    assert_int_equal(hd_picture_reader_open(&reader, path, &error), HD_BAD_INPUT);
    assert_null(reader);
    expect_contains(error.message, path);
    expect_contains(error.message, part);
}

static void check_refused_bytes(const char *bytes, size_t size, const char *part) {
    write_bytes("wrong", bytes, size);
    check_refused("wrong", part);
}

TEST(other_files_are_refused) {
    mkdir("folder", 0777);
    assert_int_equal(mkfifo("pipe", 0666), 0);
    check_refused("folder", "not a regular file");
    check_refused("pipe", "not a regular file");
    check_refused("missing", "No such file");
    check_refused_bytes("", 0, "neither PNG, OpenEXR nor PFM");
    check_refused_bytes("hello", 5, "neither PNG, OpenEXR nor PFM");
    check_refused_bytes("Pf\n1 1\n-1\n0000", 14, "without colour");
    const char *const heads[] = {
        "PF",
        "PF\n",
        "PF\n1\n",
        "PF\n1 1\n",
        "PF\n0 1\n-1.0\n",
        "PF\n1 0\n-1\n",
        "PF\n65536 1\n-1\n",
        "PF\n1 65536\n-1\n",
        "PF\n1 1\n-2\n",
        "PF\n1 1\n0\n",
        "PF\nx 1\n-1\n",
        "PF\n1 1\nnan\n",
        "PF 1 1 -1\n",
        "PF\n99999999999999999999 1\n-1\n",
    };
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++)
        check_refused_bytes(heads[i], strlen(heads[i]), "expected the lines PF, WIDTH HEIGHT");
    check_refused_bytes("PF\n1 1\n-1\n", 10, "has 10 bytes, expected 22 for 1 x 1");
    check_refused_bytes("PF\n1 1\n-1\n0123456789abc", 23, "has 23 bytes, expected 22");
    check_refused_bytes("\x89PNG\r\n\x1a\n", 8, "ends too early");
}

/* A PNG that is cut off is refused at the row where it ends, or after the last one. */
TEST(cut_files_are_refused) {
    HdError error = {0};
    const HdPictureStyle style = {HD_CURVE_SRGB, 8};
    HdFrame frame = make_frame();
    HdPictureValue values[WIDTH * 3];
    struct stat whole;
    assert_int_equal(hd_picture_write(&frame, &style, "cut.png", &error), HD_OK);
    hd_frame_free(&frame);
    assert_int_equal(stat("cut.png", &whole), 0);
    for (off_t size = whole.st_size - 1; size > 0; size--) {
        HdPictureReader *reader;
        assert_int_equal(truncate("cut.png", size), 0);
        HdStatus status = hd_picture_reader_open(&reader, "cut.png", &error);
        if (status == HD_OK) {
            status = hd_picture_reader_start(reader, HD_CURVE_SRGB, &error);
            for (int y = 0; y < HEIGHT && status == HD_OK; y++)
                status = hd_picture_reader_next(reader, values, &error);
            hd_picture_reader_close(reader);
        }
        assert_int_equal(status, HD_BAD_INPUT);
        expect_contains(error.message, "cut.png");
    }
}
