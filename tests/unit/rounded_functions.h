/* SPDX-License-Identifier: MIT */
/* Compares division and roots of fused operations with the processor's: in float all digits of a
   divisor and of a number under a root. In both precisions it tests the probe's hard cases. */
#define HD_LANES          8
#define HD_ROUNDED_BY_FMA 1

#include <math.h>

#include "cpu/dialect.h"

#include "kernels/common/division.h"

#include "unit_test.h"
#include "verify/probe_operands.h"

/* Sanitizers are slow, and check a part of the numbers. */
#ifndef __has_feature
#define __has_feature(name) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
enum { SHARE = 64 };
#else
enum { SHARE = 1 };
#endif

/* Any NaN equals another. */
static void expect_same(vreal found, const real expected[HD_LANES], const char *what,
                        const real a[HD_LANES], const real b[HD_LANES]) {
    if (memcmp(&found, expected, sizeof found) == 0)
        return;
    for (int lane = 0; lane < HD_LANES; lane++) {
        real own = lane_real(&found, lane);
        if (memcmp(&own, &expected[lane], sizeof own) != 0 &&
            !(isnan(own) && isnan(expected[lane])))
            fail_msg("%s of %a and %a is %a, expected %a", what, (double)a[lane], (double)b[lane],
                     (double)own, (double)expected[lane]);
    }
}

static void check_quotients(const real a[HD_LANES], const real b[HD_LANES]) {
    real expected[HD_LANES];
    for (int lane = 0; lane < HD_LANES; lane++)
        expected[lane] = a[lane] / b[lane];
    expect_same(quotient(load_reals(a), load_reals(b)), expected, "the quotient", a, b);
}

static void check_roots(const real a[HD_LANES]) {
    real expected[HD_LANES];
    for (int lane = 0; lane < HD_LANES; lane++)
        expected[lane] = sizeof(real) == sizeof(float) ? (real)sqrtf((float)a[lane])
                                                       : (real)sqrt((double)a[lane]);
    expect_same(square_root(load_reals(a)), expected, "the root", a, a);
}

/* Every number in [1, 2) divides a random one of the same range; the roots of all in [1, 4). */
TEST(all_digits_are_correct) {
    const uint32_t digits = (uint32_t)1 << 23;
    real a[HD_LANES], b[HD_LANES], drawn[HD_LANES];
    for (uint32_t i = 0; sizeof(real) == sizeof(float) && i < digits; i += SHARE * HD_LANES) {
        for (uint32_t lane = 0; lane < HD_LANES; lane++) {
            drawn[lane] = R(1.0) + (real)(((i + lane) * 2654435761u) >> 9) / (real)digits;
            b[lane] = R(1.0) + (real)(i + lane) / (real)digits;
            a[lane] = R(2.0) * b[lane];
        }
        check_quotients(drawn, b);
        check_roots(a);
        check_roots(b);
    }
}

TEST(hard_cases_are_right) {
    enum { COUNT = 1 << 12, BATCHES = 256 / SHARE };
    static real numbers[3][COUNT];
    static int64_t bits[COUNT];
    HdProbeBatch batch = {.count = COUNT, .bits = bits};
    for (int i = 0; i < 3; i++)
        batch.operands[i] = numbers[i];
    for (uint64_t start = 0; start < BATCHES; start++) {
#if HD_DOUBLE
        hd_probe_operands_double(&batch, start * COUNT);
#else
        hd_probe_operands_float(&batch, start * COUNT);
#endif
        for (int i = 0; i < COUNT; i += HD_LANES) {
            check_quotients(numbers[0] + i, numbers[1] + i);
            check_quotients(numbers[1] + i, numbers[2] + i);
            check_roots(numbers[0] + i);
            check_roots(numbers[1] + i);
        }
    }
}
