/* SPDX-License-Identifier: MIT */
/* The dialect of the kernels (kernels/common/dialect.h) in C. */
#ifndef HD_CPU_DIALECT_H
#define HD_CPU_DIALECT_H

#include "kernels/host/language.h"

#include "kernels/common/real.h"

#if HD_DOUBLE
#define HD_FMA_SCALAR  __builtin_fma
#define HD_SQRT_SCALAR __builtin_sqrt
#else
#define HD_FMA_SCALAR  __builtin_fmaf
#define HD_SQRT_SCALAR __builtin_sqrtf
#endif

#if HD_LANES == 1

#include "kernels/common/one_lane.h"

FN vbits bits_of(vreal a) {
    vbits b;
    __builtin_memcpy(&b, &a, sizeof b);
    return b;
}
FN vreal from_bits(vbits a) {
    vreal b;
    __builtin_memcpy(&b, &a, sizeof b);
    return b;
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return HD_FMA_SCALAR(a, b, c);
}
FN vreal built_in_root(vreal a) {
    return HD_SQRT_SCALAR(a);
}

#elif defined(__AVX512DQ__) && HD_LANES * (HD_DOUBLE + 1) == 16

#include "cpu/bundles_avx512.h"

#else

#include "cpu/bundles.h"

#include "kernels/common/wide_masks.h"

/* Neither compiler has multiply_add, square_root and any_lane for vectors: instructions where the
   width is the machine's, lane by lane elsewhere. */
#if defined(__AVX2__) && defined(__FMA__) && HD_LANES * (HD_DOUBLE + 1) <= 8
#include "cpu/bundles_avx2.h"
#else
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    vreal r;
    for (int lane = 0; lane < HD_LANES; lane++)
        r[lane] = HD_FMA_SCALAR(a[lane], b[lane], c[lane]);
    return r;
}
FN vreal built_in_root(vreal a) {
    vreal r;
    for (int lane = 0; lane < HD_LANES; lane++)
        r[lane] = HD_SQRT_SCALAR(a[lane]);
    return r;
}
FN int any_lane(vmask m) {
    real_bits joined = 0;
    for (int lane = 0; lane < HD_LANES; lane++)
        joined |= m[lane];
    return joined != 0;
}
#endif

#ifndef HD_OWN_PICK
FN vreal pick(vmask m, vreal a, vreal b) {
    return (vreal)((m & (vmask)a) | (~m & (vmask)b));
}
FN vint pick_int(vmask m, vint a, vint b) {
    return (m & a) | (~m & b);
}
#endif

#endif

FN vreal absolute(vreal a) {
    return from_bits(bits_of(a) & ~bits_of(splat(R(-0.0))));
}
FN int lowest_bit(uint bits) {
    return __builtin_ctz(bits);
}
FN int count_bits(uint bits) {
    return __builtin_popcount(bits);
}
#define HD_OWN_PREFETCH
FN void prefetch_bytes(const char *from, int count) {
    enum { CACHE_LINE = 64 };
    for (int i = 0; i < count; i += CACHE_LINE)
        __builtin_prefetch(from + i);
}

#endif
