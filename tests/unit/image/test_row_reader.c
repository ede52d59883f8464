/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700

#include "picture_files.h"

enum { WIDTH = 5, HEIGHT = 3, VALUES = WIDTH * HEIGHT * 3 };

static HdError error;

static HdFrame make_frame(void) {
    HdFrame frame;
    assert_int_equal(hd_frame_create(&frame, WIDTH, HEIGHT, &error), HD_OK);
    for (int i = 0; i < VALUES; i++)
        frame.rgb[i] = (float)i / (float)(VALUES - 1);
    return frame;
}

static HdPictureFacts expect_readable(const char *path, HdCurve curve, HdPictureValue *values) {
    HdPictureFacts facts;
    if (read_picture(path, curve, &facts, values, VALUES, &error) != HD_OK)
        fail_msg("%s", error.message);
    return facts;
}

TEST(png_has_the_codes_of_the_file) {
    HdFrame frame = make_frame();
    HdPictureValue values[VALUES];
    unsigned char head[45];
    for (int bits = 8; bits <= 16; bits += 8)
        for (int curve = HD_CURVE_LINEAR; curve <= HD_CURVE_SRGB; curve++) {
            const HdPictureStyle style = {(HdCurve)curve, bits, false};
            uint16_t codes[VALUES];
            uint8_t bytes[VALUES];
            assert_int_equal(hd_picture_write(&frame, &style, "a.png", &error), HD_OK);
            hd_curve_encode16(style.curve, frame.rgb, VALUES, codes);
            hd_curve_encode8(style.curve, frame.rgb, VALUES, bytes);
            const HdPictureFacts facts = expect_readable("a.png", style.curve, values);
            read_bytes("a.png", head, sizeof head);
            if (curve == HD_CURVE_LINEAR)
                assert_memory_equal(head + 33, "\0\0\0\4gAMA\0\1\x86\xa0", 12);
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

/* Any style, and values that no other format can hold. */
TEST(pfm_has_the_values_of_the_frame) {
    const HdPictureStyle style = {HD_CURVE_SRGB, 8, false};
    HdFrame frame = make_frame();
    HdPictureValue values[VALUES];
    unsigned char bytes[13 + 4 * VALUES];
    const char big[] = "PF\n1 1\n1.0\n\x3f\x80\0\0\x3f\0\0\0\xc0\0\0\0"; /* endian */
    const float first[] = {NAN, -INFINITY, -2.5f, 70000.0f};
    memcpy(frame.rgb, first, sizeof first);
    frame.rgb[WIDTH * 2 * 3] = 1.0f;
    assert_int_equal(hd_picture_write(&frame, &style, "a.Pfm", &error), HD_OK);
    assert_int_equal(read_bytes("a.Pfm", bytes, sizeof bytes), 12 + 4 * VALUES);
    assert_memory_equal(bytes, "PF\n5 3\n-1.0\n\0\0\x80\x3f", 16); /* from the last row */
    for (int curve = HD_CURVE_LINEAR; curve <= HD_CURVE_SRGB; curve++) {
        const HdPictureFacts facts = expect_readable("a.Pfm", (HdCurve)curve, values);
        assert_ptr_equal(facts.format, &hd_format_pfm);
        assert_int_equal(facts.width, WIDTH);
        assert_int_equal(facts.height, HEIGHT);
        for (int i = 1; i < VALUES; i++) {
            const double linear = (double)frame.rgb[i];
            assert_true(values[i].linear == linear);
            assert_true(values[i].display == 65535.0 * hd_curve_to_display((HdCurve)curve, linear));
        }
        assert_true(isnan(values[0].linear));
    }
    hd_frame_free(&frame);
    write_bytes("big.pfm", big, sizeof big - 1);
    expect_readable("big.pfm", HD_CURVE_LINEAR, values);
    assert_true(values[0].linear == 1.0 && values[1].linear == 0.5 && values[2].linear == -2.0);
}

static void check_refused(const char *path, const char *part) {
    HdPictureReader *reader = NULL;
    assert_int_equal(hd_picture_reader_open(&reader, path, &error), HD_BAD_INPUT);
    assert_null(reader);
    expect_contains(error.message, path);
    expect_contains(error.message, part);
}

TEST(other_files_are_refused) {
    static const char lines[] = "expected the lines PF, WIDTH HEIGHT",
                      other[] = "neither PNG, OpenEXR nor PFM";
    static const struct {
        const char *bytes, *part;
    } cases[] = {
        {"", other},
        {"hello", other},
        {"Pf\n1 1\n-1\n0000", "without colour"},
        {"PF", lines},
        {"PF\n1 1\n", lines},
        {"PF\n0 1\n-1.0\n", lines},
        {"PF\n65536 1\n-1\n", lines},
        {"PF\n1 1\n-2\n", lines},
        {"PF\n1 1\n0\n", lines},
        {"PF\n1 1\nnan\n", lines},
        {"PF 1 1 -1\n", lines},
        {"PF\n1 1\n-1\n", "has 10 bytes, expected 22 for 1 x 1"},
        {"PF\n1 1\n-1\n0123456789abc", "has 23 bytes, expected 22"},
        {"\x89PNG\r\n\x1a\n", "ends too early"},
    };
    mkdir("folder", 0777);
    assert_int_equal(mkfifo("pipe", 0666), 0);
    check_refused("folder", "not a regular file");
    check_refused("pipe", "not a regular file");
    check_refused("missing", "No such file");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_bytes("wrong", cases[i].bytes, strlen(cases[i].bytes));
        check_refused("wrong", cases[i].part);
    }
}

/* A truncated PNG is refused at the row where it ends, or after the last one. */
TEST(cut_files_are_refused) {
    const HdPictureStyle style = {HD_CURVE_SRGB, 8, false};
    HdFrame frame = make_frame();
    HdPictureFacts facts;
    HdPictureValue values[VALUES];
    struct stat whole;
    assert_int_equal(hd_picture_write(&frame, &style, "cut.png", &error), HD_OK);
    hd_frame_free(&frame);
    assert_int_equal(stat("cut.png", &whole), 0);
    for (off_t size = whole.st_size - 1; size > 0; size--) {
        assert_int_equal(truncate("cut.png", size), 0);
        assert_int_equal(read_picture("cut.png", HD_CURVE_SRGB, &facts, values, VALUES, &error),
                         HD_BAD_INPUT);
        expect_contains(error.message, "cut.png");
    }
}
