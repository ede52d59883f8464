/* SPDX-License-Identifier: MIT */
#include "base/hash.h"
#include "base/keyed_hash.h"
#include "unit_test.h"

/* Of words there are two and three bytes; the value is that of another implementation. */
TEST(hashes_are_fnv_1a_of_bytes_or_words) {
    assert_true(hd_hash_bytes(HD_HASH_START, "foobar", 6) == UINT64_C(0x85944171f73967e8));
    assert_true(hd_hash_words(HD_HASH_START, "abcdefghABCDEFGHxyz", 19) ==
                UINT64_C(0x8959acab3d795e5));
}

/* The first and the last of what SipHash's authors tell. */
TEST(keyed_hashes_are_siphash) {
    unsigned char key[HD_HASH_KEY_BYTES];
    for (int i = 0; i < HD_HASH_KEY_BYTES; i++)
        key[i] = (unsigned char)i;
    assert_true(hd_keyed_hash(key, "", 0) == UINT64_C(0x726fdb47dd0e0e31));
    assert_true(hd_keyed_hash(key, key, 15) == UINT64_C(0xa129ca6149be45e5));
}
