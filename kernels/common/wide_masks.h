/* SPDX-License-Identifier: MIT */
/* Masks of several lanes where a language compares vectors by its operators. */
#ifndef HD_WIDE_MASKS_H
#define HD_WIDE_MASKS_H

typedef vint vmask;

FN vmask lt(vreal a, vreal b) {
    return a < b;
}
FN vmask le(vreal a, vreal b) {
    return a <= b;
}
FN vmask eq_int(vint a, vint b) {
    return a == b;
}
FN vmask lt_int(vint a, vint b) {
    return a < b;
}

#endif
