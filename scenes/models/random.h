/* SPDX-License-Identifier: MIT */
/* Random numbers that are the same on every system. */
#ifndef HD_MODELS_RANDOM_H
#define HD_MODELS_RANDOM_H

#include <stdint.h>

/* Steele, Lea and Flood 2014, Fast splittable pseudorandom number generators: SplitMix64. */
static inline uint64_t random_bits(uint64_t *state) {
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Returns a number of at least `least` and less than `most`. */
static inline double random_between(uint64_t *state, double least, double most) {
    return least + (most - least) * ((double)(random_bits(state) >> 11) * 0x1p-53);
}

#endif
