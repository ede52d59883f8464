/* SPDX-License-Identifier: MIT */
#include "image/curve.h"
#include "unit_test.h"

static uint8_t encode8(HdCurve curve, float value) {
    uint8_t code;
    hd_curve_encode8(curve, &value, 1, &code);
    return code;
}

static uint16_t encode16(HdCurve curve, float value) {
    uint16_t code;
    hd_curve_encode16(curve, &value, 1, &code);
    return code;
}

/* Computes the formula of IEC 61966-2-1. */
static double to_linear(double value) {
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static uint64_t hash_integer(uint64_t hash, uint32_t value) {
    for (int i = 0; i < 4; i++)
        hash = (hash ^ (value >> (8 * i) & 0xff)) * 1099511628211u;
    return hash;
}

static int encode(int top, float value) {
    return top == 255 ? encode8(HD_CURVE_SRGB, value) : encode16(HD_CURVE_SRGB, value);
}

/* Each code begins at the float above its threshold, and another system's arithmetic must not give
   other pictures. The hash covers the thresholds and the decoded values. */
TEST(codes_are_rounded_to_the_nearest) {
    static const int tops[] = {255, 65535};
    static uint16_t decoded[65536];
    uint64_t hash = 14695981039346656037u;
    for (int t = 0; t < 2; t++)
        for (int code = 1; code <= tops[t]; code++) {
            const double threshold = to_linear((code - 0.5) / tops[t]);
            float above = (float)threshold;
            if ((double)above < threshold)
                above = nextafterf(above, 2.0f);
            if (encode(tops[t], nextafterf(above, -1.0f)) != code - 1 ||
                encode(tops[t], above) != code)
                fail_msg("the code %d of %d begins at another value", code, tops[t]);
            uint32_t bits;
            memcpy(&bits, &above, sizeof bits);
            hash = hash_integer(hash, bits);
        }
    for (int code = 0; code < 65536; code++)
        decoded[code] = (uint16_t)code;
    hd_curve_decode16(HD_CURVE_SRGB, decoded, 65536);
    for (int code = 0; code < 65536; code++) {
        hash = hash_integer(hash, decoded[code]);
        if (decoded[code] != floor(to_linear(code / 65535.0) * 65535.0 + 0.5))
            fail_msg("the code %d has the value %d", code, decoded[code]);
    }
    if (hash != 0xfb15f0f92a5a2928u)
        fail_msg("the tables have the hash %016llx", (unsigned long long)hash);
}

TEST(values_outside_are_clamped) {
    const float values[] = {0.0f,  -1e-30f, -INFINITY,  NAN,   -NAN,
                            1e-7f, 1.0f,    1.0000001f, 1e30f, INFINITY};
    for (int i = 0; i < 20; i++) {
        const HdCurve curve = i < 10 ? HD_CURVE_LINEAR : HD_CURVE_SRGB;
        assert_int_equal(encode8(curve, values[i % 10]), i % 10 < 6 ? 0 : 255);
        assert_int_equal(encode16(curve, values[i % 10]), i % 10 < 6 ? 0 : 65535);
    }
}

TEST(linear_codes_are_rounded) {
    for (int i = 0; i <= 1 << 20; i++) {
        const float value = (float)i / (float)(1 << 20);
        if (encode8(HD_CURVE_LINEAR, value) != (uint8_t)(value * 255.0f + 0.5f) ||
            encode16(HD_CURVE_LINEAR, value) != floor((double)value * 65535.0 + 0.5))
            fail_msg("%a has another code", (double)value);
    }
}

TEST(the_curve_is_that_of_the_standard) {
    for (int i = 0; i <= 100000; i++) {
        const double value = i / 100000.0;
        const double power = 1.055 * pow(value, 1.0 / 2.4) - 0.055;
        expect_near(hd_curve_to_linear(HD_CURVE_SRGB, value), to_linear(value), 1e-15);
        expect_near(hd_curve_to_display(HD_CURVE_SRGB, value),
                    value <= 0.04045 / 12.92 ? 12.92 * value : power, 1e-15);
        assert_true(hd_curve_to_display(HD_CURVE_LINEAR, value) == value);
        assert_true(hd_curve_to_linear(HD_CURVE_LINEAR, value) == value);
    }
    expect_near(hd_curve_to_display(HD_CURVE_SRGB, 1e-300), 12.92e-300, 1e-313);
    for (int curve = HD_CURVE_LINEAR; curve <= HD_CURVE_SRGB; curve++) {
        const double outside[] = {1.0, (double)INFINITY};
        for (int i = 0; i < 2; i++) {
            assert_true(hd_curve_to_display((HdCurve)curve, outside[i]) == 1.0);
            assert_true(hd_curve_to_linear((HdCurve)curve, outside[i]) == 1.0);
            assert_true(hd_curve_to_display((HdCurve)curve, -outside[i]) == 0.0);
            assert_true(hd_curve_to_linear((HdCurve)curve, -outside[i]) == 0.0);
        }
        assert_true(isnan(hd_curve_to_display((HdCurve)curve, (double)NAN)));
        assert_true(isnan(hd_curve_to_linear((HdCurve)curve, (double)NAN)));
    }
}
