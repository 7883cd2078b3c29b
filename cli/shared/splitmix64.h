// SPDX-License-Identifier: MIT
//
// SplitMix64: a generator of 64 random bits from 64 bits of state, every seed a good one, the same on every machine.
// For sample levels, random points, and benchmarks (C and C++).
// Source: Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014.

#ifndef TALUS_CLI_SPLITMIX64_H
#define TALUS_CLI_SPLITMIX64_H

#include <stdint.h>

/// The next 64 bits; `*state` is any number at first.
static inline uint64_t tl_splitmix64(uint64_t *state)
{
    *state += 0x9e3779b97f4a7c15u;
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// A number of [0, 1): 24 bits.
static inline float tl_splitmix64_float(uint64_t *state)
{
    return (float)(tl_splitmix64(state) >> 40) * 0x1p-24f;
}

/// A number of [0, 1): 53 bits.
static inline double tl_splitmix64_double(uint64_t *state)
{
    return (double)(tl_splitmix64(state) >> 11) * 0x1p-53;
}

/// A number below `bound` > 0.
static inline uint32_t tl_splitmix64_below(uint64_t *state, uint32_t bound)
{
    return (uint32_t)(((tl_splitmix64(state) >> 32) * bound) >> 32);
}

#endif
