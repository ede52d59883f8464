/* SPDX-License-Identifier: MIT */
/* The dialect of the shared kernels: the contract that each language fulfils, and functions built
   on it. Kernel text is written for a packet of HD_LANES lanes: a scalar with one lane, otherwise a
   vector of the language. docs/development/dialect.md is the manual.

   A language defines in the dialect.h next to its entry points (kernels/cuda, kernels/opencl, cpu):

   words    FN begins every function (static and inlined); FN_NOINLINE a function that stays out of
            line if that helps. GLOBAL and LOCAL precede the type of a pointer to a table or to
            memory of a group. RESTRICT, ALIGNED_16. BARRIER() waits for the group, if any.
   scalars  uint, uint64 and fixed64 of 32, 64 and 64 bits; real_bits: an integer as wide as real
   packets  vreal of real; vint: int, or with several lanes integers as wide as real, to be used as
            if they had 32 bits; vmask: opaque, 0 or -1 in each lane, or a bit for each; vfix of
            fixed64; vbits of real_bits

   Operators + - * and, on integers and masks, & | ^ ~ >> work on packets as on scalars; a vreal may
   be combined with a scalar real. Everything else is a function, also division, which in strict
   builds is correctly rounded like the rest. Each language defines:

   splat(a), splat_int(a)         the same value in every lane
   lt(a, b), le(a, b)             mask of a < b, a <= b; false if either is NaN
   eq_int(a, b), lt_int(a, b)     masks of integers
   vselect(m, a, b), vselect_int  a if m is set, else b, bit for bit; both are evaluated
   any_lane(m)                    non-zero if a lane of m is set
   lane_real(&a, i), lane_int, lane_fix    read one lane; not of a mask
   set_lane_int(&a, i, x)         writes one lane
   multiply_add(a, b, c)          a * b + c with one rounding
   built_in_root(a)               the language's square root; kernels call square_root(a), and
                                  quotient(a, b)
   absolute(a)                    without its sign
   to_int(a)                      truncates; a must be within the range of int: clamp first
   to_real(a)                     integer to real, rounded to nearest
   truncate_to_fix(a)             truncates to 64 bits; a must be within range
   bits_of(a), from_bits(b)       a vreal as integers and back, bit for bit
   splat_bits(x)                  the same integer in every lane
   lowest_bit(u), count_bits(u)   number of the lowest set bit, not for 0; count of set bits
   load_reals(p), load_ints(p)    as many consecutive numbers as lanes, at any alignment
   gather_reals(p)                likewise of a private array
   add_shared(p, x)               with HD_GROUP_SIZE: adds to a fixed64 that all groups share
   take_shared(p, n)              likewise: adds to a counter, returns its previous value

   A dialect that knows registers may define better forms of the functions below itself, together
   with the HD_OWN_... that this file tests. Both forms give the same bits. It may define
   UNROLL_TWICE for loops that need too many registers if they are unrolled further. */
#ifndef HD_DIALECT_H
#define HD_DIALECT_H

#include "lanes.h"

#ifndef UNROLL_TWICE
#define UNROLL_TWICE
#endif

/* ---- masks ---- */

#ifndef HD_OWN_MASKS
FN vmask mask_none(void) {
    return splat_int(0);
}
FN vmask mask_all(void) {
    return splat_int(-1);
}

/* Returns the first lane that is set; requires any_lane(m). */
FN int first_lane(vmask m) {
#ifdef HD_OWN_LANE_BITS
    return lowest_bit(lane_bits(m));
#else
    int lane = 0;
    while (lane < HD_LANES - 1 && !lane_int(&m, lane))
        lane++;
    return lane;
#endif
}
#endif

FN vmask vselect_mask(vmask m, vmask a, vmask b) {
    return (m & a) | (~m & b);
}

/* Returns a bit for each lane of a mask, the first lane in the lowest bit. */
#ifndef HD_OWN_LANE_BITS
FN uint lane_bits(vmask m) {
    vint chosen = vselect_int(m, splat_int(1), splat_int(0));
    uint bits = 0;
    for (int lane = 0; lane < HD_LANES; lane++)
        bits |= (uint)lane_int(&chosen, lane) << lane;
    return bits;
}
#endif

/* Returns `left` without `done`, which contains its first lane. With one lane it returns none, so
   that compilers remove loops over groups of lanes. */
FN vmask lanes_after(vmask left, vmask done) {
#if HD_LANES == 1
    (void)left, (void)done;
    return mask_none();
#else
    return left & ~done;
#endif
}

/* Returns whether to do work that only some threads need. GPUs always do it: it is free if other
   threads of the warp need it, and each nested branch costs a barrier (docs/lost-light.md). */
FN int must_enter(int needed) {
#if HD_GROUP_SIZE
    (void)needed;
    return 1;
#else
    return needed;
#endif
}

/* Likewise for work that only the lanes of `m` need. */
FN int must_visit(vmask m) {
    return must_enter(any_lane(m));
}

/* Returns `counts`, one more in the lanes of `m`. */
FN vint count_lanes(vint counts, vmask m) {
    return counts + vselect_int(m, splat_int(1), splat_int(0));
}

/* Returns the sum of all lanes. */
#ifndef HD_OWN_SUM_LANES
FN fixed64 sum_lanes(vint a) {
    fixed64 sum = 0;
    for (int lane = 0; lane < HD_LANES; lane++)
        sum += lane_int(&a, lane);
    return sum;
}
#endif

/* Returns 0, 1, 2, ... */
FN vint lane_numbers(void) {
    vint numbers = splat_int(0);
    for (int lane = 0; lane < HD_LANES; lane++)
        set_lane_int(&numbers, lane, lane);
    return numbers;
}

/* Returns the mask of the first `count` lanes. */
FN vmask lanes_below(int count) {
    return lt_int(lane_numbers(), splat_int(count));
}

/* ---- minimum, maximum, signs ---- */

/* Selects, since vendors' min and max differ for NaN and -0. If a is NaN or both are 0 the result
   is b, as in x86's instructions. */
#ifndef HD_OWN_MIN_MAX
FN vreal vmin(vreal a, vreal b) {
    return vselect(lt(a, b), a, b);
}
FN vreal vmax(vreal a, vreal b) {
    return vselect(lt(b, a), a, b);
}
#endif

FN vint min_int(vint a, vint b) {
    return vselect_int(lt_int(a, b), a, b);
}
FN vint max_int(vint a, vint b) {
    return vselect_int(lt_int(b, a), a, b);
}

/* Returns `a`, negated in the lanes whose `sign` is negative. */
FN vreal times_sign_of(vreal a, vreal sign) {
    return from_bits(bits_of(a) ^ (bits_of(sign) & bits_of(splat(R(-0.0)))));
}

/* Return the minimum and maximum of the lanes of `m`; any_lane(m), and all are finite. */
#ifndef HD_OWN_MIN_LANE
FN real min_lane(vreal a, vmask m) {
    vreal kept = vselect(m, a, splat(REAL_LARGE));
    real least = lane_real(&kept, 0);
    for (int lane = 1; lane < HD_LANES; lane++) {
        real other = lane_real(&kept, lane);
        least = other < least ? other : least;
    }
    return least;
}
FN real max_lane(vreal a, vmask m) {
    return -min_lane(-a, m);
}
#endif

/* ---- memory ---- */

#ifndef HD_OWN_ROWS
/* Returns table[index] to table[index + 3] for each lane. */
FN FourWords fetch_four_words(GLOBAL const uint *table, vint index) {
    FourWords words;
    for (int i = 0; i < 4; i++)
        words.word[i] = splat_int(0);
    for (int lane = 0; lane < HD_LANES; lane++) {
        GLOBAL const uint *row = table + lane_int(&index, lane);
        for (int i = 0; i < 4; i++)
            set_lane_int(&words.word[i], lane, (int)row[i]);
    }
    return words;
}

/* Likewise for reals. */
FN FourReals fetch_four_reals(GLOBAL const real *table, vint index) {
    real rows[4][HD_LANES];
    FourReals reals;
    for (int lane = 0; lane < HD_LANES; lane++) {
        GLOBAL const real *row = table + lane_int(&index, lane);
        for (int i = 0; i < 4; i++)
            rows[i][lane] = row[i];
    }
    for (int i = 0; i < 4; i++)
        reals.number[i] = gather_reals(rows[i]);
    return reals;
}

#elif !HD_DOUBLE
FN FourReals fetch_four_reals(GLOBAL const real *table, vint index) {
    FourWords words = fetch_four_words((GLOBAL const uint *)table, index);
    FourReals reals;
    for (int i = 0; i < 4; i++)
        reals.number[i] = from_bits(words.word[i]);
    return reals;
}
#endif

/* Does the same for the first `count` lanes; the others are undefined. */
#ifndef HD_OWN_LOAD_ROWS
FN FourReals load_rows(GLOBAL const real *table, vint index, int count) {
    (void)count;
    return fetch_four_reals(table, index);
}
#endif

/* Prefetches memory, if the processor can. */
#ifndef HD_OWN_PREFETCH
FN void prefetch_bytes(GLOBAL const char *from, int count) {
    (void)from;
    (void)count;
}
#endif

/* Computes each lane's place when the lanes of `m` are stored contiguously; returns their count. */
FN int lane_offsets(vmask m, int offset[HD_LANES]) {
    vint chosen = vselect_int(m, splat_int(1), splat_int(0));
    int count = 0;
    for (int lane = 0; lane < HD_LANES; lane++) {
        offset[lane] = count;
        count += lane_int(&chosen, lane);
    }
    return count;
}

/* Stores lanes at these offsets; may overwrite up to a packet. */
#ifndef HD_OWN_STORE_LANES
FN void store_lanes(GLOBAL real *to, vmask m, const int offset[HD_LANES], const vreal *a) {
    (void)m;
    for (int lane = 0; lane < HD_LANES; lane++)
        to[offset[lane]] = lane_real(a, lane);
}
#endif
FN void store_lanes_int(GLOBAL int *to, const int offset[HD_LANES], const vint *a) {
    for (int lane = 0; lane < HD_LANES; lane++)
        to[offset[lane]] = lane_int(a, lane);
}

/* Returns whether no thread of the warp that gets here together has a higher number; 0 <= number <
   limit. */
#ifndef HD_OWN_HIGHEST
FN int is_highest_of_warp(int number, int limit) {
    (void)number;
    (void)limit;
    return 1;
}
#endif

/* Adds to memory that threads share. Without groups (HD_GROUP_SIZE is 0) each thread has its own
   memory, so a plain addition does. */
#if !HD_GROUP_SIZE
FN void add_shared(GLOBAL fixed64 *sum, fixed64 amount) {
    *sum += amount;
}
#endif

#endif
