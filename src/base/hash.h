/* SPDX-License-Identifier: MIT */
/* FNV-1a with 64 bits: tells one thing from another, and what was damaged from what was not. It
   keeps no secret. */
#ifndef HD_BASE_HASH_H
#define HD_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define HD_HASH_START UINT64_C(14695981039346656037)

/* Goes on from `hash`, at first HD_HASH_START. */
uint64_t hd_hash_bytes(uint64_t hash, const void *data, size_t size);

/* For much data: eight bytes at a time, which is several times as fast. It is no FNV and gives
   another number. */
uint64_t hd_hash_words(uint64_t hash, const void *data, size_t size);

#endif
