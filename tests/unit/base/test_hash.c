/* SPDX-License-Identifier: MIT */
/* No bit of the data is lost on the way. */
#include "base/hash.h"
#include "base/keyed_hash.h"
#include "unit_test.h"

enum { SIZE = 27 };
static unsigned char bytes[SIZE];

typedef uint64_t Hash(uint64_t hash, const void *data, size_t size);

static void expect_all_bits_count(Hash *hash) {
    const uint64_t usual = hash(HD_HASH_START, bytes, SIZE);
    for (int i = 0; i < SIZE * 8; i++) {
        bytes[i / 8] ^= (unsigned char)(1 << i % 8);
        assert_true(hash(HD_HASH_START, bytes, SIZE) != usual);
        /* Two that are turned do not make up for each other. */
        for (int j = i + 1; j < SIZE * 8; j++) {
            bytes[j / 8] ^= (unsigned char)(1 << j % 8);
            assert_true(hash(HD_HASH_START, bytes, SIZE) != usual);
            bytes[j / 8] ^= (unsigned char)(1 << j % 8);
        }
        bytes[i / 8] ^= (unsigned char)(1 << i % 8);
    }
    assert_true(hash(HD_HASH_START, bytes, SIZE - 1) != usual);
    assert_true(hash(HD_HASH_START + 1, bytes, SIZE) != usual);
}

TEST(every_bit_counts) {
    for (int i = 0; i < SIZE; i++)
        bytes[i] = (unsigned char)(37 * i);
    expect_all_bits_count(hd_hash_bytes);
    expect_all_bits_count(hd_hash_words);
}

TEST(bytes_are_hashed_as_fnv_1a_has_it) {
    assert_true(hd_hash_bytes(HD_HASH_START, "", 0) == HD_HASH_START);
    assert_true(hd_hash_bytes(HD_HASH_START, "foobar", 6) == UINT64_C(0x85944171f73967e8));
}

/* The value is that of another implementation. */
TEST(words_are_hashed_one_by_one) {
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
    key[15] ^= 1;
    assert_true(hd_keyed_hash(key, "", 0) != UINT64_C(0x726fdb47dd0e0e31));
}
