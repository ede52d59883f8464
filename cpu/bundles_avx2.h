/* SPDX-License-Identifier: MIT */
/* Bundles that fill a register of 256 bits, or of 128, where processors have AVX2 and FMA. */
#ifndef HD_CPU_BUNDLES_AVX2_H
#define HD_CPU_BUNDLES_AVX2_H

#include <immintrin.h>

#include "cpu/bundles.h"

#if HD_DOUBLE
typedef __m256d Reals;
#define HD_REALS(name) _mm256_##name##_pd
#elif HD_LANES == 4
typedef __m128 Reals;
#define HD_REALS(name) _mm_##name##_ps
#else
typedef __m256 Reals;
#define HD_REALS(name) _mm256_##name##_ps
#endif

FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return (vreal)HD_REALS(fmadd)((Reals)a, (Reals)b, (Reals)c);
}
FN vreal square_root(vreal a) {
    return (vreal)HD_REALS(sqrt)((Reals)a);
}
FN int any_lane(vint m) {
    return HD_REALS(movemask)((Reals)m) != 0;
}

#if HD_LANES == 8
#define HD_OWN_LANE_BITS
FN uint lane_bits(vint m) {
    return (uint)HD_REALS(movemask)((Reals)m);
}
#endif

#if HD_LANES * (HD_DOUBLE + 1) == 8
#define HD_OWN_LESSER
FN vreal lesser(vreal a, vreal b) {
    return (vreal)HD_REALS(min)((Reals)a, (Reals)b);
}
FN vreal greater(vreal a, vreal b) {
    return (vreal)HD_REALS(max)((Reals)a, (Reals)b);
}
#endif

#endif
