/* SPDX-License-Identifier: MIT */
/* The dialect of the kernels (../common/dialect.h) in OpenCL C 1.2. */
#ifndef HD_OPENCL_DIALECT_H
#define HD_OPENCL_DIALECT_H

#if HD_STRICT
#pragma OPENCL FP_CONTRACT OFF
#endif
#if HD_DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#define FN          static inline
#define FN_NOINLINE static
#define GLOBAL      __global
#define LOCAL       __local
#define BARRIER()   barrier(CLK_LOCAL_MEM_FENCE)
#define RESTRICT    restrict
#define ALIGNED_16  __attribute__((aligned(16)))
typedef ulong uint64;
typedef long fixed64;

#include "../common/real.h"

#if HD_LANES == 1

#define HD_WIDE(name) name

#else

#define HD_WIDE(name) HD_PASTE(name, HD_LANES)

#if HD_DOUBLE
typedef HD_WIDE(double) vreal;
typedef HD_WIDE(long) vint;
typedef long real_bits;
#define HD_CONVERT_INT  HD_WIDE(convert_long)
#define HD_CONVERT_REAL HD_WIDE(convert_double)
#else
typedef HD_WIDE(float) vreal;
typedef HD_WIDE(int) vint;
typedef int real_bits;
#define HD_CONVERT_INT  HD_WIDE(convert_int)
#define HD_CONVERT_REAL HD_WIDE(convert_float)
#endif
typedef vint vbits;
typedef HD_WIDE(long) vfix;

#if defined(__clang__) && defined(__AVX512DQ__) && HD_LANES * (HD_DOUBLE + 1) == 16
/* Clang may remove builtins. */
#if HD_DOUBLE
#if __has_builtin(__builtin_ia32_cmppd512_mask) && __has_builtin(__builtin_ia32_selectpd_512) &&   \
    __has_builtin(__builtin_ia32_cmpq512_mask) && __has_builtin(__builtin_ia32_selectq_512)
#define HD_OWN_MASKS
#endif
#elif __has_builtin(__builtin_ia32_cmpps512_mask) && __has_builtin(__builtin_ia32_selectps_512) && \
    __has_builtin(__builtin_ia32_cmpd512_mask) && __has_builtin(__builtin_ia32_selectd_512)
#define HD_OWN_MASKS
#endif
#endif
#endif

#include "../common/lanes.h"

#if HD_LANES > 1

FN vreal splat(real a) {
    return (vreal)(a);
}
FN vbits splat_bits(real_bits a) {
    return (vbits)(a);
}
FN vint splat_int(int a) {
    return (vint)(a);
}

#ifdef HD_OWN_MASKS
/* Masks of packets that fill a register of 512 bits have a bit for each lane, as in plain C. Clang
   keeps integer masks in vector registers rather than mask registers. */
#if HD_DOUBLE
typedef uchar vmask;
#define HD_COMPARE_REALS(a, b, how) __builtin_ia32_cmppd512_mask(a, b, how, 0xff, 4)
#define HD_COMPARE_INTS(a, b, how)  __builtin_ia32_cmpq512_mask(a, b, how, 0xff)
#define HD_SELECT_REALS             __builtin_ia32_selectpd_512
#define HD_SELECT_INTS              __builtin_ia32_selectq_512
#else
typedef ushort vmask;
#define HD_COMPARE_REALS(a, b, how) __builtin_ia32_cmpps512_mask(a, b, how, 0xffff, 4)
#define HD_COMPARE_INTS(a, b, how)  __builtin_ia32_cmpd512_mask(a, b, how, 0xffff)
#define HD_SELECT_REALS             __builtin_ia32_selectps_512
#define HD_SELECT_INTS              __builtin_ia32_selectd_512
#endif
enum { REALS_LESS = 17, REALS_LESS_EQUAL = 18, INTS_EQUAL = 0, INTS_LESS = 1 };

FN vmask lt(vreal a, vreal b) {
    return HD_COMPARE_REALS(a, b, REALS_LESS);
}
FN vmask le(vreal a, vreal b) {
    return HD_COMPARE_REALS(a, b, REALS_LESS_EQUAL);
}
FN vmask eq_int(vint a, vint b) {
    return HD_COMPARE_INTS(a, b, INTS_EQUAL);
}
FN vmask lt_int(vint a, vint b) {
    return HD_COMPARE_INTS(a, b, INTS_LESS);
}
FN vreal vselect(vmask m, vreal a, vreal b) {
    return HD_SELECT_REALS(m, a, b);
}
FN vint vselect_int(vmask m, vint a, vint b) {
    return HD_SELECT_INTS(m, a, b);
}
FN int any_lane(vmask m) {
    return m != 0;
}

FN vmask mask_none(void) {
    return 0;
}
FN vmask mask_all(void) {
    return (vmask)-1;
}
FN int first_lane(vmask m) {
    return 31 - (int)clz((uint)m & (0u - m));
}

#define HD_OWN_LANE_BITS
FN uint lane_bits(vmask m) {
    return m;
}
#else
FN vreal vselect(vmask m, vreal a, vreal b) {
    return select(b, a, m);
}
FN vint vselect_int(vmask m, vint a, vint b) {
    return select(b, a, m);
}
/* any() is slow in CPU drivers. Clang's reduction of a comparison becomes a test of a mask
   register; without it, each lane becomes a byte. */
#ifdef __has_builtin
#if __has_builtin(__builtin_reduce_or)
#define HD_REDUCES
#endif
#endif
#ifdef HD_REDUCES
FN int any_lane(vmask m) {
    return __builtin_reduce_or(m != 0) != 0;
}
#elif HD_LANES == 16
FN int any_lane(vmask m) {
    ulong2 bytes = as_ulong2(convert_char16(m));
    return (bytes.x | bytes.y) != 0;
}
#elif HD_LANES == 8
FN int any_lane(vmask m) {
    return as_ulong(convert_char8(m)) != 0;
}
#else
FN int any_lane(vmask m) {
    return as_int(convert_char4(m)) != 0;
}
#endif
#endif
FN real lane_real(const vreal *a, int lane) {
    return ((const real *)a)[lane];
}
FN int lane_int(const vint *a, int lane) {
    return (int)((const real_bits *)a)[lane];
}
FN fixed64 lane_fix(const vfix *a, int lane) {
    return ((const fixed64 *)a)[lane];
}
FN void set_lane_int(vint *a, int lane, int value) {
    ((real_bits *)a)[lane] = value;
}
FN vint to_int(vreal a) {
    return HD_CONVERT_INT(a);
}
FN vreal to_real(vint a) {
    return HD_CONVERT_REAL(a);
}
FN vfix truncate_to_fix(vreal a) {
    return HD_WIDE(convert_long)(a);
}
FN vreal gather_reals(const real *from) {
    return HD_WIDE(vload)(0, from);
}
FN vreal load_reals(GLOBAL const real *from) {
    return HD_WIDE(vload)(0, from);
}
FN vint load_ints(GLOBAL const int *from) {
    return HD_CONVERT_INT(HD_WIDE(vload)(0, from));
}

#endif

#if HD_LANES > 1 && !HD_DOUBLE
#define HD_OWN_ROWS
/* Returns 16 ints: the row of `lane`, then of the three lanes after it. A row is four
   consecutive ints that begin at table[index of the lane]; `index` counts ints, and any
   alignment will do. Column 0 of the four rows is .even.even, 1 is .odd.even, 2 is .even.odd, 3
   is .odd.odd. Vectors, because PoCL turns writes to single lanes (set_lane_int) into scattered
   stores. */
FN int16 load_four_rows(GLOBAL const int *table, vint index, int lane) {
    return (int16)(vload4(0, table + lane_int(&index, lane)),
                   vload4(0, table + lane_int(&index, lane + 1)),
                   vload4(0, table + lane_int(&index, lane + 2)),
                   vload4(0, table + lane_int(&index, lane + 3)));
}
#if HD_LANES == 4
#define HD_OF_ROWS(part) a.part
#elif HD_LANES == 8
#define HD_OF_ROWS(part) (int8)(a.part, b.part)
#else
#define HD_OF_ROWS(part) (int16)(a.part, b.part, c.part, d.part)
#endif
FN FourWords fetch_four_words(GLOBAL const uint *table, vint index) {
    GLOBAL const int *words = (GLOBAL const int *)table;
    FourWords found;
    int16 a = load_four_rows(words, index, 0);
#if HD_LANES >= 8
    int16 b = load_four_rows(words, index, 4);
#endif
#if HD_LANES == 16
    int16 c = load_four_rows(words, index, 8), d = load_four_rows(words, index, 12);
#endif
    found.word[0] = HD_OF_ROWS(even.even);
    found.word[1] = HD_OF_ROWS(odd.even);
    found.word[2] = HD_OF_ROWS(even.odd);
    found.word[3] = HD_OF_ROWS(odd.odd);
    return found;
}
#endif

#if HD_DOUBLE
#define HD_AS_BITS HD_WIDE(as_long)
#define HD_AS_REAL HD_WIDE(as_double)
#else
#define HD_AS_BITS HD_WIDE(as_int)
#define HD_AS_REAL HD_WIDE(as_float)
#endif

FN vbits bits_of(vreal a) {
    return HD_AS_BITS(a);
}
FN vreal from_bits(vbits a) {
    return HD_AS_REAL(a);
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return fma(a, b, c);
}
FN vreal built_in_root(vreal a) {
    return sqrt(a);
}
FN vreal absolute(vreal a) {
    return fabs(a);
}
FN int lowest_bit(uint bits) {
    return 31 - (int)clz(bits & (0u - bits));
}
FN int count_bits(uint bits) {
    return (int)popcount(bits);
}

#if HD_GROUP_SIZE
#ifdef cl_khr_int64_base_atomics
#pragma OPENCL EXTENSION cl_khr_int64_base_atomics : enable
FN void add_shared(GLOBAL fixed64 *sum, fixed64 amount) {
    atom_add(sum, amount);
}
#endif
FN uint take_shared(GLOBAL uint *counter, uint amount) {
    return atomic_add(counter, amount);
}
#endif

#endif
