/* SPDX-License-Identifier: MIT */
/* The sum of one pixel's contributions, in orders as atomic additions come in. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../scenes/models/random.h"
#include "product.h"
#include "studies.h"

enum { CONTRIBUTIONS = 400, ORDERS = 64 };

typedef struct Tally {
    long long differing; /* pixels whose sum depends on the order */
    double most_ulps;    /* by how many units in the last place of a float */
    double most_error;   /* of a sum, relative to that in double */
} Tally;

static void shuffle(float *numbers, int count, uint64_t *random) {
    for (int i = count - 1; i > 0; i--) {
        int j = (int)random_between(random, 0.0, i + 1.0);
        float kept = numbers[i];
        numbers[i] = numbers[j];
        numbers[j] = kept;
    }
}

static double float_sum(const float *numbers, int count) {
    float sum = 0.0f;
    for (int i = 0; i < count; i++)
        sum += numbers[i];
    return (double)sum;
}

static double sum_of(bool fixed, const float *numbers) {
    if (!fixed)
        return float_sum(numbers, CONTRIBUTIONS);
    return (double)hd_product_float.fixed_sum(numbers, CONTRIBUTIONS) * 0x1p-40;
}

static void try_pixel(bool fixed, float *numbers, uint64_t *random, Tally *tally) {
    double truth = 0.0, least = HUGE_VAL, most = 0.0;
    for (int i = 0; i < CONTRIBUTIONS; i++) {
        numbers[i] = (float)pow(10.0, random_between(random, -6.0, 0.0));
        truth += (double)numbers[i];
    }
    for (int order = 0; order < ORDERS; order++) {
        shuffle(numbers, CONTRIBUTIONS, random);
        double sum = sum_of(fixed, numbers);
        least = fmin(least, sum);
        most = fmax(most, sum);
        tally->most_error = fmax(tally->most_error, fabs(sum - truth) / truth);
    }
    int exponent;
    frexp(most, &exponent);
    tally->differing += least < most;
    tally->most_ulps = fmax(tally->most_ulps, (most - least) / ldexp(1.0, exponent - 24));
}

bool hd_study_sums(int count) {
    float numbers[CONTRIBUTIONS];
    for (int fixed = 0; fixed < 2; fixed++) {
        Tally tally = {0};
        uint64_t random = 3;
        for (int i = 0; i < count; i++)
            try_pixel(fixed != 0, numbers, &random, &tally);
        printf("sums pixel %s 1 0 tried=%d differing=%lld ulps=%g error=%g\n",
               fixed ? "ours" : "float", count, tally.differing, tally.most_ulps, tally.most_error);
    }
    return true;
}
