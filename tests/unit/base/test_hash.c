/* SPDX-License-Identifier: MIT */
#include "base/hash.h"
#include "unit_test.h"

/* Words of two and three bytes; the value is that of another implementation. */
TEST(hashes_are_fnv_1a_of_bytes_or_words) {
    assert_true(hd_hash_bytes(HD_HASH_START, "foobar", 6) == UINT64_C(0x85944171f73967e8));
    assert_true(hd_hash_words(HD_HASH_START, "abcdefghABCDEFGHxyz", 19) ==
                UINT64_C(0x8959acab3d795e5));
}
