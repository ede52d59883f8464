/* SPDX-License-Identifier: MIT */
#include "image/mark.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <zlib.h>

#include "base/hash.h"

enum { KEYWORD_SIZE = 7, TEXT_SIZE = 45, DATA_SIZE = KEYWORD_SIZE + TEXT_SIZE };

uint64_t hd_picture_fingerprint(uint64_t run, int number) {
    return hd_hash_bytes(run, &number, sizeof number);
}

/* PNG is big endian. */
static void put_number(unsigned char *place, uint32_t number) {
    for (int i = 0; i < 4; i++)
        place[i] = (unsigned char)(number >> (24 - 8 * i));
}

void hd_picture_end(uint64_t fingerprint, uint64_t bytes_hash,
                    unsigned char end[HD_PICTURE_END_SIZE]) {
    static const unsigned char last[12] = "\0\0\0\0IEND\xae\x42\x60\x82";
    char text[TEXT_SIZE + 1];
    snprintf(text, sizeof text, "frame %016" PRIx64 " bytes %016" PRIx64, fingerprint, bytes_hash);
    put_number(end, DATA_SIZE);
    memcpy(end + 4, "tEXthedron", 4 + KEYWORD_SIZE);
    memcpy(end + 8 + KEYWORD_SIZE, text, TEXT_SIZE);
    put_number(end + 8 + DATA_SIZE, (uint32_t)crc32(crc32(0, NULL, 0), end + 4, 4 + DATA_SIZE));
    memcpy(end + 12 + DATA_SIZE, last, sizeof last);
}

bool hd_picture_is_whole(const unsigned char *bytes, size_t size, uint64_t fingerprint) {
    unsigned char end[HD_PICTURE_END_SIZE];
    if (size < HD_PICTURE_END_SIZE)
        return false;
    const size_t before = size - HD_PICTURE_END_SIZE;
    hd_picture_end(fingerprint, hd_hash_bytes(HD_HASH_START, bytes, before), end);
    return memcmp(bytes + before, end, sizeof end) == 0;
}
