/* SPDX-License-Identifier: MIT */
#include "base/hash.h"

#include <stdbool.h>
#include <string.h>

static uint64_t add_byte(uint64_t hash, uint64_t byte) {
    return (hash ^ byte) * UINT64_C(1099511628211);
}

uint64_t hd_hash_bytes(uint64_t hash, const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = add_byte(hash, bytes[i]);
    return hash;
}

static uint64_t number_at(const unsigned char *bytes, size_t width) {
    uint16_t two;
    uint32_t four;
    uint64_t eight;
    switch (width) {
    case 2:
        return memcpy(&two, bytes, sizeof two), two;
    case 4:
        return memcpy(&four, bytes, sizeof four), four;
    case 8:
        return memcpy(&eight, bytes, sizeof eight), eight;
    default:
        return *bytes;
    }
}

uint64_t hd_hash_numbers(uint64_t hash, const void *data, size_t size, size_t width) {
    const unsigned char *bytes = data;
    for (size_t done = 0; done < size; done += width) {
        const uint64_t number = number_at(bytes + done, width);
        for (size_t i = 0; i < width; i++)
            hash = add_byte(hash, number >> (8 * i) & 0xff);
    }
    return hash;
}

/* A constant to compilers. */
static bool has_low_byte_first(void) {
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, sizeof first);
    return first == 1;
}

/* Returns the numbers in eight bytes as one, the first of them lowest. */
static uint64_t word_at(const unsigned char *bytes, size_t width) {
    const size_t bits = 8 * width;
    if (width == 8 || has_low_byte_first())
        return number_at(bytes, 8);
    uint64_t word = 0;
    for (size_t i = 0; i < 8; i += width)
        word |= number_at(bytes + i, width) << (i / width * bits);
    return word;
}

/* Multiplication carries differences upwards only, so the upper half is fed back into the lower. */
uint64_t hd_hash_words(uint64_t hash, const void *data, size_t size, size_t width) {
    const unsigned char *bytes = data;
    for (; size >= 8; bytes += 8, size -= 8) {
        hash = (hash ^ word_at(bytes, width)) * UINT64_C(0x9e3779b97f4a7c15);
        hash ^= hash >> 32;
    }
    return hd_hash_numbers(hash, bytes, size, width);
}
