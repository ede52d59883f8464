/* SPDX-License-Identifier: MIT */
#include "base/hash.h"
#include "unit_test.h"

/* Words of two and three bytes; the value is that of another implementation. */
TEST(hashes_are_fnv_1a_of_bytes_or_words) {
    assert_true(hd_hash_bytes(HD_HASH_START, "foobar", 6) == UINT64_C(0x85944171f73967e8));
    assert_true(hd_hash_words(HD_HASH_START, "abcdefghABCDEFGHxyz", 19, 1) ==
                UINT64_C(0x8959acab3d795e5));
}

/* Numbers whose bytes, from the low one on, are those of the text, whichever byte a machine has
 * first. */
TEST(hashes_of_numbers_do_not_depend_on_the_order_of_bytes) {
    const char text[] = "abcdefghABCDEFGHxyzw";
    const uint16_t two[] = {0x6261, 0x6463, 0x6665, 0x6867, 0x4241,
                            0x4443, 0x4645, 0x4847, 0x7978, 0x777a};
    const uint32_t four[] = {0x64636261, 0x68676665, 0x44434241, 0x48474645, 0x777a7978};
    const uint64_t eight[] = {0x6867666564636261, 0x4847464544434241};
    const struct {
        const void *numbers;
        size_t size, width;
    } cases[] = {{text, 20, 1}, {two, 20, 2}, {four, 20, 4}, {eight, 16, 8}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const size_t size = cases[i].size, width = cases[i].width;
        assert_true(hd_hash_numbers(HD_HASH_START, cases[i].numbers, size, width) ==
                    hd_hash_bytes(HD_HASH_START, text, size));
        assert_true(hd_hash_words(HD_HASH_START, cases[i].numbers, size, width) ==
                    (size == 16 ? UINT64_C(0xef6b448bcb6413ca) : UINT64_C(0x6dcb986f97532716)));
    }
}
