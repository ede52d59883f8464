/* SPDX-License-Identifier: MIT */
/* The arithmetic probe: applies every primitive of the dialect to each tuple of operands, so that a
   host can compare the results with its own (docs/numerics.md). */
#ifndef HD_PROBE_H
#define HD_PROBE_H

#include "division.h"
#include "kernel_arguments.h"

#define PROBE_NAME(name, words) PROBE_##name,
enum { HD_PROBE_NUMBERS(PROBE_NAME) PROBE_NUMBER_COUNT };
enum { HD_PROBE_INTEGERS(PROBE_NAME) PROBE_INTEGER_COUNT };

FN void keep_number(GLOBAL real *to, int count, int primitive, vreal a) {
    for (int lane = 0; lane < HD_LANES; lane++)
        to[primitive * count + lane] = lane_real(&a, lane);
}
FN void keep_int(GLOBAL fixed64 *to, int count, int primitive, vint a) {
    for (int lane = 0; lane < HD_LANES; lane++)
        to[primitive * count + lane] = lane_int(&a, lane);
}
FN void keep_mask(GLOBAL fixed64 *to, int count, int primitive, vmask m) {
    keep_int(to, count, primitive, vselect_int(m, splat_int(1), splat_int(0)));
}

FN vreal within(vreal a, real limit) {
    return vmin(vmax(a, splat(-limit)), splat(limit));
}

FN void probe_arithmetic(vreal a, vreal b, vreal c, int count, GLOBAL real *to) {
    keep_number(to, count, PROBE_sum, a + b);
    keep_number(to, count, PROBE_difference, a - b);
    keep_number(to, count, PROBE_product, a * b);
    keep_number(to, count, PROBE_negative, -a);
    keep_number(to, count, PROBE_quotient, quotient(a, b));
    keep_number(to, count, PROBE_root, square_root(a));
    keep_number(to, count, PROBE_fused, multiply_add(a, b, c));
    keep_number(to, count, PROBE_unfused, a * b + c);
    keep_number(to, count, PROBE_unfused_from, c - a * b);
    keep_number(to, count, PROBE_in_order, (a + b) + c);
    keep_number(to, count, PROBE_lost, (a + b) - a);
    keep_number(to, count, PROBE_nothing, a - a);
    keep_number(to, count, PROBE_plus_zero, a + splat(R(0.0)));
}

FN void probe_selection(vreal a, vreal b, vreal c, int count, GLOBAL real *to,
                        GLOBAL fixed64 *integers) {
    keep_number(to, count, PROBE_absolute, absolute(a));
    keep_number(to, count, PROBE_vmin, vmin(a, b));
    keep_number(to, count, PROBE_vmax, vmax(a, b));
    keep_number(to, count, PROBE_signed, times_sign_of(a, b));
    keep_number(to, count, PROBE_picked, vselect(le(a, b), c, a));
    keep_mask(integers, count, PROBE_less, lt(a, b));
    keep_mask(integers, count, PROBE_less_equal, le(a, b));
    keep_mask(integers, count, PROBE_is_number, le(a, a));
}

FN void probe_conversions(vreal a, vint n, int count, GLOBAL real *to, GLOBAL fixed64 *integers) {
    vint whole = to_int(within(a, R(1073741824.0)));
    vfix fixed = truncate_to_fix(within(a, R(4611686018427387904.0)));
    keep_number(to, count, PROBE_of_int, to_real(n));
    keep_int(integers, count, PROBE_to_int, whole);
    keep_int(integers, count, PROBE_int_order, min_int(n, whole));
    keep_int(integers, count, PROBE_shifted, n >> 5);
    for (int lane = 0; lane < HD_LANES; lane++)
        integers[PROBE_to_fixed * count + lane] = lane_fix(&fixed, lane);
}

/* Probes the scalar primitives with one tuple. */
FN void probe_scalars(fixed64 x, int count, GLOBAL real *to, GLOBAL fixed64 *integers) {
    uint n = (uint)x;
    to[PROBE_of_fixed * count] = (real)x;
    integers[PROBE_fixed_sum * count] = (fixed64)((uint64)x + (uint64)(x >> 7));
    integers[PROBE_lowest_bit * count] = lowest_bit(n | (uint)1 << 31);
    integers[PROBE_bit_count * count] = count_bits(n);
}

FN void probe_atomics(fixed64 x, int place, GLOBAL fixed64 *sums, GLOBAL uint *counters) {
#if HD_GROUP_SIZE
    add_shared(&sums[place % HD_PROBE_SUMS], x);
    take_shared(&counters[place % HD_PROBE_COUNTERS], (uint)x & 0xffff);
#else
    (void)x, (void)place, (void)sums, (void)counters;
#endif
}

/* Probes one worker's share of the tuples. */
FN void probe_tuples(GLOBAL const real *first, GLOBAL const real *second, GLOBAL const real *third,
                     GLOBAL const fixed64 *bits, int count, GLOBAL real *numbers,
                     GLOBAL fixed64 *integers, GLOBAL fixed64 *sums, GLOBAL uint *counters,
                     int worker, int workers) {
    for (int i = worker * HD_LANES; i < count; i += workers * HD_LANES) {
        vreal a = load_reals(first + i), b = load_reals(second + i), c = load_reals(third + i);
        vint n = splat_int(0);
        for (int lane = 0; lane < HD_LANES; lane++) {
            set_lane_int(&n, lane, (int)(uint)bits[i + lane]);
            probe_scalars(bits[i + lane], count, numbers + i + lane, integers + i + lane);
            probe_atomics(bits[i + lane], i + lane, sums, counters);
        }
        probe_arithmetic(a, b, c, count, numbers + i);
        probe_selection(a, b, c, count, numbers + i, integers + i);
        probe_conversions(a, n, count, numbers + i, integers + i);
    }
}

#endif
