/* SPDX-License-Identifier: MIT */
/* Hashes of 64 bits that identify data and detect damage. They are not cryptographic. */
#ifndef HD_BASE_HASH_H
#define HD_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define HD_HASH_START UINT64_C(14695981039346656037)

/* Continues the FNV-1a hash `hash` with `size` bytes of text or of a file; start with
 * HD_HASH_START. */
uint64_t hd_hash_bytes(uint64_t hash, const void *data, size_t size);

/* Continues the hash with numbers of `width` (1, 2, 4 or 8) bytes, `size` bytes in all, each from
   its low byte on: the hash is the same on machines that keep the high byte first. */
uint64_t hd_hash_numbers(uint64_t hash, const void *data, size_t size, size_t width);

/* Like hd_hash_numbers, but eight bytes at a time and several times as fast, with other values. */
uint64_t hd_hash_words(uint64_t hash, const void *data, size_t size, size_t width);

#endif
