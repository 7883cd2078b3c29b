// SPDX-License-Identifier: MIT
//
// Masks of candidates are walked from their lowest bit up.

#ifndef TALUS_SRC_BASE_LOWEST_BIT_H
#define TALUS_SRC_BASE_LOWEST_BIT_H

#include <stdint.h>

// Index of the lowest set bit; the mask is not zero.
static inline uint32_t tl_lowest_bit(uint64_t mask)
{
#if defined(__GNUC__) || defined(__clang__)
    return (uint32_t)__builtin_ctzll(mask);
#else
    uint32_t index = 0;
    while ((mask & 1u) == 0) {
        mask >>= 1;
        index++;
    }
    return index;
#endif
}

// Index of the highest set bit; the mask is not zero.
static inline uint32_t tl_highest_bit(uint64_t mask)
{
#if defined(__GNUC__) || defined(__clang__)
    return 63u - (uint32_t)__builtin_clzll(mask);
#else
    uint32_t index = 0;
    while ((mask >>= 1) != 0) {
        index++;
    }
    return index;
#endif
}

// How many bits are set.
static inline uint32_t tl_bit_count(uint32_t mask)
{
#if defined(__GNUC__) || defined(__clang__)
    return (uint32_t)__builtin_popcount(mask);
#else
    uint32_t count = 0;
    for (; mask != 0; mask &= mask - 1) {
        count++;
    }
    return count;
#endif
}

#endif
