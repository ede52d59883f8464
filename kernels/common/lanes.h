/* SPDX-License-Identifier: MIT */
/* The part of the contract (dialect.h) that is the same in all languages: packets of one lane,
   masks of vectors that compare by operators, and rows. A dialect with more lanes defines its types
   first, and HD_OWN_MASKS if its masks differ. */
#ifndef HD_LANES_H
#define HD_LANES_H

#include "real.h"

#if HD_LANES == 1

typedef real vreal;
typedef fixed64 vfix;
typedef int vint;
typedef int vmask;
#if HD_DOUBLE
typedef fixed64 real_bits;
#else
typedef int real_bits;
#endif
typedef real_bits vbits;

FN vreal splat(real a) {
    return a;
}
FN vbits splat_bits(real_bits a) {
    return a;
}
FN vint splat_int(int a) {
    return a;
}
FN vmask lt(vreal a, vreal b) {
    return a < b ? -1 : 0;
}
FN vmask le(vreal a, vreal b) {
    return a <= b ? -1 : 0;
}
FN vmask eq_int(vint a, vint b) {
    return a == b ? -1 : 0;
}
FN vmask lt_int(vint a, vint b) {
    return a < b ? -1 : 0;
}
FN vreal vselect(vmask m, vreal a, vreal b) {
    return m ? a : b;
}
FN vint vselect_int(vmask m, vint a, vint b) {
    return m ? a : b;
}
FN int any_lane(vmask m) {
    return m != 0;
}
FN real lane_real(const vreal *a, int lane) {
    (void)lane;
    return *a;
}
FN int lane_int(const vint *a, int lane) {
    (void)lane;
    return *a;
}
FN fixed64 lane_fix(const vfix *a, int lane) {
    (void)lane;
    return *a;
}
FN void set_lane_int(vint *a, int lane, int value) {
    (void)lane;
    *a = value;
}
FN vint to_int(vreal a) {
    return (int)a;
}
FN vreal to_real(vint a) {
    return (real)a;
}
FN vfix truncate_to_fix(vreal a) {
    return (vfix)a;
}
FN vreal gather_reals(const real *from) {
    return *from;
}
FN vreal load_reals(GLOBAL const real *from) {
    return *from;
}
FN vint load_ints(GLOBAL const int *from) {
    return *from;
}

#elif !defined(HD_OWN_MASKS)

typedef vint vmask;

FN vmask lt(vreal a, vreal b) {
    return a < b;
}
FN vmask le(vreal a, vreal b) {
    return a <= b;
}
FN vmask eq_int(vint a, vint b) {
    return a == b;
}
FN vmask lt_int(vint a, vint b) {
    return a < b;
}

#endif

/* Four consecutive numbers of a table, for each lane. */
typedef struct {
    vint word[4];
} FourWords;

typedef struct {
    vreal number[4];
} FourReals;

#endif
