/* SPDX-License-Identifier: MIT */
/* Numbers as bytes of files that all machines share. */
#ifndef HD_BASE_LOW_BYTES_H
#define HD_BASE_LOW_BYTES_H

#include <stdint.h>

/* Writes the lowest `count` bytes of a number, the lowest first on every machine. */
static inline void hd_put_low_bytes(unsigned char *out, uint64_t number, int count) {
    for (int i = 0; i < count; i++)
        out[i] = (unsigned char)(number >> (8 * i) & 0xff);
}

#endif
