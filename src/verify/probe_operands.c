/* SPDX-License-Identifier: MIT */
#include "verify/probe_operands.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "kernels/host/shared.h"

#if HD_DOUBLE
typedef uint64_t Bits;
enum { DIGITS = 53, MIN_EXPONENT = -1022, MAX_EXPONENT = 1023, ROOT_BITS = 56 };
#define FILL   hd_probe_operands_double
#define EXPECT hd_probe_expect_double
#define FUSED  fma
#define ROOT   sqrt
#define SIZE   fabs
#define SIGN   copysign
#else
typedef uint32_t Bits;
enum { DIGITS = 24, MIN_EXPONENT = -126, MAX_EXPONENT = 127, ROOT_BITS = 26 };
#define FILL   hd_probe_operands_float
#define EXPECT hd_probe_expect_float
#define FUSED  fmaf
#define ROOT   sqrtf
#define SIZE   fabsf
#define SIGN   copysignf
#endif

typedef struct Tuple {
    real a, b, c;
} Tuple;

/* ---- numbers ---- */

/* SplitMix (Steele and others): any number of a sequence without its predecessors. */
static uint64_t mix(uint64_t number) {
    number += 0x9e3779b97f4a7c15;
    number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9;
    number = (number ^ (number >> 27)) * 0x94d049bb133111eb;
    return number ^ (number >> 31);
}

/* May occur once in an expression: C leaves the order of calls open, and the operands must be the
   same everywhere. */
static uint64_t draw(uint64_t *seed) {
    *seed = mix(*seed);
    return *seed;
}

static int draw_between(uint64_t *seed, int least, int most) {
    return least + (int)(draw(seed) % (uint64_t)(most - least + 1));
}

static real from_pattern(uint64_t pattern) {
    Bits bits = (Bits)pattern;
    real number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static real scaled(real number, int exponent) {
#if HD_DOUBLE
    return ldexp(number, exponent);
#else
    return ldexpf(number, exponent);
#endif
}

/* The last digits are few or many ones, or random. */
static uint64_t draw_digits(uint64_t *seed) {
    const uint64_t all = ((uint64_t)1 << (DIGITS - 1)) - 1, digits = draw(seed) & all;
    const uint64_t kinds[] = {digits & 7, all - (digits & 7), digits & (all << (DIGITS / 2))};
    const uint64_t kind = draw(seed) & 7;
    return kind < 3 ? kinds[kind] : digits;
}

/* Draws from [1, 2), with either sign. */
static real draw_unit(uint64_t *seed) {
    uint64_t digits = draw_digits(seed);
    real number = R(1.0) + (real)digits * scaled(R(1.0), 1 - DIGITS);
    return draw(seed) & 1 ? -number : number;
}

static real draw_of_size(uint64_t *seed, int least, int most) {
    real unit = draw_unit(seed);
    return scaled(unit, draw_between(seed, least, most));
}

/* ---- kinds of tuples ---- */

static void fill_any(Tuple *tuple, uint64_t seed) {
    tuple->a = from_pattern(draw(&seed));
    tuple->b = from_pattern(draw(&seed));
    tuple->c = from_pattern(draw(&seed));
}

static real special(uint64_t number) {
    const real one = R(1.0), last = scaled(one, 1 - DIGITS);
    const real values[] = {R(0.0),
                           one,
                           one + last,
                           one - last * R(0.5),
                           R(2.0),
                           R(0.5),
                           R(3.0),
                           R(10.0),
                           (real)INFINITY,
                           (real)NAN,
                           scaled(one, MIN_EXPONENT),
                           scaled(one - last * R(0.5), MIN_EXPONENT),
                           scaled(one - last, MIN_EXPONENT),
                           scaled(one + last, MIN_EXPONENT),
                           scaled(one, MIN_EXPONENT - DIGITS + 1),
                           scaled(R(3.0), MIN_EXPONENT - DIGITS + 1),
                           scaled(one, MIN_EXPONENT / 2),
                           scaled(R(2.0) - last, MAX_EXPONENT),
                           scaled(one, MAX_EXPONENT),
                           scaled(one, MAX_EXPONENT / 2 + 1),
                           scaled(one, DIGITS),
                           scaled(one, DIGITS - 1),
                           scaled(one, DIGITS - 1) - R(0.5),
                           scaled(one, 31)};
    enum { COUNT = sizeof values / sizeof *values };
    real value = values[number / 2 % COUNT];
    return number & 1 ? -value : value;
}

/* All pairs of special numbers, in an arbitrary order. */
static void fill_special(Tuple *tuple, uint64_t number) {
    uint64_t place = number * 48611 % (48 * 48 * 48);
    tuple->a = special(place);
    tuple->b = special(place / 48);
    tuple->c = special(place / 48 / 48);
}

/* Sums and fused sums that are ties or nearly so, or nearly cancel. */
static void fill_sum(Tuple *tuple, uint64_t seed) {
    const real last = scaled(R(1.0), 1 - DIGITS);
    int size = draw_between(&seed, -20, 20);
    tuple->a = draw_unit(&seed);
    tuple->b = draw_unit(&seed);
    switch (draw(&seed) & 3) {
    case 0: { /* c cancels the rounded a * b, exactly or nearly */
        real product = tuple->a * tuple->b;
        tuple->c = -product * (R(1.0) + (real)draw_between(&seed, -1, 1) * last);
        break;
    }
    case 1: { /* a * b is nearly half of c's last place */
        tuple->a = R(1.0) + (real)draw_between(&seed, -3, 3) * last;
        tuple->b = R(1.0) + (real)draw_between(&seed, -3, 3) * last;
        tuple->c = scaled(draw_unit(&seed), DIGITS);
        break;
    }
    case 2: { /* b is nearly half of a's last place */
        real nearly_one = R(1.0) + (real)draw_between(&seed, -1, 1) * last;
        tuple->b = scaled(nearly_one, -DIGITS + draw_between(&seed, -1, 1));
        tuple->c = draw_of_size(&seed, -DIGITS - 3, 3);
        break;
    }
    default:
        tuple->c = draw_of_size(&seed, -2 * DIGITS - 3, DIGITS + 3);
        break;
    }
    tuple->a = scaled(tuple->a, size);
    tuple->c = scaled(tuple->c, size);
    if (draw(&seed) & 1)
        tuple->a = -tuple->a;
}

/* Computes (high, low) = a * b + c. */
static void multiply(uint64_t a, uint64_t b, int64_t c, uint64_t *high, uint64_t *low) {
    uint64_t al = a & 0xffffffff, ah = a >> 32, bl = b & 0xffffffff, bh = b >> 32;
    uint64_t middle = al * bh + (al * bl >> 32), other = ah * bl + (middle & 0xffffffff);
    *high = ah * bh + (middle >> 32) + (other >> 32);
    *low = a * b + (uint64_t)c;
    if (c >= 0 ? *low < (uint64_t)c : *low >= (uint64_t)c)
        *high += c >= 0 ? 1 : (uint64_t)-1;
}

static uint64_t shift_pair(uint64_t high, uint64_t low, int bits) {
    return high << (64 - bits) | low >> bits;
}

/* Returns 1 / odd modulo 2^64 (Newton's method doubles the digits). */
static uint64_t modular_inverse(uint64_t odd) {
    uint64_t inverse = odd;
    for (int i = 0; i < 5; i++)
        inverse *= 2 - odd * inverse;
    return inverse;
}

/* Makes a / b as close as possible to the middle of two numbers. With N = DIGITS + 1 it is M / 2^N
   + rest / (2^N b) for an odd M of N bits, so that M b = -rest modulo 2^N. */
static void fill_close_quotient(Tuple *tuple, uint64_t *seed) {
    const int bits = DIGITS + 1;
    const uint64_t all = ((uint64_t)1 << bits) - 1;
    uint64_t b = draw_digits(seed) | (uint64_t)1 << (DIGITS - 1) | 1, high, low;
    int64_t rest = 2 * draw_between(seed, 0, 8) + 1;
    uint64_t middle = (0 - (uint64_t)rest) * modular_inverse(b) & all;
    if (middle >> (bits - 1) == 0) {
        middle = (all + 1 - middle) & all;
        rest = -rest;
    }
    multiply(middle, b, rest, &high, &low);
    tuple->a = (real)shift_pair(high, low, bits);
    tuple->b = (real)b;
}

static void fill_quotient(Tuple *tuple, uint64_t seed) {
    uint64_t kind = draw(&seed) & 7;
    if (kind < 4) {
        fill_close_quotient(tuple, &seed);
    } else {
        tuple->b = draw_unit(&seed);
        tuple->a =
            draw_unit(&seed) * (kind < 6 ? tuple->b : R(1.0)); /* near another unit, or random */
    }
    int least = kind & 1 ? 1 - DIGITS : MIN_EXPONENT - DIGITS - 2;
    int size_b = draw_between(&seed, MIN_EXPONENT / 2, MAX_EXPONENT / 2);
    int size = kind & 1 ? draw_between(&seed, least, DIGITS)
                        : draw_between(&seed, least, least + 2 * DIGITS);
    tuple->b = scaled(tuple->b, size_b / 4);
    tuple->a = scaled(tuple->a, size + size_b / 4);
    tuple->c = draw_of_size(&seed, -3, 3);
    if (draw(&seed) & 1)
        tuple->a = -tuple->a;
}

/* Makes a's root as close as possible to the middle of two numbers: x / 2 for an odd x of DIGITS +
   1 bits with x^2 = a 2^k + rest, so that x is a root of rest modulo 2^k. */
static real close_square(uint64_t *seed) {
    int64_t rest = 1 + 8 * (int64_t)draw_between(seed, -64, 64);
    uint64_t x = 1, top = (uint64_t)1 << (DIGITS + 1), high, low;
    for (int bit = 3; bit < ROOT_BITS; bit++)
        if (((x * x - (uint64_t)rest) >> bit) & 1)
            x += (uint64_t)1 << (bit - 1);
    x &= top - 1;
    if (x < top / 2)
        x = top - x;
    multiply(x, x, -rest, &high, &low);
    return (real)shift_pair(high, low, ROOT_BITS);
}

static void fill_root(Tuple *tuple, uint64_t seed) {
    real root = draw_unit(&seed);
    switch (draw(&seed) & 3) {
    case 0:
        tuple->a = root * root;
        break;
    case 1:
        tuple->a = draw_of_size(&seed, MIN_EXPONENT - DIGITS, MAX_EXPONENT);
        tuple->a = tuple->a < R(0.0) ? -tuple->a : tuple->a;
        break;
    default:
        tuple->a = close_square(&seed);
        tuple->a = scaled(tuple->a, 2 * draw_between(&seed, MIN_EXPONENT / 2 - DIGITS / 2,
                                                     MAX_EXPONENT / 2 - DIGITS));
        break;
    }
    tuple->b = draw_of_size(&seed, -3, 3);
    tuple->c = draw_of_size(&seed, -3, 3);
}

/* Operands or results are below the least normal number, or near the greatest. */
static void fill_small(Tuple *tuple, uint64_t seed) {
    enum { LEAST = MIN_EXPONENT, MOST = MAX_EXPONENT };
    static const struct {
        int least, most;
    } exponents[4][3] = {
        /* The product and c are small; a has the size below. */
        {{0, 0}, {LEAST / 2 - 2, LEAST / 2 + 2}, {LEAST - DIGITS, LEAST + 2}},
        /* Sums of small numbers. */
        {{LEAST - DIGITS, LEAST + 2}, {LEAST - DIGITS, LEAST + 2}, {LEAST - DIGITS, LEAST + 2}},
        /* A small number among others. */
        {{LEAST - DIGITS, LEAST - 1}, {-DIGITS, DIGITS}, {LEAST - DIGITS, LEAST + DIGITS}},
        {{MOST / 2 - 2, MOST / 2 + 2}, {MOST / 2 - 2, MOST / 2 + 2}, {MOST - 2, MOST}},
    };
    int size = draw_between(&seed, LEAST / 2 - DIGITS, LEAST / 2 + 2);
    const int kind = (int)(draw(&seed) & 3);
    real *const numbers[] = {&tuple->a, &tuple->b, &tuple->c};
    for (int i = 0; i < 3; i++)
        *numbers[i] = kind == 0 && i == 0
                          ? scaled(draw_unit(&seed), size)
                          : draw_of_size(&seed, exponents[kind][i].least, exponents[kind][i].most);
}

/* a is near a whole number, a half or the limit of the conversion. */
static void fill_whole(Tuple *tuple, uint64_t seed) {
    const real last = scaled(R(1.0), 1 - DIGITS);
    uint64_t any = draw(&seed);
    real whole = (real)(any >> draw_between(&seed, 1, 62));
    real half = (real)draw_between(&seed, -2, 2) * R(0.5);
    tuple->a = (whole + half) * (R(1.0) + (real)draw_between(&seed, -1, 1) * last);
    if (draw(&seed) & 1)
        tuple->a = -tuple->a;
    tuple->b = draw(&seed) & 1 ? tuple->a : draw_of_size(&seed, -3, 40);
    tuple->c = draw_of_size(&seed, -3, 40);
}

/* Draws an integer that is nearly a tie when converted: of 64 bits, of 32, or random. */
static int64_t draw_integer(uint64_t seed) {
    uint64_t kind = draw(&seed) % 3, digits = draw_digits(&seed) | (uint64_t)1 << (DIGITS - 1);
    int capacity = (kind == 0 ? 63 : 31) - DIGITS;
    int64_t number = (int64_t)draw(&seed);
    if (kind < 2 && capacity > 0) {
        int shift = draw_between(&seed, 1, capacity);
        number =
            (int64_t)(digits << shift) + ((int64_t)1 << (shift - 1)) + draw_between(&seed, -1, 1);
        if (draw(&seed) & 1)
            number = -number;
    }
    return number;
}

void FILL(HdProbeBatch *batch, uint64_t start) {
    static void (*const kinds[])(Tuple *, uint64_t) = {fill_any,      fill_special, fill_sum,
                                                       fill_quotient, fill_root,    fill_small,
                                                       fill_whole,    fill_sum};
    enum { KINDS = sizeof kinds / sizeof *kinds };
    real *a = batch->operands[0], *b = batch->operands[1], *c = batch->operands[2];
    for (int i = 0; i < batch->count; i++) {
        uint64_t number = start + (uint64_t)i;
        Tuple tuple;
        void (*fill)(Tuple *, uint64_t) = kinds[number % KINDS];
        fill(&tuple, fill == fill_special ? number / KINDS : mix(number));
        a[i] = tuple.a;
        b[i] = tuple.b;
        c[i] = tuple.c;
        batch->bits[i] = draw_integer(mix(~number));
    }
}

/* ---- results of plain C ---- */

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
    NUMBER(unfused, product + c);
    NUMBER(unfused_from, c - product);
    NUMBER(in_order, sum + c);
    NUMBER(lost, sum - a);
    NUMBER(nothing, a - a);
    NUMBER(plus_zero, a + R(0.0));
}

static void expect_selection(real a, real b, real c, size_t stride, real *numbers,
                             int64_t *integers) {
    NUMBER(absolute, SIZE(a));
    NUMBER(vmin, a < b ? a : b);
    NUMBER(vmax, b < a ? a : b);
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
