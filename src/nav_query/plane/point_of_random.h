// SPDX-License-Identifier: MIT
//
// From random bits to a number below a bound, and to a point of a triangle.

#ifndef TALUS_SRC_NAV_QUERY_POINT_OF_RANDOM_H
#define TALUS_SRC_NAV_QUERY_POINT_OF_RANDOM_H

#include <stdbool.h>
#include <stdint.h>

/// The upper half of the product: with 64 random bits a number below `bound`, none more likely than another by more
/// than bound / 2^64.
static inline uint64_t tl_nav_random_below(uint64_t bits, uint64_t bound)
{
    uint64_t bits_low = bits & 0xffffffffu;
    uint64_t bits_high = bits >> 32;
    uint64_t low = bound & 0xffffffffu;
    uint64_t high = bound >> 32;
    uint64_t middle = bits_high * low + ((bits_low * low) >> 32);
    uint64_t other = bits_low * high + (middle & 0xffffffffu);
    return bits_high * high + (middle >> 32) + (other >> 32);
}

/// Weights of a triangle's second and third corner for a point uniform in it: that of a parallelogram, folded over.
static inline void tl_nav_random_in_triangle(uint64_t bits, double *second_out, double *third_out)
{
    double s = (double)(bits >> 32) * (1.0 / 4294967296.0);
    double t = (double)(bits & 0xffffffffu) * (1.0 / 4294967296.0);
    bool outside = s + t > 1.0;
    *second_out = outside ? 1.0 - s : s;
    *third_out = outside ? 1.0 - t : t;
}

#endif
