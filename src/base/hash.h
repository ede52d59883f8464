/* SPDX-License-Identifier: MIT */
/* Hashes of 64 bits that identify data and detect damage. They are not cryptographic. */
#ifndef HD_BASE_HASH_H
#define HD_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define HD_HASH_START UINT64_C(14695981039346656037)

/* Continues the FNV-1a hash `hash` with `size` bytes; start with HD_HASH_START. */
uint64_t hd_hash_bytes(uint64_t hash, const void *data, size_t size);

/* Continues a hash eight bytes at a time, several times as fast. The values differ from FNV-1a. */
uint64_t hd_hash_words(uint64_t hash, const void *data, size_t size);

#endif
