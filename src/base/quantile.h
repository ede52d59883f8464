/* SPDX-License-Identifier: MIT */
/* A quantile of many numbers in a few MiB, whatever their count. */
#ifndef HD_BASE_QUANTILE_H
#define HD_BASE_QUANTILE_H

#include <stdint.h>

#include "base/error.h"

typedef struct HdQuantileBucket {
    uint64_t count;
    double largest;
} HdQuantileBucket;

typedef struct HdQuantile {
    HdQuantileBucket *buckets; /* owned; numbers that share exponent and leading bits */
    uint64_t count;
} HdQuantile;

HdStatus hd_quantile_create(HdQuantile *quantile, HdError *error);
void hd_quantile_free(HdQuantile *quantile);

/* Adds a finite number that is at least 0. */
void hd_quantile_add(HdQuantile *quantile, double value);

/* One of the numbers: at most one in `out_of` is above it. It is the least such number, or a number
   that is larger by at most 1/2048 of it (of those from 2^-60 to 2^130); the least one exactly
   where the numbers are multiples of a step and below 2048 of it. Without numbers NaN. */
double hd_quantile_above(const HdQuantile *quantile, uint64_t out_of);

#endif
