/* SPDX-License-Identifier: MIT */
#include "base/quantile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A double's bits without sign have the order of the numbers; their upper part is the bucket. */
enum {
    FRACTION_BITS = 52,
    KEPT_BITS = 11,
    BIAS = 1023,
    LEAST_POWER = -60,
    MOST_POWER = 130,
    BUCKETS = (MOST_POWER - LEAST_POWER) << KEPT_BITS
};

HdStatus hd_quantile_create(HdQuantile *quantile, HdError *error) {
    *quantile = (HdQuantile){.buckets = calloc(BUCKETS, sizeof *quantile->buckets)};
    if (quantile->buckets == NULL)
        return hd_fail(error, HD_FAILED, "out of memory: no room to sort numbers");
    return HD_OK;
}

void hd_quantile_free(HdQuantile *quantile) {
    free(quantile->buckets);
    *quantile = (HdQuantile){0};
}

static int64_t bucket_of(double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    int64_t bucket = (int64_t)(bits >> (FRACTION_BITS - KEPT_BITS)) -
                     ((int64_t)(BIAS + LEAST_POWER) << KEPT_BITS);
    if (bucket < 0)
        return 0;
    return bucket < BUCKETS ? bucket : BUCKETS - 1;
}

void hd_quantile_add(HdQuantile *quantile, double value) {
    HdQuantileBucket *bucket = &quantile->buckets[bucket_of(value)];
    bucket->count++;
    if (value > bucket->largest)
        bucket->largest = value;
    quantile->count++;
}

double hd_quantile_above(const HdQuantile *quantile, uint64_t out_of) {
    const uint64_t allowed = quantile->count / out_of;
    uint64_t above = 0;
    for (int i = BUCKETS; i-- > 0;) {
        const HdQuantileBucket *bucket = &quantile->buckets[i];
        if (above + bucket->count > allowed)
            return bucket->largest;
        above += bucket->count;
    }
    return (double)NAN;
}
