/* SPDX-License-Identifier: MIT */
/* Bundles that fill a register of 256 bits, or of 128, where processors have AVX2 and FMA. */
#ifndef HD_CPU_BUNDLES_AVX2_H
#define HD_CPU_BUNDLES_AVX2_H

#include <immintrin.h>

#include "cpu/bundles.h"

#if HD_LANES == 4 && !HD_DOUBLE

FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return (vreal)_mm_fmadd_ps((__m128)a, (__m128)b, (__m128)c);
}
FN vreal built_in_root(vreal a) {
    return (vreal)_mm_sqrt_ps((__m128)a);
}
FN int any_lane(vint m) {
    return _mm_movemask_ps((__m128)m) != 0;
}

#else

#if HD_DOUBLE
typedef __m256d Reals256;
#define HD_REALS_256(name) _mm256_##name##_pd
#else
typedef __m256 Reals256;
#define HD_REALS_256(name) _mm256_##name##_ps
#define HD_OWN_LANE_BITS
FN uint lane_bits(vint m) {
    return (uint)_mm256_movemask_ps((__m256)m);
}
#endif

FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return (vreal)HD_REALS_256(fmadd)((Reals256)a, (Reals256)b, (Reals256)c);
}
FN vreal built_in_root(vreal a) {
    return (vreal)HD_REALS_256(sqrt)((Reals256)a);
}
FN int any_lane(vint m) {
    return HD_REALS_256(movemask)((Reals256)m) != 0;
}

#define HD_OWN_LESSER
FN vreal lesser(vreal a, vreal b) {
    return (vreal)HD_REALS_256(min)((Reals256)a, (Reals256)b);
}
FN vreal greater(vreal a, vreal b) {
    return (vreal)HD_REALS_256(max)((Reals256)a, (Reals256)b);
}

#endif

#endif
