/* SPDX-License-Identifier: MIT */
/* Packets of several lanes in C, by the vector extension of GCC and Clang; by intrinsics if they
   fill a machine register. */
#ifndef HD_CPU_PACKETS_H
#define HD_CPU_PACKETS_H

#include "kernels/host/shared.h"

/* Defined if a packet fills a register: the prefix of its intrinsics. */
#if defined(__AVX512DQ__) && HD_LANES * (HD_DOUBLE + 1) == 16
#define HD_INTRINSIC(name) _mm512_##name
#define HD_OWN_MASKS
#elif defined(__AVX2__) && defined(__FMA__) && HD_LANES * (HD_DOUBLE + 1) == 8
#define HD_INTRINSIC(name) _mm256_##name
#elif defined(__AVX2__) && defined(__FMA__) && HD_LANES * (HD_DOUBLE + 1) == 4
#define HD_INTRINSIC(name) _mm_##name
#endif
#ifdef HD_INTRINSIC
#include <immintrin.h>
#elif defined(__AARCH64EL__) && HD_LANES * (HD_DOUBLE + 1) == 4
#define HD_NEON
#include <arm_neon.h>
#endif

#if HD_DOUBLE
typedef int64_t real_bits;
#else
typedef int32_t real_bits;
#endif
typedef real vreal __attribute__((vector_size(HD_LANES * sizeof(real))));
typedef real_bits vint __attribute__((vector_size(HD_LANES * sizeof(real))));
typedef int64_t vfix __attribute__((vector_size(HD_LANES * 8)));
typedef vint vbits;

#include "kernels/common/lanes.h"

/* Hides the array's origin from compilers, so that they read its numbers from memory. */
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
#ifndef HD_NEON
FN vfix truncate_to_fix(vreal a) {
    return __builtin_convertvector(a, vfix);
}
#endif
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

#ifdef HD_INTRINSIC

/* ---- packets that fill a register ---- */

#if HD_DOUBLE
#define HD_REALS(name) HD_INTRINSIC(name##_pd)
#else
#define HD_REALS(name) HD_INTRINSIC(name##_ps)
#endif

FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return HD_REALS(fmadd)(a, b, c);
}
FN vreal built_in_root(vreal a) {
    return HD_REALS(sqrt)(a);
}

#define HD_OWN_MIN_MAX
FN vreal vmin(vreal a, vreal b) {
    return HD_REALS(min)(a, b);
}
FN vreal vmax(vreal a, vreal b) {
    return HD_REALS(max)(a, b);
}

#ifdef HD_OWN_MASKS

/* A bit for each lane; bits above have no meaning. */
typedef uint32_t vmask;
#if HD_DOUBLE
#define HD_MASK(m)               ((__mmask8)(m))
#define HD_LESS_REALS(a, b, how) _mm512_cmp_pd_mask(a, b, how)
#define HD_INTS(name)            _mm512_##name##_epi64
#define HD_COMPARE_INTS(name)    _mm512_##name##_epi64_mask
#else
#define HD_MASK(m)               ((__mmask16)(m))
#define HD_LESS_REALS(a, b, how) _mm512_cmp_ps_mask(a, b, how)
#define HD_INTS(name)            _mm512_##name##_epi32
#define HD_COMPARE_INTS(name)    _mm512_##name##_epi32_mask
#endif

FN vmask lt(vreal a, vreal b) {
    return HD_LESS_REALS(a, b, _CMP_LT_OQ);
}
FN vmask le(vreal a, vreal b) {
    return HD_LESS_REALS(a, b, _CMP_LE_OQ);
}
FN vmask eq_int(vint a, vint b) {
    return HD_COMPARE_INTS(cmpeq)((__m512i)a, (__m512i)b);
}
FN vmask lt_int(vint a, vint b) {
    return HD_COMPARE_INTS(cmplt)((__m512i)a, (__m512i)b);
}
FN vreal vselect(vmask m, vreal a, vreal b) {
    return HD_REALS(mask_blend)(HD_MASK(m), b, a);
}
FN vint vselect_int(vmask m, vint a, vint b) {
    return (vint)HD_INTS(mask_blend)(HD_MASK(m), (__m512i)b, (__m512i)a);
}
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
FN int any_lane(vmask m) {
    return HD_MASK(m) != 0;
}

#define HD_OWN_MIN_LANE
FN real min_lane(vreal a, vmask m) {
    return HD_REALS(mask_reduce_min)(HD_MASK(m), a);
}
FN real max_lane(vreal a, vmask m) {
    return HD_REALS(mask_reduce_max)(HD_MASK(m), a);
}

#define HD_OWN_STORE_LANES
FN void store_lanes(real *to, vmask m, const int offset[HD_LANES], const vreal *a) {
    (void)offset;
    HD_REALS(storeu)(to, HD_REALS(maskz_compress)(HD_MASK(m), *a));
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

#else

#define HD_OWN_LANE_BITS
FN uint lane_bits(vmask m) {
    return (uint)HD_REALS(movemask)((vreal)m);
}
FN int any_lane(vmask m) {
    return lane_bits(m) != 0;
}
FN vreal vselect(vmask m, vreal a, vreal b) {
    return HD_REALS(blendv)(b, a, (vreal)m);
}
FN vint vselect_int(vmask m, vint a, vint b) {
    return (vint)HD_REALS(blendv)((vreal)b, (vreal)a, (vreal)m);
}

#endif

#if !HD_DOUBLE && HD_LANES >= 8
#define HD_OWN_ROWS
#if HD_LANES == 16
typedef __m512i Row;
#else
typedef __m256i Row;
#endif

/* Transposes the 4 x 4 words in each 128 bits of the registers. */
FN FourWords transpose_words(const Row row[4]) {
    Row a = HD_INTRINSIC(unpacklo_epi32)(row[0], row[1]);
    Row b = HD_INTRINSIC(unpacklo_epi32)(row[2], row[3]);
    Row c = HD_INTRINSIC(unpackhi_epi32)(row[0], row[1]);
    Row d = HD_INTRINSIC(unpackhi_epi32)(row[2], row[3]);
    FourWords words;
    words.word[0] = (vint)HD_INTRINSIC(unpacklo_epi64)(a, b);
    words.word[1] = (vint)HD_INTRINSIC(unpackhi_epi64)(a, b);
    words.word[2] = (vint)HD_INTRINSIC(unpacklo_epi64)(c, d);
    words.word[3] = (vint)HD_INTRINSIC(unpackhi_epi64)(c, d);
    return words;
}
#endif

#if !HD_DOUBLE && HD_LANES == 8

/* Loads two lanes to a register. */
FN FourWords fetch_four_words(const uint *table, vint index) {
    __m256i row[4];
    int at[HD_LANES]; /* cheaper than extracting lanes from the register */
    _mm256_storeu_si256((void *)at, (__m256i)index);
    HD_KEEP_IN_MEMORY(at);
    for (int i = 0; i < 4; i++) {
        row[i] = _mm256_castsi128_si256(_mm_loadu_si128((const void *)(table + at[i])));
        row[i] =
            _mm256_inserti128_si256(row[i], _mm_loadu_si128((const void *)(table + at[i + 4])), 1);
    }
    return transpose_words(row);
}

#elif !HD_DOUBLE && HD_LANES == 16

/* Stores lanes to memory, from which reading them is cheaper than extracting them. */
FN void store_places(int64_t at[HD_LANES], vint index) {
    __m512i all = (__m512i)index;
    _mm512_storeu_si512(at, _mm512_cvtepi32_epi64(_mm512_castsi512_si256(all)));
    _mm512_storeu_si512(at + 8, _mm512_cvtepi32_epi64(_mm512_extracti64x4_epi64(all, 1)));
    HD_KEEP_IN_MEMORY(*(int64_t(*)[HD_LANES])at);
}

/* Loads four lanes to a register. */
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
    return transpose_words(lanes);
}

#define HD_OWN_LOAD_ROWS
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
    FourWords words = transpose_words(row);
    FourReals reals;
    for (int i = 0; i < 4; i++)
        reals.number[i] = from_bits(words.word[i]);
    return reals;
}

#endif

#elif defined(HD_NEON)

#include "cpu/neon.h"

#else

/* ---- other packets, lane by lane: compilers lack these vector operations ---- */

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
FN vreal vselect(vmask m, vreal a, vreal b) {
    return (vreal)((m & (vmask)a) | (~m & (vmask)b));
}
FN vint vselect_int(vmask m, vint a, vint b) {
    return (m & a) | (~m & b);
}

#endif

#endif
