/* SPDX-License-Identifier: MIT */
/* Packets that fill a register of ARM's NEON, 64 bits: what compilers make badly of vectors.
   Included by packets.h. */
#ifndef HD_CPU_NEON_H
#define HD_CPU_NEON_H

#if HD_DOUBLE
#define HD_NEON_REALS(name) name##q_f64
#define HD_NEON_INTS(name)  name##q_s64
#else
#define HD_NEON_REALS(name) name##q_f32
#define HD_NEON_INTS(name)  name##q_s32
#endif

FN vreal multiply_add(vreal a, vreal b, vreal c) {
    return HD_NEON_REALS(vfma)(c, a, b);
}
FN vreal built_in_root(vreal a) {
    return HD_NEON_REALS(vsqrt)(a);
}

/* Two registers of doubles for one of floats; widening is exact. */
FN vfix truncate_to_fix(vreal a) {
#if HD_DOUBLE
    return (vfix)vcvtq_s64_f64(a);
#else
    int64x2_t halves[2] = {vcvtq_s64_f64(vcvt_f64_f32(vget_low_f32(a))),
                           vcvtq_s64_f64(vcvt_high_f64_f32(a))};
    vfix fix;
    __builtin_memcpy(&fix, halves, sizeof fix);
    return fix;
#endif
}

/* ---- masks ---- */

/* Returns 64 / HD_LANES bits for each lane, the first lane in the lowest ones. */
FN uint64_t narrowed(vmask m) {
#if HD_DOUBLE
    return vget_lane_u64((uint64x1_t)vmovn_u64((uint64x2_t)m), 0);
#else
    return vget_lane_u64((uint64x1_t)vmovn_u32((uint32x4_t)m), 0);
#endif
}
FN int any_lane(vmask m) {
    return narrowed(m) != 0;
}
FN vreal vselect(vmask m, vreal a, vreal b) {
    return (vreal)((m & (vmask)a) | (~m & (vmask)b));
}
FN vint vselect_int(vmask m, vint a, vint b) {
    return (m & a) | (~m & b);
}

#define HD_OWN_LANE_BITS
FN uint lane_bits(vmask m) {
    vint bits;
    for (int lane = 0; lane < HD_LANES; lane++)
        bits[lane] = 1 << lane;
    return (uint)HD_NEON_INTS(vaddv)(bits & m);
}

#define HD_OWN_SUM_LANES
FN fixed64 sum_lanes(vint a) {
#if HD_DOUBLE
    return vaddvq_s64(a);
#else
    return vaddlvq_s32(a);
#endif
}

#define HD_OWN_MIN_LANE
FN real min_lane(vreal a, vmask m) {
    return HD_NEON_REALS(vminnmv)(vselect(m, a, splat(REAL_LARGE)));
}
FN real max_lane(vreal a, vmask m) {
    return HD_NEON_REALS(vmaxnmv)(vselect(m, a, splat(-REAL_LARGE)));
}

/* ---- rows: loaded as registers and transposed ---- */

#define HD_OWN_ROWS
#if HD_DOUBLE

FN FourWords fetch_four_words(const uint *table, vint index) {
    FourWords words;
    int32x4_t a, b;
    __builtin_memcpy(&a, table + index[0], sizeof a);
    __builtin_memcpy(&b, table + index[1], sizeof b);
    int32x4_t even = vtrn1q_s32(a, b), odd = vtrn2q_s32(a, b);
    words.word[0] = (vint)vmovl_s32(vget_low_s32(even));
    words.word[1] = (vint)vmovl_s32(vget_low_s32(odd));
    words.word[2] = (vint)vmovl_high_s32(even);
    words.word[3] = (vint)vmovl_high_s32(odd);
    return words;
}

FN FourReals fetch_four_reals(const real *table, vint index) {
    FourReals reals;
    for (int half = 0; half < 4; half += 2) {
        vreal a = load_reals(table + index[0] + half), b = load_reals(table + index[1] + half);
        reals.number[half] = (vreal)vtrn1q_f64(a, b);
        reals.number[half + 1] = (vreal)vtrn2q_f64(a, b);
    }
    return reals;
}

#else

FN FourWords fetch_four_words(const uint *table, vint index) {
    FourWords words;
    int32x4_t row[HD_LANES];
    for (int lane = 0; lane < HD_LANES; lane++)
        __builtin_memcpy(&row[lane], table + index[lane], sizeof *row);
    int64x2_t a = (int64x2_t)vtrn1q_s32(row[0], row[1]);
    int64x2_t b = (int64x2_t)vtrn1q_s32(row[2], row[3]);
    int64x2_t c = (int64x2_t)vtrn2q_s32(row[0], row[1]);
    int64x2_t d = (int64x2_t)vtrn2q_s32(row[2], row[3]);
    words.word[0] = (vint)vtrn1q_s64(a, b);
    words.word[1] = (vint)vtrn1q_s64(c, d);
    words.word[2] = (vint)vtrn2q_s64(a, b);
    words.word[3] = (vint)vtrn2q_s64(c, d);
    return words;
}

#endif

#endif
