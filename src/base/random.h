// SPDX-License-Identifier: MIT
//
// SplitMix64: a generator of 64 random bits from 64 bits of state, every seed a good one, the same on every machine.
// Inline, so that the sample levels of cli/ and the benchmarks (C and C++) draw the same numbers.
// Source: Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014.

#ifndef TALUS_SRC_BASE_RANDOM_H
#define TALUS_SRC_BASE_RANDOM_H

#include "base/hash.h"

#include <stdint.h>

/// The next 64 bits; `*state` is any number at first.
static inline uint64_t tl_random_bits(uint64_t *state)
{
    return tl_hash_mix(*state += 0x9e3779b97f4a7c15u);
}

/// A number of [0, 1): 53 bits.
static inline double tl_random_unit(uint64_t *state)
{
    return (double)(tl_random_bits(state) >> 11) * 0x1p-53;
}

/// A number of [0, 1): 24 bits.
static inline float tl_random_unit_float(uint64_t *state)
{
    return (float)(tl_random_bits(state) >> 40) * 0x1p-24f;
}

/// A number below `bound` > 0, every one as likely but for one part in 2^32.
static inline uint32_t tl_random_below(uint64_t *state, uint32_t bound)
{
    return (uint32_t)((tl_random_bits(state) >> 32) * bound >> 32);
}

#endif
