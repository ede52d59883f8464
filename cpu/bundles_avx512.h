/* SPDX-License-Identifier: MIT */
/* Bundles that fill a register of 512 bits; a mask has a bit for each lane. */
#ifndef HD_CPU_BUNDLES_AVX512_H
#define HD_CPU_BUNDLES_AVX512_H

#include <immintrin.h>

#include "cpu/bundles.h"

#include "kernels/common/rows.h"

typedef uint32_t vmask; /* bits above the lanes' have no meaning */
#if HD_DOUBLE
typedef __m512d Reals512;
#define HD_MASK(m)                 ((__mmask8)(m))
#define HD_REALS_512(name, ending) _mm512_##name##_pd##ending
#define HD_INTS_512(name, ending)  _mm512_##name##_epi64##ending
#else
typedef __m512 Reals512;
#define HD_MASK(m)                 ((__mmask16)(m))
#define HD_REALS_512(name, ending) _mm512_##name##_ps##ending
#define HD_INTS_512(name, ending)  _mm512_##name##_epi32##ending
#endif

FN vmask lt(vreal a, vreal b) {
    return HD_REALS_512(cmp, _mask)((Reals512)a, (Reals512)b, _CMP_LT_OQ);
}
FN vmask le(vreal a, vreal b) {
    return HD_REALS_512(cmp, _mask)((Reals512)a, (Reals512)b, _CMP_LE_OQ);
}
FN vmask eq_int(vint a, vint b) {
    return HD_INTS_512(cmpeq, _mask)((__m512i)a, (__m512i)b);
}
FN vmask lt_int(vint a, vint b) {
    return HD_INTS_512(cmplt, _mask)((__m512i)a, (__m512i)b);
}
FN vreal pick(vmask m, vreal a, vreal b) {
    return (vreal)HD_REALS_512(mask_blend, )(HD_MASK(m), (Reals512)b, (Reals512)a);
}
FN vint pick_int(vmask m, vint a, vint b) {
    return (vint)HD_INTS_512(mask_blend, )(HD_MASK(m), (__m512i)b, (__m512i)a);
}
FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return (vreal)HD_REALS_512(fmadd, )((Reals512)a, (Reals512)b, (Reals512)c);
}
FN vreal built_in_root(vreal a) {
    return (vreal)HD_REALS_512(sqrt, )((Reals512)a);
}
FN int any_lane(vmask m) {
    return HD_MASK(m) != 0;
}

#define HD_OWN_MASKS
FN vmask mask_none(void) {
    return 0;
}
FN vmask mask_all(void) {
    return HD_MASK(-1);
}
FN int first_lane(vmask m) {
    return __builtin_ctz(m);
}

#define HD_OWN_LANE_BITS
FN uint lane_bits(vmask m) {
    return HD_MASK(m);
}

#define HD_OWN_LESSER
FN vreal lesser(vreal a, vreal b) {
    return (vreal)HD_REALS_512(min, )((Reals512)a, (Reals512)b);
}
FN vreal greater(vreal a, vreal b) {
    return (vreal)HD_REALS_512(max, )((Reals512)a, (Reals512)b);
}

#define HD_OWN_LEAST_LANE
FN real least_lane(vreal a, vmask m) {
    return HD_REALS_512(mask_reduce_min, )(HD_MASK(m), (Reals512)a);
}
FN real greatest_lane(vreal a, vmask m) {
    return HD_REALS_512(mask_reduce_max, )(HD_MASK(m), (Reals512)a);
}

#define HD_OWN_STORE_LANES
FN void store_lanes(real *to, vmask m, const int offset[HD_LANES], const vreal *a) {
    (void)offset;
    HD_REALS_512(storeu, )(to, HD_REALS_512(maskz_compress, )(HD_MASK(m), (Reals512)*a));
}

#define HD_OWN_SUM_LANES
FN fixed64 sum_lanes(vint a) {
#if HD_DOUBLE
    return _mm512_reduce_add_epi64((__m512i)a);
#else
    __m512i low = _mm512_cvtepi32_epi64(_mm512_castsi512_si256((__m512i)a));
    __m512i high = _mm512_cvtepi32_epi64(_mm512_extracti64x4_epi64((__m512i)a, 1));
    return _mm512_reduce_add_epi64(low + high);
#endif
}

#if !HD_DOUBLE
#define HD_OWN_ROWS
/* Of the 4 x 4 words in each quarter of the registers. */
FN FourWords transpose_quarters(const __m512i row[4]) {
    __m512i a = _mm512_unpacklo_epi32(row[0], row[1]), b = _mm512_unpacklo_epi32(row[2], row[3]);
    __m512i c = _mm512_unpackhi_epi32(row[0], row[1]), d = _mm512_unpackhi_epi32(row[2], row[3]);
    FourWords words;
    words.word[0] = (vint)_mm512_unpacklo_epi64(a, b);
    words.word[1] = (vint)_mm512_unpackhi_epi64(a, b);
    words.word[2] = (vint)_mm512_unpacklo_epi64(c, d);
    words.word[3] = (vint)_mm512_unpackhi_epi64(c, d);
    return words;
}

/* Lanes as numbers of entries: read one by one they are cheaper than taken out of the register. */
FN void store_places(int64_t at[HD_LANES], vint index) {
    __m512i all = (__m512i)index;
    _mm512_storeu_si512(at, _mm512_cvtepi32_epi64(_mm512_castsi512_si256(all)));
    _mm512_storeu_si512(at + 8, _mm512_cvtepi32_epi64(_mm512_extracti64x4_epi64(all, 1)));
    HD_KEEP_IN_MEMORY(*(int64_t(*)[HD_LANES])at);
}

/* Four lanes to a register. */
FN FourWords fetch_four_words(const uint *table, vint index) {
    __m512i lanes[4];
    int64_t at[HD_LANES];
    store_places(at, index);
    for (int i = 0; i < 4; i++) {
        __m512i row = _mm512_castsi128_si512(_mm_loadu_si128((const void *)(table + at[i])));
        row = _mm512_inserti32x4(row, _mm_loadu_si128((const void *)(table + at[i + 4])), 1);
        row = _mm512_inserti32x4(row, _mm_loadu_si128((const void *)(table + at[i + 8])), 2);
        lanes[i] = _mm512_inserti32x4(row, _mm_loadu_si128((const void *)(table + at[i + 12])), 3);
    }
    return transpose_quarters(lanes);
}

FN FourReals reals_of(FourWords words) {
    FourReals reals;
    for (int i = 0; i < 4; i++)
        reals.number[i] = from_bits(words.word[i]);
    return reals;
}
FN FourReals fetch_four_reals(const real *table, vint index) {
    return reals_of(fetch_four_words((const void *)table, index));
}

FN FourReals load_rows(const real *table, vint index, int count) {
    __m512i row[4];
    for (int i = 0; i < 4; i++)
        row[i] = _mm512_castsi128_si512(_mm_loadu_si128((const void *)(table + index[i])));
    for (int quarter = 1; quarter < 4 && 4 * quarter < count; quarter++)
        for (int i = 0; i < 4; i++) {
            const real *at = table + index[4 * quarter + i];
            __m512i more = _mm512_broadcast_i32x4(_mm_loadu_si128((const void *)at));
            row[i] = _mm512_mask_mov_epi32(row[i], (__mmask16)(0xf << 4 * quarter), more);
        }
    return reals_of(transpose_quarters(row));
}
#endif

#endif
