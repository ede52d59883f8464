/* SPDX-License-Identifier: MIT */
/* The kernels' conversion to 8 bits gives the host's bytes. */
#include "cpu/dialect.h"
#include "image/curve.h"
#include "kernels/common/render.h"
#include "unit_test.h"

static int32_t thresholds[256];

static void expect_same(HdCurve curve, int bits) {
    float value;
    uint8_t expected;
    memcpy(&value, &bits, sizeof value);
    hd_curve_encode8(curve, &value, 1, &expected);
    if (encode8(bits, thresholds) != expected)
        fail_msg("curve %d: %a has the code %u, expected %d", (int)curve, (double)value,
                 encode8(bits, thresholds), expected);
}

TEST(every_kind_of_number_has_the_code_of_the_host) {
    enum { STEP = 4001 };
    const float special[] = {0.0f, -0.0f, 1e-45f, 1.0f, INFINITY, -INFINITY, NAN, -NAN};
    for (HdCurve curve = HD_CURVE_LINEAR; curve <= HD_CURVE_SRGB; curve++) {
        hd_curve_thresholds8(curve, thresholds);
        for (int code = 1; code < 256; code++) {
            assert_int_equal(encode8(thresholds[code], thresholds), code);
            for (int i = -2; i <= 2; i++)
                expect_same(curve, thresholds[code] + i);
        }
        for (size_t i = 0; i < sizeof special / sizeof *special; i++) {
            int bits;
            memcpy(&bits, &special[i], sizeof bits);
            expect_same(curve, bits);
        }
        for (int64_t bits = INT32_MIN; bits <= INT32_MAX; bits += STEP)
            expect_same(curve, (int)bits);
    }
}

TEST(pixels_become_bytes_in_order) {
    enum { PIXELS = 7, WORKERS = 3 };
    float rgb[PIXELS * 3];
    int bits[PIXELS * 3];
    uint image[PIXELS] = {0};
    uint8_t expected[PIXELS * 3], bytes[PIXELS * 4];
    for (int i = 0; i < PIXELS * 3; i++)
        rgb[i] = (float)i / (PIXELS * 3 - 1);
    memcpy(bits, rgb, sizeof bits);
    hd_curve_encode8(HD_CURVE_SRGB, rgb, sizeof rgb / sizeof *rgb, expected);
    hd_curve_thresholds8(HD_CURVE_SRGB, thresholds);
    for (int worker = 0; worker < WORKERS; worker++)
        encode_pixels(bits, PIXELS, thresholds, worker, WORKERS, image);
    memcpy(bytes, image, sizeof bytes);
    for (int i = 0; i < PIXELS; i++) {
        assert_memory_equal(bytes + 4 * i, expected + 3 * i, 3);
        assert_int_equal(bytes[4 * i + 3], 255);
    }
}
