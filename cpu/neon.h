/* SPDX-License-Identifier: MIT */
/* Packets of one or two registers of ARM's NEON, 64 bits: what compilers make badly of vectors.
   Included by packets.h. */
#ifndef HD_CPU_NEON_H
#define HD_CPU_NEON_H

/* A register of a packet. Packets of two are split by copies, some of which GCC keeps. */
enum { PARTS = HD_LANES * (HD_DOUBLE + 1) / 4 };
#if HD_DOUBLE
typedef float64x2_t RealPart;
typedef int64x2_t IntPart;
#define HD_NEON_REALS(name)       name##q_f64
#define HD_NEON_INTS(name)        name##q_s64
#define HD_NEON_CONVERT(to, from) vcvtq_##to##64_##from##64
#else
typedef float32x4_t RealPart;
typedef int32x4_t IntPart;
#define HD_NEON_REALS(name)       name##q_f32
#define HD_NEON_INTS(name)        name##q_s32
#define HD_NEON_CONVERT(to, from) vcvtq_##to##32_##from##32
#endif

FN RealPart real_part(const vreal *a, int i) {
    RealPart part;
    __builtin_memcpy(&part, (const char *)a + i * (int)sizeof part, sizeof part);
    return part;
}
FN IntPart int_part(const vint *a, int i) {
    IntPart part;
    __builtin_memcpy(&part, (const char *)a + i * (int)sizeof part, sizeof part);
    return part;
}
FN void set_real_part(vreal *a, int i, RealPart part) {
    __builtin_memcpy((char *)a + i * (int)sizeof part, &part, sizeof part);
}
FN void set_int_part(vint *a, int i, IntPart part) {
    __builtin_memcpy((char *)a + i * (int)sizeof part, &part, sizeof part);
}

FN vreal splat(real a) {
    vreal r;
    for (int i = 0; i < PARTS; i++)
        set_real_part(&r, i, a - (RealPart){0});
    return r;
}
FN vbits splat_bits(real_bits a) {
    vbits r;
    for (int i = 0; i < PARTS; i++)
        set_int_part(&r, i, a - (IntPart){0});
    return r;
}
FN vint splat_int(int a) {
    return splat_bits(a);
}

FN vint to_int(vreal a) {
    vint r;
    for (int i = 0; i < PARTS; i++)
        set_int_part(&r, i, HD_NEON_CONVERT(s, f)(real_part(&a, i)));
    return r;
}
FN vreal to_real(vint a) {
    vreal r;
    for (int i = 0; i < PARTS; i++)
        set_real_part(&r, i, HD_NEON_CONVERT(f, s)(int_part(&a, i)));
    return r;
}

/* Two registers of doubles for one of floats; widening is exact. */
FN vfix truncate_to_fix(vreal a) {
    int64x2_t fix[HD_LANES / 2];
    for (int i = 0; i < PARTS; i++) {
#if HD_DOUBLE
        fix[i] = vcvtq_s64_f64(real_part(&a, i));
#else
        RealPart part = real_part(&a, i);
        fix[2 * i] = vcvtq_s64_f64(vcvt_f64_f32(vget_low_f32(part)));
        fix[2 * i + 1] = vcvtq_s64_f64(vcvt_high_f64_f32(part));
#endif
    }
    vfix r;
    __builtin_memcpy(&r, fix, sizeof r);
    return r;
}

FN vreal multiply_add(vreal a, vreal b, vreal c) {
    vreal r;
    for (int i = 0; i < PARTS; i++)
        set_real_part(&r, i,
                      HD_NEON_REALS(vfma)(real_part(&c, i), real_part(&a, i), real_part(&b, i)));
    return r;
}
FN vreal built_in_root(vreal a) {
    vreal r;
    for (int i = 0; i < PARTS; i++)
        set_real_part(&r, i, HD_NEON_REALS(vsqrt)(real_part(&a, i)));
    return r;
}

/* ---- masks: by parts, as GCC compares packets of two registers lane by lane ---- */

typedef vint vmask;

#define HD_COMPARE(name, type, part, compare)                                                      \
    FN vmask name(type a, type b) {                                                                \
        vmask m;                                                                                   \
        for (int i = 0; i < PARTS; i++)                                                            \
            set_int_part(&m, i, (IntPart)compare(part(&a, i), part(&b, i)));                       \
        return m;                                                                                  \
    }
HD_COMPARE(lt, vreal, real_part, HD_NEON_REALS(vclt))
HD_COMPARE(le, vreal, real_part, HD_NEON_REALS(vcle))
HD_COMPARE(eq_int, vint, int_part, HD_NEON_INTS(vceq))
HD_COMPARE(lt_int, vint, int_part, HD_NEON_INTS(vclt))

FN vint vselect_int(vmask m, vint a, vint b) {
    vint r;
    for (int i = 0; i < PARTS; i++) {
        IntPart part = int_part(&m, i);
        set_int_part(&r, i, (part & int_part(&a, i)) | (~part & int_part(&b, i)));
    }
    return r;
}
FN vreal vselect(vmask m, vreal a, vreal b) {
    return from_bits(vselect_int(m, bits_of(a), bits_of(b)));
}
FN vmask mask_none(void) {
    return splat_int(0);
}
FN vmask mask_all(void) {
    return splat_int(-1);
}

/* Returns 64 / HD_LANES bits for each lane, the first lane in the lowest ones. */
FN uint64_t narrowed(vmask m) {
#if HD_LANES == 8
    uint16x8_t all = vuzp1q_u16((uint16x8_t)int_part(&m, 0), (uint16x8_t)int_part(&m, 1));
    return vget_lane_u64((uint64x1_t)vmovn_u16(all), 0);
#elif HD_LANES == 4 && HD_DOUBLE
    uint32x4_t all = vuzp1q_u32((uint32x4_t)int_part(&m, 0), (uint32x4_t)int_part(&m, 1));
    return vget_lane_u64((uint64x1_t)vmovn_u32(all), 0);
#elif HD_LANES == 4
    return vget_lane_u64((uint64x1_t)vmovn_u32((uint32x4_t)m), 0);
#else
    return vget_lane_u64((uint64x1_t)vmovn_u64((uint64x2_t)m), 0);
#endif
}
FN int any_lane(vmask m) {
    return narrowed(m) != 0;
}
FN int first_lane(vmask m) {
    return __builtin_ctzll(narrowed(m)) / (64 / HD_LANES);
}

#define HD_OWN_LANE_BITS
FN uint lane_bits(vmask m) {
    vint bits;
    for (int lane = 0; lane < HD_LANES; lane++)
        bits[lane] = 1 << lane;
    bits &= m;
    uint sum = 0;
    for (int i = 0; i < PARTS; i++)
        sum += (uint)HD_NEON_INTS(vaddv)(int_part(&bits, i));
    return sum;
}

#define HD_OWN_SUM_LANES
FN fixed64 sum_lanes(vint a) {
    fixed64 sum = 0;
    for (int i = 0; i < PARTS; i++)
#if HD_DOUBLE
        sum += vaddvq_s64(int_part(&a, i));
#else
        sum += vaddlvq_s32(int_part(&a, i));
#endif
    return sum;
}

#define HD_OWN_MIN_LANE
FN real min_lane(vreal a, vmask m) {
    a = vselect(m, a, splat(REAL_LARGE));
    RealPart least = real_part(&a, 0);
    for (int i = 1; i < PARTS; i++)
        least = HD_NEON_REALS(vminnm)(least, real_part(&a, i));
    return HD_NEON_REALS(vminnmv)(least);
}
FN real max_lane(vreal a, vmask m) {
    a = vselect(m, a, splat(-REAL_LARGE));
    RealPart most = real_part(&a, 0);
    for (int i = 1; i < PARTS; i++)
        most = HD_NEON_REALS(vmaxnm)(most, real_part(&a, i));
    return HD_NEON_REALS(vmaxnmv)(most);
}

/* ---- rows: loaded as registers and transposed ---- */

#define HD_OWN_ROWS
#if HD_DOUBLE

FN FourWords fetch_four_words(const uint *table, vint index) {
    FourWords words;
    for (int i = 0; i < PARTS; i++) {
        int32x4_t a, b;
        __builtin_memcpy(&a, table + index[2 * i], sizeof a);
        __builtin_memcpy(&b, table + index[2 * i + 1], sizeof b);
        int32x4_t even = vtrn1q_s32(a, b), odd = vtrn2q_s32(a, b);
        set_int_part(&words.word[0], i, vmovl_s32(vget_low_s32(even)));
        set_int_part(&words.word[1], i, vmovl_s32(vget_low_s32(odd)));
        set_int_part(&words.word[2], i, vmovl_high_s32(even));
        set_int_part(&words.word[3], i, vmovl_high_s32(odd));
    }
    return words;
}

FN FourReals fetch_four_reals(const real *table, vint index) {
    FourReals reals;
    for (int i = 0; i < PARTS; i++)
        for (int half = 0; half < 4; half += 2) {
            RealPart a, b;
            __builtin_memcpy(&a, table + index[2 * i] + half, sizeof a);
            __builtin_memcpy(&b, table + index[2 * i + 1] + half, sizeof b);
            set_real_part(&reals.number[half], i, vtrn1q_f64(a, b));
            set_real_part(&reals.number[half + 1], i, vtrn2q_f64(a, b));
        }
    return reals;
}

#else

FN FourWords fetch_four_words(const uint *table, vint index) {
    FourWords words;
    for (int i = 0; i < PARTS; i++) {
        int32x4_t row[4];
        for (int lane = 0; lane < 4; lane++)
            __builtin_memcpy(&row[lane], table + index[4 * i + lane], sizeof *row);
        int64x2_t a = (int64x2_t)vtrn1q_s32(row[0], row[1]);
        int64x2_t b = (int64x2_t)vtrn1q_s32(row[2], row[3]);
        int64x2_t c = (int64x2_t)vtrn2q_s32(row[0], row[1]);
        int64x2_t d = (int64x2_t)vtrn2q_s32(row[2], row[3]);
        set_int_part(&words.word[0], i, (IntPart)vtrn1q_s64(a, b));
        set_int_part(&words.word[1], i, (IntPart)vtrn1q_s64(c, d));
        set_int_part(&words.word[2], i, (IntPart)vtrn2q_s64(a, b));
        set_int_part(&words.word[3], i, (IntPart)vtrn2q_s64(c, d));
    }
    return words;
}

#endif

#endif
