/* SPDX-License-Identifier: MIT */
/* A hash that only those can make who know its key: SipHash-2-4 (Aumasson and Bernstein, SipHash: a
   fast short-input PRF, 2012). */
#ifndef HD_BASE_KEYED_HASH_H
#define HD_BASE_KEYED_HASH_H

#include <stddef.h>
#include <stdint.h>

enum { HD_HASH_KEY_BYTES = 16 };

/* The same for the same bytes and key on every system. */
uint64_t hd_keyed_hash(const unsigned char key[HD_HASH_KEY_BYTES], const void *bytes, size_t size);

#endif
