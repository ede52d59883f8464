/* SPDX-License-Identifier: MIT */
/* From radiance to the 8 bits that most files store. */
#ifndef HD_ENCODE_H
#define HD_ENCODE_H

#include "real.h"

enum { INFINITE_BITS = 0x7f800000 };

/* The greatest code whose threshold is not above a value; 0 for NaN. Value and thresholds, by code
   and positive, are given as the bits of floats: as integers they have the order of the values, and
   no compiler may take liberties with NaN. Negative values are below every threshold. */
FN uint encode8(int bits, GLOBAL const int *thresholds) {
    uint code = 0;
    for (uint step = 128; step > 0; step >>= 1)
        if (bits <= INFINITE_BITS && bits >= thresholds[code + step])
            code += step;
    return code;
}

/* Encodes every `workers`-th of `count` pixels from number `worker` on: three floats, as bits,
   become the bytes r, g, b and an alpha of 255. */
FN void encode_pixels(GLOBAL const int *pixels, int count, GLOBAL const int *thresholds, int worker,
                      int workers, GLOBAL uint *image) {
    for (int i = worker; i < count; i += workers) {
        GLOBAL const int *rgb = pixels + (uint64)i * 3;
        image[i] = encode8(rgb[0], thresholds) | encode8(rgb[1], thresholds) << 8 |
                   encode8(rgb[2], thresholds) << 16 | 0xff000000u;
    }
}

#endif
