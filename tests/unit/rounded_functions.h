/* SPDX-License-Identifier: MIT */
/* Division and roots of fused operations against the processor's: with float all digits of a
   divisor and of a number under a root, with both precisions the probe's hard cases. */
#define HD_LANES          8
#define HD_ROUNDED_BY_FMA 1

#include <math.h>

#include "cpu/dialect.h"

#include "kernels/common/dialect.h"

#include "device/probe_operands.h"
#include "unit_test.h"

static real own_root(real a) {
    return sizeof(real) == sizeof(float) ? (real)sqrtf((float)a) : (real)sqrt((double)a);
}

static void expect_same(real found, real expected, const char *what, real a, real b) {
    if (isnan(found) && isnan(expected))
        return;
    if (memcmp(&found, &expected, sizeof found) != 0)
        fail_msg("%s of %a and %a is %a, expected %a", what, (double)a, (double)b, (double)found,
                 (double)expected);
}

static void check(const real a[HD_LANES], const real b[HD_LANES]) {
    vreal quotients = quotient(load_reals(a), load_reals(b)), roots = square_root(load_reals(a));
    for (int lane = 0; lane < HD_LANES; lane++) {
        expect_same(lane_real(&quotients, lane), a[lane] / b[lane], "the quotient", a[lane],
                    b[lane]);
        expect_same(lane_real(&roots, lane), own_root(a[lane]), "the root", a[lane], R(0.0));
    }
}

/* Every number in [1, 2) divides one that is drawn from there; the roots of all in [1, 4). */
TEST(all_digits_are_right) {
    const uint32_t digits = (uint32_t)1 << 23;
    real a[HD_LANES], b[HD_LANES], drawn[HD_LANES];
    for (uint32_t i = 0; sizeof(real) == sizeof(float) && i < digits; i += HD_LANES) {
        for (uint32_t lane = 0; lane < HD_LANES; lane++) {
            drawn[lane] = R(1.0) + (real)(((i + lane) * 2654435761u) >> 9) / (real)digits;
            b[lane] = R(1.0) + (real)(i + lane) / (real)digits;
            a[lane] = R(2.0) * b[lane];
        }
        check(drawn, b);
        check(a, drawn);
        check(b, drawn);
    }
}

TEST(hard_cases_are_right) {
    enum { COUNT = 1 << 12, BATCHES = 1 << 8 };
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
            check(numbers[0] + i, numbers[1] + i);
            check(numbers[1] + i, numbers[2] + i);
        }
    }
}
