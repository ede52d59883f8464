/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L

#include "image/curve.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#include "base/minmax.h"

/* A value has the code c if it lies between the curve's inverses at c - 1/2 and at c + 1/2; these
   thresholds alone decide. Floats that share exponent and leading fraction bits form a bucket,
   which a value's bits select. With 8 bits a bucket holds at most one threshold. Its entry has the
   code of its least value above ENTRY_BITS. The bits below hold the distance from the threshold to
   the bucket's end. Adding the value's place in the bucket carries into the code exactly from the
   threshold on. With 16 bits the code grows almost linearly in a bucket. The curve is concave, so a
   straight line from the bucket's first to its last value never lies above it. It lies less than
   0.1 of a code below, so only the next code is a second candidate. */
enum {
    LEADING_BITS_8 = 7,
    LEADING_BITS_16 = 8,
    LOWEST_POWER_8 = -13, /* 2 to this power is below the first threshold */
    LOWEST_POWER_16 = -21,
    BUCKETS_8 = -LOWEST_POWER_8 << LEADING_BITS_8,
    BUCKETS_16 = -LOWEST_POWER_16 << LEADING_BITS_16,
    POSITION_BITS = 8,   /* fraction bits of a position, whose integer part is a code */
    POSITION_MARGIN = 8, /* for rounding errors */
    FLOAT_FRACTION_BITS = 23,
    FLOAT_BIAS = 127,
    ENTRY_BITS = FLOAT_FRACTION_BITS - LEADING_BITS_8,
    SHIFT_16 = FLOAT_FRACTION_BITS - LEADING_BITS_16
};

#define LOWEST_BITS(power) ((uint32_t)(FLOAT_BIAS + (power)) << FLOAT_FRACTION_BITS)

static uint32_t entries8[BUCKETS_8 + 1]; /* the last entry is for 1 */
static float thresholds16[65537];        /* least value of each code, then infinity */
/* Position of each bucket's least value, then that of 1. */
static uint32_t buckets16[BUCKETS_16 + 1];

/* Returns the third or fifth root of 0 < x <= 1. Newton's steps fall from above until rounding
   stops them. */
static double odd_root(double x, int degree) {
    double root = 1.0;
    for (;;) {
        const double square = root * root;
        const double power = degree == 3 ? square : square * square;
        const double next = root - (root - x / power) / degree;
        if (!(next < root))
            return root;
        root = next;
    }
}

/* Returns linear light for a value on the curve (IEC 61966-2-1); x^2.4 is x^2 times the fifth root
   of x^2. */
static double srgb_to_linear(double value) {
    if (value <= 0.04045)
        return value / 12.92;
    const double x = (value + 0.055) / 1.055;
    return x * x * odd_root(x * x, 5);
}

/* Returns the value on the curve; x^(1/2.4) is the fourth root of x times the cube root of its
   square. */
static double linear_to_srgb(double value) {
    if (value <= 0.04045 / 12.92)
        return value * 12.92;
    const double square = sqrt(value);
    return 1.055 * sqrt(square) * odd_root(square, 3) - 0.055;
}

static uint32_t bits_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static float float_of(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Returns the least float that is not below the positive `value`. */
static float round_up(double value) {
    const float nearest = (float)value;
    return (double)nearest < value ? float_of(bits_of(nearest) + 1) : nearest;
}

static void fill_thresholds(float *thresholds, unsigned top) {
    thresholds[0] = 0.0f;
    for (unsigned code = 1; code <= top; code++)
        thresholds[code] = round_up(srgb_to_linear((code - 0.5) / top));
    thresholds[top + 1] = INFINITY;
}

static void fill_search8(void) {
    float thresholds[257];
    unsigned code = 0;
    fill_thresholds(thresholds, 255);
    for (uint32_t i = 0; i <= BUCKETS_8; i++) {
        const uint32_t lowest = LOWEST_BITS(LOWEST_POWER_8) + (i << ENTRY_BITS);
        while (float_of(lowest) >= thresholds[code + 1])
            code++;
        const uint32_t place = bits_of(thresholds[code + 1]) - lowest;
        const uint32_t missing = place >> ENTRY_BITS == 0 ? (1u << ENTRY_BITS) - place : 0;
        entries8[i] = (code << ENTRY_BITS) + missing;
    }
}

static void fill_search16(void) {
    unsigned code = 0;
    fill_thresholds(thresholds16, 65535);
    for (uint32_t i = 0; i <= BUCKETS_16; i++) {
        const float lowest = float_of(LOWEST_BITS(LOWEST_POWER_16) + (i << SHIFT_16));
        while (lowest >= thresholds16[code + 1])
            code++;
        const double from = (double)thresholds16[code];
        const double step = (double)thresholds16[code + 1] - from;
        const double position = code + ((double)lowest - from) / step;
        const uint32_t rounded = (uint32_t)(position * (1 << POSITION_BITS));
        buckets16[i] = rounded > POSITION_MARGIN ? rounded - POSITION_MARGIN : 0;
    }
}

/* Maps NaN to the least value too. */
static inline float clamp(float value, float lowest) {
    const float raised = value > lowest ? value : lowest;
    return raised < 1.0f ? raised : 1.0f;
}

static inline uint8_t srgb8(float value) {
    const uint32_t lowest = LOWEST_BITS(LOWEST_POWER_8);
    const uint32_t bits = bits_of(clamp(value, 1.0f / (1 << -LOWEST_POWER_8))) - lowest;
    const uint32_t place = bits & ((1u << ENTRY_BITS) - 1);
    return (uint8_t)((entries8[bits >> ENTRY_BITS] + place) >> ENTRY_BITS);
}

/* NaN is not above any threshold. */
static inline uint16_t srgb16(float value) {
    if (!(value >= thresholds16[1]))
        return 0;
    if (value >= 1.0f)
        return 65535;
    const uint32_t bits = bits_of(value) - LOWEST_BITS(LOWEST_POWER_16);
    const uint32_t rest = bits & ((1u << SHIFT_16) - 1);
    const uint32_t *bucket = buckets16 + (bits >> SHIFT_16);
    const uint32_t position = bucket[0] + ((bucket[1] - bucket[0]) * rest >> SHIFT_16);
    const unsigned code = position >> POSITION_BITS;
    return (uint16_t)(code + (value >= thresholds16[code + 1]));
}

static inline uint8_t linear8(float value) {
    return (uint8_t)(int)(clamp(value, 0.0f) * 255.0f + 0.5f);
}

/* The product is exact in double. */
static uint16_t linear16(float value) {
    return (uint16_t)((double)clamp(value, 0.0f) * 65535.0 + 0.5);
}

void hd_curve_encode8(HdCurve curve, const float *restrict values, size_t count,
                      uint8_t *restrict out) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    if (curve == HD_CURVE_LINEAR) {
        for (size_t i = 0; i < count; i++)
            out[i] = linear8(values[i]);
        return;
    }
    pthread_once(&once, fill_search8);
    for (size_t i = 0; i < count; i++)
        out[i] = srgb8(values[i]);
}

void hd_curve_encode_rgba(HdCurve curve, const float *rgb, size_t pixels, uint8_t *rgba) {
    enum { AT_ONCE = 256 };
    uint8_t encoded[AT_ONCE * 3];
    for (size_t first = 0; first < pixels; first += AT_ONCE) {
        const size_t count = hd_min_size(pixels - first, AT_ONCE);
        hd_curve_encode8(curve, rgb + 3 * first, 3 * count, encoded);
        for (size_t i = 0; i < count; i++) {
            memcpy(rgba + 4 * (first + i), encoded + 3 * i, 3);
            rgba[4 * (first + i) + 3] = 255;
        }
    }
}

/* Bisects the bits of the least float of each code; positive floats are ordered as their bits. */
void hd_curve_thresholds8(HdCurve curve, int32_t thresholds[256]) {
    thresholds[0] = 0;
    for (int code = 1; code < 256; code++) {
        uint32_t below = 0, above = bits_of(1.0f);
        while (above - below > 1) {
            const uint32_t middle = below + (above - below) / 2;
            const float value = float_of(middle);
            uint8_t encoded;
            hd_curve_encode8(curve, &value, 1, &encoded);
            if (encoded < code)
                below = middle;
            else
                above = middle;
        }
        thresholds[code] = (int32_t)above;
    }
}

void hd_curve_encode16(HdCurve curve, const float *values, size_t count, uint16_t *out) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    if (curve == HD_CURVE_LINEAR) {
        for (size_t i = 0; i < count; i++)
            out[i] = linear16(values[i]);
        return;
    }
    pthread_once(&once, fill_search16);
    for (size_t i = 0; i < count; i++)
        out[i] = srgb16(values[i]);
}

static uint16_t decoded16[65536]; /* light of each code */

static void fill_decoded16(void) {
    for (int code = 0; code < 65536; code++)
        decoded16[code] = (uint16_t)(srgb_to_linear(code / 65535.0) * 65535.0 + 0.5);
}

void hd_curve_decode16(HdCurve curve, uint16_t *values, size_t count) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    if (curve == HD_CURVE_LINEAR)
        return;
    pthread_once(&once, fill_decoded16);
    for (size_t i = 0; i < count; i++)
        values[i] = decoded16[values[i]];
}

double hd_curve_to_display(HdCurve curve, double linear) {
    if (linear <= 0.0 || linear >= 1.0)
        return linear >= 1.0 ? 1.0 : 0.0;
    return curve == HD_CURVE_LINEAR ? linear : linear_to_srgb(linear);
}

double hd_curve_to_linear(HdCurve curve, double display) {
    if (display <= 0.0 || display >= 1.0)
        return display >= 1.0 ? 1.0 : 0.0;
    return curve == HD_CURVE_LINEAR ? display : srgb_to_linear(display);
}
