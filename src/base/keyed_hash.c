/* SPDX-License-Identifier: MIT */
#include "base/keyed_hash.h"

typedef struct State {
    uint64_t v0, v1, v2, v3;
} State;

static uint64_t rotate(uint64_t value, int bits) {
    return value << bits | value >> (64 - bits);
}

/* Up to eight bytes, the first one lowest. */
static uint64_t word_at(const unsigned char *bytes, size_t count) {
    uint64_t word = 0;
    for (size_t i = 0; i < count; i++)
        word |= (uint64_t)bytes[i] << (8 * i);
    return word;
}

static void mix(State *s, int rounds) {
    for (int i = 0; i < rounds; i++) {
        s->v0 += s->v1;
        s->v2 += s->v3;
        s->v1 = rotate(s->v1, 13) ^ s->v0;
        s->v3 = rotate(s->v3, 16) ^ s->v2;
        s->v0 = rotate(s->v0, 32);
        s->v2 += s->v1;
        s->v0 += s->v3;
        s->v1 = rotate(s->v1, 17) ^ s->v2;
        s->v3 = rotate(s->v3, 21) ^ s->v0;
        s->v2 = rotate(s->v2, 32);
    }
}

static void take_in(State *s, uint64_t word) {
    s->v3 ^= word;
    mix(s, 2);
    s->v0 ^= word;
}

uint64_t hd_keyed_hash(const unsigned char key[HD_HASH_KEY_BYTES], const void *bytes, size_t size) {
    const uint64_t first = word_at(key, 8), second = word_at(key + 8, 8);
    const unsigned char *at = bytes;
    State s = {
        .v0 = first ^ UINT64_C(0x736f6d6570736575),
        .v1 = second ^ UINT64_C(0x646f72616e646f6d),
        .v2 = first ^ UINT64_C(0x6c7967656e657261),
        .v3 = second ^ UINT64_C(0x7465646279746573),
    };
    for (size_t left = size; left >= 8; left -= 8, at += 8)
        take_in(&s, word_at(at, 8));
    take_in(&s, word_at(at, size % 8) | (uint64_t)size << 56);
    s.v2 ^= 0xff;
    mix(&s, 4);
    return s.v0 ^ s.v1 ^ s.v2 ^ s.v3;
}
