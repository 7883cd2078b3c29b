// SPDX-License-Identifier: MIT
//
// Hashes: a finalizer for hash tables, and XXH64 for content.
// Sources: David Stafford's mix 13 of the MurmurHash3 finalizer; Yann Collet, xxHash specification (XXH64).

#ifndef TALUS_SRC_BASE_HASH_H
#define TALUS_SRC_BASE_HASH_H

#include "base/exact_floats.h"

#include <stddef.h>
#include <stdint.h>

/// Spreads every input bit over the whole word; a bijection.
static inline uint64_t tl_hash_mix(uint64_t x)
{
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// XXH64 of a block of bytes, the same on every machine.
uint64_t tl_hash_bytes(const void *bytes, size_t size, uint64_t seed);

#endif
