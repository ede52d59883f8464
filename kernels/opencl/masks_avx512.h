/* SPDX-License-Identifier: MIT */
/* Masks of bundles that fill a register of 512 bits, for drivers whose compiler is Clang: a bit for
   each lane, as in plain C. Of masks as integers it keeps in vector registers what should be in
   those of masks. */
#ifndef HD_OPENCL_MASKS_AVX512_H
#define HD_OPENCL_MASKS_AVX512_H

#if HD_DOUBLE
typedef uchar vmask;
#define HD_COMPARE_REALS(a, b, how) __builtin_ia32_cmppd512_mask(a, b, how, 0xff, 4)
#define HD_COMPARE_INTS(a, b, how)  __builtin_ia32_cmpq512_mask(a, b, how, 0xff)
#define HD_SELECT_REALS             __builtin_ia32_selectpd_512
#define HD_SELECT_INTS              __builtin_ia32_selectq_512
#else
typedef ushort vmask;
#define HD_COMPARE_REALS(a, b, how) __builtin_ia32_cmpps512_mask(a, b, how, 0xffff, 4)
#define HD_COMPARE_INTS(a, b, how)  __builtin_ia32_cmpd512_mask(a, b, how, 0xffff)
#define HD_SELECT_REALS             __builtin_ia32_selectps_512
#define HD_SELECT_INTS              __builtin_ia32_selectd_512
#endif
enum { REALS_LESS = 17, REALS_LESS_EQUAL = 18, INTS_EQUAL = 0, INTS_LESS = 1 };

FN vmask lt(vreal a, vreal b) {
    return HD_COMPARE_REALS(a, b, REALS_LESS);
}
FN vmask le(vreal a, vreal b) {
    return HD_COMPARE_REALS(a, b, REALS_LESS_EQUAL);
}
FN vmask eq_int(vint a, vint b) {
    return HD_COMPARE_INTS(a, b, INTS_EQUAL);
}
FN vmask lt_int(vint a, vint b) {
    return HD_COMPARE_INTS(a, b, INTS_LESS);
}
FN vreal pick(vmask m, vreal a, vreal b) {
    return HD_SELECT_REALS(m, a, b);
}
FN vint pick_int(vmask m, vint a, vint b) {
    return HD_SELECT_INTS(m, a, b);
}
FN int any_lane(vmask m) {
    return m != 0;
}

#define HD_OWN_MASKS
FN vmask mask_none(void) {
    return 0;
}
FN vmask mask_all(void) {
    return (vmask)-1;
}
FN int first_lane(vmask m) {
    return 31 - (int)clz((uint)m & (0u - m));
}

#define HD_OWN_LANE_BITS
FN uint lane_bits(vmask m) {
    return m;
}

#endif
