/* SPDX-License-Identifier: MIT */
/* Bundles that fill a register of 256 bits, or of 128, where processors have AVX2 and FMA. */
#ifndef HD_CPU_BUNDLES_AVX2_H
#define HD_CPU_BUNDLES_AVX2_H

#include <immintrin.h>

#include "cpu/bundles.h"

#include "kernels/common/rows.h"

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
#endif

FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return (vreal)HD_REALS_256(fmadd)((Reals256)a, (Reals256)b, (Reals256)c);
}
FN vreal built_in_root(vreal a) {
    return (vreal)HD_REALS_256(sqrt)((Reals256)a);
}
#define HD_OWN_LANE_BITS
FN uint lane_bits(vint m) {
    return (uint)HD_REALS_256(movemask)((Reals256)m);
}
FN int any_lane(vint m) {
    return lane_bits(m) != 0;
}

#define HD_OWN_PICK
FN vreal pick(vint m, vreal a, vreal b) {
    return (vreal)HD_REALS_256(blendv)((Reals256)b, (Reals256)a, (Reals256)m);
}
FN vint pick_int(vint m, vint a, vint b) {
    return (vint)HD_REALS_256(blendv)((Reals256)b, (Reals256)a, (Reals256)m);
}

#define HD_OWN_LESSER
FN vreal lesser(vreal a, vreal b) {
    return (vreal)HD_REALS_256(min)((Reals256)a, (Reals256)b);
}
FN vreal greater(vreal a, vreal b) {
    return (vreal)HD_REALS_256(max)((Reals256)a, (Reals256)b);
}

#if !HD_DOUBLE
#define HD_OWN_ROWS
/* Two lanes to a register; then the 4 x 4 words in each half of the registers are transposed. */
FN FourWords fetch_four_words(const uint *table, vint index) {
    __m256i row[4];
    int at[HD_LANES]; /* read one by one they are cheaper than taken out of the register */
    _mm256_storeu_si256((void *)at, (__m256i)index);
    HD_KEEP_IN_MEMORY(at);
    for (int i = 0; i < 4; i++) {
        row[i] = _mm256_castsi128_si256(_mm_loadu_si128((const void *)(table + at[i])));
        row[i] =
            _mm256_inserti128_si256(row[i], _mm_loadu_si128((const void *)(table + at[i + 4])), 1);
    }
    __m256i a = _mm256_unpacklo_epi32(row[0], row[1]), b = _mm256_unpacklo_epi32(row[2], row[3]);
    __m256i c = _mm256_unpackhi_epi32(row[0], row[1]), d = _mm256_unpackhi_epi32(row[2], row[3]);
    FourWords words;
    words.word[0] = (vint)_mm256_unpacklo_epi64(a, b);
    words.word[1] = (vint)_mm256_unpackhi_epi64(a, b);
    words.word[2] = (vint)_mm256_unpacklo_epi64(c, d);
    words.word[3] = (vint)_mm256_unpackhi_epi64(c, d);
    return words;
}

FN FourReals fetch_four_reals(const real *table, vint index) {
    FourWords words = fetch_four_words((const void *)table, index);
    FourReals reals;
    for (int i = 0; i < 4; i++)
        reals.number[i] = from_bits(words.word[i]);
    return reals;
}

FN FourReals load_rows(const real *table, vint index, int count) {
    (void)count;
    return fetch_four_reals(table, index);
}
#endif

#endif

#endif
