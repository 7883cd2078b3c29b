// SPDX-License-Identifier: MIT
//
// XXH64, written from its specification: four lanes over 32-byte stripes, then the tail, then the avalanche.
// Source: Yann Collet, xxHash fast digest algorithm, format description (XXH64). Chosen because every language has it,
// so that a tool of the user's can check a baked file.

#include "base/hash.h"

#include <string.h>

#define PRIME_1 0x9e3779b185ebca87u
#define PRIME_2 0xc2b2ae3d27d4eb4fu
#define PRIME_3 0x165667b19e3779f9u
#define PRIME_4 0x85ebca77c2b2ae63u
#define PRIME_5 0x27d4eb2f165667c5u

static uint64_t rotate_left(uint64_t value, int bits)
{
    return (value << bits) | (value >> (64 - bits));
}

static uint64_t read_word(const uint8_t *bytes, int size)
{
    uint64_t value = 0;
    for (int i = 0; i < size; i++) {
        value |= (uint64_t)bytes[i] << (8 * i);
    }
    return value;
}

static uint64_t round_lane(uint64_t lane, uint64_t input)
{
    return rotate_left(lane + input * PRIME_2, 31) * PRIME_1;
}

static uint64_t merge_lane(uint64_t hash, uint64_t lane)
{
    return (hash ^ round_lane(0, lane)) * PRIME_1 + PRIME_4;
}

static uint64_t finish_hash(uint64_t hash, const uint8_t *bytes, size_t size)
{
    while (size >= 8) {
        hash = rotate_left(hash ^ round_lane(0, read_word(bytes, 8)), 27) * PRIME_1 + PRIME_4;
        bytes += 8;
        size -= 8;
    }
    if (size >= 4) {
        hash = rotate_left(hash ^ (read_word(bytes, 4) * PRIME_1), 23) * PRIME_2 + PRIME_3;
        bytes += 4;
        size -= 4;
    }
    while (size > 0) {
        hash = rotate_left(hash ^ (*bytes * PRIME_5), 11) * PRIME_1;
        bytes++;
        size--;
    }
    hash = (hash ^ (hash >> 33)) * PRIME_2;
    hash = (hash ^ (hash >> 29)) * PRIME_3;
    return hash ^ (hash >> 32);
}

uint64_t tl_hash_bytes(const void *bytes, size_t size, uint64_t seed)
{
    const uint8_t *at = bytes;
    size_t left = size;
    uint64_t hash = seed + PRIME_5;
    if (size >= 32) {
        uint64_t lane[4] = { seed + PRIME_1 + PRIME_2, seed + PRIME_2, seed, seed - PRIME_1 };
        for (; left >= 32; left -= 32, at += 32) {
            for (int i = 0; i < 4; i++) {
                lane[i] = round_lane(lane[i], read_word(at + 8 * i, 8));
            }
        }
        hash = rotate_left(lane[0], 1) + rotate_left(lane[1], 7) + rotate_left(lane[2], 12) + rotate_left(lane[3], 18);
        for (int i = 0; i < 4; i++) {
            hash = merge_lane(hash, lane[i]);
        }
    }
    return finish_hash(hash + (uint64_t)size, at, left);
}
