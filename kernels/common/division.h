/* SPDX-License-Identifier: MIT */
/* Division and roots: fast ones of positive numbers, and correctly rounded ones. Fused operations
   replace those that a device does not round correctly. They find digits within a unit of the last
   place; the exact remainder decides the rounding (docs/numerics.md has the proof). */
#ifndef HD_DIVISION_H
#define HD_DIVISION_H

#include "dialect.h"

/* Returns 1 / a of normal a > 0 whose reciprocal is normal too, within 1 unit in the last place. A
   guess by the exponent's bits (Blinn 1997, Floating-Point Tricks) and two steps of third order,
   three for doubles, cost a fraction of a division on CPUs. Not a loop: PoCL does not unroll it. */
FN vreal better_reciprocal(vreal a, vreal guess) {
    vreal error = multiply_add(-a, guess, splat(R(1.0)));
    return multiply_add(guess, multiply_add(error, error, error), guess);
}
FN vreal reciprocal(vreal a) {
#if HD_DOUBLE
    vreal guess = from_bits(splat_bits(0x7fde623822fc16e6) - bits_of(a));
    guess = better_reciprocal(a, guess);
#else
    vreal guess = from_bits(splat_bits(0x7ef311c3) - bits_of(a));
#endif
    return better_reciprocal(a, better_reciprocal(a, guess));
}

/* Returns 1 / square root of a, by steps of Halley's method, within 1.5 units in the last place. */
FN vreal better_root(vreal a, vreal guess) {
    vreal error = multiply_add(-a, guess * guess, splat(R(1.0)));
    vreal part = error * multiply_add(error, splat(R(0.375)), splat(R(0.5)));
    return multiply_add(guess, part, guess);
}
FN vreal reciprocal_root(vreal a) {
#if HD_DOUBLE
    vreal guess = from_bits(splat_bits(0x5fe6eb50c7b537a9) - (bits_of(a) >> 1));
    guess = better_root(a, guess);
#else
    vreal guess = from_bits(splat_bits(0x5f375a86) - (bits_of(a) >> 1));
#endif
    return better_root(a, better_root(a, guess));
}

/* Correctly rounded: quotient, square_root and shared_quotient, whose operands all lanes share.
   With HD_ROUNDED_BY_FMA they use fused operations in place of the device's own. */
#if HD_ROUNDED_BY_FMA

#if HD_DOUBLE
#define MANTISSA_BITS  52
#define EXPONENT_BIAS  1023
#define BITS_OF_ONE    0x3ff0000000000000
#define BITS_OF_FIRST  0x000fffffffffffff         /* of the digits */
#define BITS_OF_POWER  0x7ff0000000000000         /* of the exponent */
#define LAST_PLACE     R(2.220446049250313e-16)   /* 2^-52 */
#define MIN_NORMAL     R(2.2250738585072014e-308) /* 2^-1022 */
#define NORMALISER     R(18014398509481984.0)     /* 2^54 */
#define NORMALISER_LOG R(54.0)
#define EXPONENT_BASE  R(4503599627370496.0)      /* 2^52 */
#define INVERSE_ROOT   R(7.450580596923828125e-9) /* 2^-27, of the normaliser */
#else
#define MANTISSA_BITS  23
#define EXPONENT_BIAS  127
#define BITS_OF_ONE    0x3f800000
#define BITS_OF_FIRST  0x007fffff
#define BITS_OF_POWER  0x7f800000
#define LAST_PLACE     R(1.1920928955078125e-7)  /* 2^-23 */
#define MIN_NORMAL     R(1.1754943508222875e-38) /* 2^-126 */
#define NORMALISER     R(16777216.0)             /* 2^24 */
#define NORMALISER_LOG R(24.0)
#define EXPONENT_BASE  R(8388608.0)     /* 2^23 */
#define INVERSE_ROOT   R(2.44140625e-4) /* 2^-12 */
#endif

/* Returns 2^n of a whole n that is a normal number's exponent. */
FN vreal power_of_two(vreal n) {
    vbits field = bits_of(n + splat(EXPONENT_BASE + R(1.0) * EXPONENT_BIAS));
    return from_bits((field & splat_bits(2 * EXPONENT_BIAS + 1)) *
                     splat_bits((real_bits)1 << MANTISSA_BITS));
}

/* Splits a positive number into digits in [1, 2), which it returns, times 2^exponent. */
FN vreal split_number(vreal a, vreal *exponent) {
    vmask is_small = lt(a, splat(MIN_NORMAL));
    vbits bits = bits_of(vselect(is_small, a * splat(NORMALISER), a));
    vbits field = (bits >> MANTISSA_BITS) | bits_of(splat(EXPONENT_BASE));
    vreal above = vselect(is_small, splat(NORMALISER_LOG), splat(R(0.0)));
    *exponent = from_bits(field) - splat(EXPONENT_BASE + R(1.0) * EXPONENT_BIAS) - above;
    return from_bits((bits & splat_bits(BITS_OF_FIRST)) | splat_bits(BITS_OF_ONE));
}

/* Returns the rounded digits of a / b, in [1, 2), for a in [b, 2b) and b in [1, 2); `left` is the
   exact remainder. */
FN vreal quotient_digits(vreal a, vreal b, vreal *left) {
    vreal inverse = reciprocal(b), guess = a * inverse, step = splat(LAST_PLACE);
    vreal digits = multiply_add(multiply_add(-b, guess, a), inverse, guess);
    vreal rest = multiply_add(-b, digits, a), middle = b * splat(R(0.5) * LAST_PLACE);
    vmask is_low = lt(middle, rest), is_high = lt(rest, -middle);
    vreal up = vselect(is_low, step, vselect(is_high, -step, splat(R(0.0))));
    digits = digits + up;
    *left = multiply_add(-b, up, rest);
    return digits;
}

/* Returns `digits` * 2^exponent below the minimum normal number, rounded by the remainder's sign.
 */
FN vreal small_quotient(vreal digits, vreal left, vreal exponent) {
    vreal one = splat(R(1.0)), zero = splat(R(0.0)), step = splat(LAST_PLACE);
    vreal middle = splat(R(0.5) * LAST_PLACE);
    vreal n = exponent + splat(EXPONENT_BIAS - R(1.0));
    n = vmax(n, splat(R(-2.0) * NORMALISER_LOG));
    vreal scaled = digits * power_of_two(n);
    vreal sum = scaled + one, lost = scaled - (sum - one);
    vmask is_up = le(middle, lost) & lt(zero, left), is_down = le(lost, -middle) & lt(left, zero);
    sum = sum + vselect(is_up, step, vselect(is_down, -step, zero));
    return (sum - one) * splat(MIN_NORMAL);
}

/* Returns a / b of positive numbers, neither 0 nor infinite. */
FN vreal positive_quotient(vreal a, vreal b) {
    vreal exponent_a, exponent_b, left;
    vreal digits_a = split_number(a, &exponent_a), digits_b = split_number(b, &exponent_b);
    vmask is_less = lt(digits_a, digits_b);
    digits_a = vselect(is_less, digits_a + digits_a, digits_a);
    vreal exponent = exponent_a - exponent_b - vselect(is_less, splat(R(1.0)), splat(R(0.0)));
    vreal digits = quotient_digits(digits_a, digits_b, &left);
    vreal least = splat(R(1.0) - EXPONENT_BIAS), most = splat(R(1.0) * EXPONENT_BIAS);
    vreal kept = vmin(vmax(exponent, least), most);
    vreal beyond = vmin(exponent - kept, most);
    vreal normal = digits * power_of_two(kept) * power_of_two(vmax(beyond, splat(R(0.0))));
    return vselect(lt(exponent, least), small_quotient(digits, left, exponent), normal);
}

FN vreal quotient(vreal a, vreal b) {
    vreal zero = splat(R(0.0)), infinite = from_bits(splat_bits(BITS_OF_POWER));
    vreal nan = infinite - infinite;
    vbits sign = (bits_of(a) ^ bits_of(b)) & bits_of(splat(R(-0.0)));
    vreal size_a = absolute(a), size_b = absolute(b);
    vmask zero_a = le(size_a, zero), zero_b = le(size_b, zero);
    vmask infinite_a = le(infinite, size_a), infinite_b = le(infinite, size_b);
    vreal found = positive_quotient(size_a, size_b);
    found = vselect(zero_a | infinite_b, zero, found);
    found = vselect(zero_b | infinite_a, infinite, found);
    vmask has_any = le(size_a, infinite) & le(size_b, infinite);
    found = vselect((zero_a & zero_b) | (infinite_a & infinite_b) | ~has_any, nan, found);
    return from_bits(bits_of(found) ^ sign);
}

/* Returns the rounded root of a in [1, 4). */
FN vreal root_digits(vreal a) {
    vreal inverse = reciprocal_root(a), guess = a * inverse, step = splat(LAST_PLACE);
    vreal rest = multiply_add(-guess, guess, a);
    vreal digits = multiply_add(rest, inverse * splat(R(0.5)), guess);
    rest = multiply_add(-digits, digits, a);
    vmask is_low = lt(digits * step, rest), is_high = le(rest, -(digits * step));
    return digits + vselect(is_low, step, vselect(is_high, -step, splat(R(0.0))));
}

FN vreal square_root(vreal a) {
    vreal zero = splat(R(0.0)), infinite = from_bits(splat_bits(BITS_OF_POWER));
    vmask is_small = lt(a, splat(MIN_NORMAL));
    vreal normal = vselect(is_small, a * splat(NORMALISER), a);
    vbits power_bits = ((bits_of(normal) & splat_bits(BITS_OF_POWER)) >> 1) +
                       splat_bits((real_bits)BITS_OF_ONE >> 1);
    vreal power = from_bits(power_bits & splat_bits(BITS_OF_POWER));
    vreal inverse =
        from_bits(splat_bits(2 * (real_bits)EXPONENT_BIAS * ((real_bits)1 << MANTISSA_BITS)) -
                  (power_bits & splat_bits(BITS_OF_POWER)));
    vreal found = root_digits(normal * inverse * inverse) * power;
    found = vselect(is_small, found * splat(INVERSE_ROOT), found);
    found = vselect(lt(zero, a) & lt(a, infinite), found, a);
    return vselect(lt(a, zero), infinite - infinite, found);
}

FN real shared_quotient(real a, real b) {
    vreal found = quotient(splat(a), splat(b));
    return lane_real(&found, 0);
}
#else
FN vreal quotient(vreal a, vreal b) {
    return a / b;
}
FN vreal square_root(vreal a) {
    return built_in_root(a);
}
FN real shared_quotient(real a, real b) {
    return a / b;
}
#endif

#endif
