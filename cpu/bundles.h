/* SPDX-License-Identifier: MIT */
/* Bundles of several lanes in C, by the vector extension of GCC and Clang: their types, and what
   of the kernels' dialect (kernels/common/dialect.h) depends on no instruction set. */
#ifndef HD_CPU_BUNDLES_H
#define HD_CPU_BUNDLES_H

#include "kernels/host/language.h"

#include "kernels/common/real.h"

#if HD_DOUBLE
typedef int64_t real_bits;
#else
typedef int32_t real_bits;
#endif
typedef real vreal __attribute__((vector_size(HD_LANES * sizeof(real))));
typedef real_bits vint __attribute__((vector_size(HD_LANES * sizeof(real))));
typedef int64_t vfix __attribute__((vector_size(HD_LANES * 8)));
typedef vint vbits;

/* Compilers are not to see through the array: they take its numbers from where it has them. */
#define HD_KEEP_IN_MEMORY(array) __asm__("" : "+m"(array))

FN vreal splat(real a) {
    return a - (vreal){0};
}
FN vint splat_int(int a) {
    return (real_bits)a - (vint){0};
}
FN vbits splat_bits(real_bits a) {
    return a - (vbits){0};
}
FN vbits bits_of(vreal a) {
    return (vbits)a;
}
FN vreal from_bits(vbits a) {
    return (vreal)a;
}
FN real lane_real(const vreal *a, int lane) {
    return (*a)[lane];
}
FN int lane_int(const vint *a, int lane) {
    return (int)(*a)[lane];
}
FN fixed64 lane_fix(const vfix *a, int lane) {
    return (*a)[lane];
}
FN void set_lane_int(vint *a, int lane, int value) {
    (*a)[lane] = value;
}
FN vint to_int(vreal a) {
    return __builtin_convertvector(a, vint);
}
FN vreal to_real(vint a) {
    return __builtin_convertvector(a, vreal);
}
FN vfix truncate_to_fix(vreal a) {
    return __builtin_convertvector(a, vfix);
}
FN vreal load_reals(const real *from) {
    vreal a;
    __builtin_memcpy(&a, from, sizeof a);
    return a;
}
FN vreal gather_reals(const real *from) {
    return load_reals(from);
}
FN vint load_ints(const int *from) {
    int32_t a __attribute__((vector_size(HD_LANES * 4)));
    __builtin_memcpy(&a, from, sizeof a);
    return __builtin_convertvector(a, vint);
}

#endif
