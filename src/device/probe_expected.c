/* SPDX-License-Identifier: MIT */
#include <math.h>
#include <stddef.h>

#include "device/probe_operands.h"
#include "kernels/host/shared.h"

#if HD_DOUBLE
#define EXPECT hd_probe_expect_double
#define FUSED  fma
#define ROOT   sqrt
#define SIZE   fabs
#define SIGN   copysign
#else
#define EXPECT hd_probe_expect_float
#define FUSED  fmaf
#define ROOT   sqrtf
#define SIZE   fabsf
#define SIGN   copysignf
#endif

static real within(real a, real limit) {
    real more = -limit < a ? a : -limit;
    return more < limit ? more : limit;
}

#define NUMBER(name, value)  numbers[HD_PROBE_NUMBER_##name * stride] = (value)
#define INTEGER(name, value) integers[HD_PROBE_INTEGER_##name * stride] = (value)

static void expect_arithmetic(real a, real b, real c, size_t stride, real *numbers) {
    real product = a * b, sum = a + b;
    NUMBER(sum, sum);
    NUMBER(difference, a - b);
    NUMBER(product, product);
    NUMBER(negative, -a);
    NUMBER(quotient, a / b);
    NUMBER(root, ROOT(a));
    NUMBER(fused, FUSED(a, b, c));
    NUMBER(apart, product + c);
    NUMBER(apart_from, c - product);
    NUMBER(in_order, sum + c);
    NUMBER(lost, sum - a);
    NUMBER(nothing, a - a);
    NUMBER(plus_zero, a + R(0.0));
}

static void expect_selection(real a, real b, real c, size_t stride, real *numbers,
                             int64_t *integers) {
    NUMBER(absolute, SIZE(a));
    NUMBER(lesser, a < b ? a : b);
    NUMBER(greater, b < a ? a : b);
    NUMBER(signed, SIGN(R(1.0), b) < R(0.0) ? -a : a);
    NUMBER(picked, a <= b ? c : a);
    INTEGER(less, a < b);
    INTEGER(less_equal, a <= b);
    INTEGER(is_number, !isnan(a));
}

/* Shifts round down, which C leaves open for negative numbers. */
static int64_t shift_down(int64_t number, int bits) {
    return number < 0 ? ~(~number >> bits) : number >> bits;
}

static void expect_conversions(real a, int64_t x, size_t stride, real *numbers, int64_t *integers) {
    int32_t n = (int32_t)(uint32_t)x, whole = (int32_t)within(a, R(1073741824.0));
    uint32_t u = (uint32_t)x;
    int lowest = 0, count = 0;
    while (lowest < 31 && (u >> lowest & 1) == 0)
        lowest++;
    for (int bit = 0; bit < 32; bit++)
        count += (int)(u >> bit & 1);
    NUMBER(of_int, (real)n);
    NUMBER(of_fixed, (real)x);
    INTEGER(to_int, whole);
    INTEGER(to_fixed, (int64_t)within(a, R(4611686018427387904.0)));
    INTEGER(int_order, n < whole ? n : whole);
    INTEGER(shifted, shift_down(n, 5));
    INTEGER(fixed_sum, (int64_t)((uint64_t)x + (uint64_t)shift_down(x, 7)));
    INTEGER(lowest_bit, lowest);
    INTEGER(bit_count, count);
}

void EXPECT(const HdProbeBatch *batch, HdProbeResults *results) {
    const real *a = batch->operands[0], *b = batch->operands[1], *c = batch->operands[2];
    size_t stride = (size_t)batch->count;
    for (size_t i = 0; i < stride; i++) {
        real *numbers = (real *)results->numbers + i;
        int64_t *integers = results->integers + i, x = batch->bits[i];
        expect_arithmetic(a[i], b[i], c[i], stride, numbers);
        expect_selection(a[i], b[i], c[i], stride, numbers, integers);
        expect_conversions(a[i], x, stride, numbers, integers);
        int64_t *sum = &results->sums[i % HD_PROBE_SUMS];
        *sum = (int64_t)((uint64_t)*sum + (uint64_t)x);
        results->counters[i % HD_PROBE_COUNTERS] += (uint32_t)x & 0xffff;
    }
}
