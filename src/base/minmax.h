/* SPDX-License-Identifier: MIT */
/* Minimum and maximum of integers; floating-point numbers have fmin and fmax. */
#ifndef HD_BASE_MINMAX_H
#define HD_BASE_MINMAX_H

#include <stddef.h>

static inline int hd_min(int a, int b) {
    return a < b ? a : b;
}

static inline int hd_max(int a, int b) {
    return a > b ? a : b;
}

static inline size_t hd_min_size(size_t a, size_t b) {
    return a < b ? a : b;
}

#endif
