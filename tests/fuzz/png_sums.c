/* SPDX-License-Identifier: MIT */
#include "fuzz.h"

#include <zlib.h>

/* A chunk: its length, a name of four letters, the content and the sum of both. */
enum { SIGNATURE = 8, LENGTH = 4, NAME = 4, SUM = 4 };

static uint32_t get(const unsigned char *bytes) {
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

static void put(unsigned char *bytes, uint32_t value) {
    for (int i = 0; i < 4; i++)
        bytes[i] = (unsigned char)(value >> (24 - 8 * i) & 0xff);
}

uint64_t fuzz_mend_png(unsigned char *bytes, size_t size) {
    size_t at = SIGNATURE;
    while (size >= at + LENGTH + NAME + SUM) {
        const size_t covered = NAME + (size_t)get(bytes + at);
        if (covered > size - at - LENGTH - SUM)
            break;
        put(bytes + at + LENGTH + covered,
            (uint32_t)crc32(0, bytes + at + LENGTH, (unsigned)covered));
        at += LENGTH + covered + SUM;
    }
    if (size < SIGNATURE + LENGTH + NAME + 8)
        return 0;
    return (uint64_t)get(bytes + SIGNATURE + LENGTH + NAME) *
           get(bytes + SIGNATURE + LENGTH + NAME + 4);
}
