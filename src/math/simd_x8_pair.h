// SPDX-License-Identifier: MIT
//
// Eight floats in two registers of four: SSE4.2, NEON and simd128.

#ifndef TALUS_SRC_MATH_SIMD_X8_PAIR_H
#define TALUS_SRC_MATH_SIMD_X8_PAIR_H

#include "math/simd.h"

typedef struct tl_f32x8 {
    tl_f32x4 low, high;
} tl_f32x8;

static inline tl_f32x8 tl_f32x8_join(tl_f32x4 low, tl_f32x4 high)
{
    tl_f32x8 r = { low, high };
    return r;
}

static inline tl_f32x8 tl_f32x8_all(float value)
{
    return tl_f32x8_join(tl_f32x4_all(value), tl_f32x4_all(value));
}

static inline tl_f32x8 tl_f32x8_load(const float *eight)
{
    return tl_f32x8_join(tl_f32x4_load(eight), tl_f32x4_load(eight + 4));
}

static inline tl_f32x8 tl_f32x8_from_bytes(const uint8_t *eight)
{
    tl_f32x8 r;
    tl_f32x4_two_from_bytes(eight, &r.low, &r.high);
    return r;
}

static inline tl_f32x4 tl_f32x8_low(tl_f32x8 a)
{
    return a.low;
}

static inline float tl_f32x8_first(tl_f32x8 a)
{
    return tl_f32x4_get_x(a.low);
}

static inline tl_f32x8 tl_f32x8_largest(tl_f32x8 a)
{
    tl_f32x4 m = tl_f32x4_largest(tl_f32x4_max(a.low, a.high));
    return tl_f32x8_join(m, m);
}

static inline tl_f32x8 tl_f32x8_load_twice(const float *four)
{
    tl_f32x4 v = tl_f32x4_load(four);
    return tl_f32x8_join(v, v);
}

static inline tl_f32x8 tl_f32x8_load_halves(const float *low, const float *high)
{
    return tl_f32x8_join(tl_f32x4_load(low), tl_f32x4_load(high));
}

static inline tl_f32x8 tl_f32x8_swap_halves(tl_f32x8 a)
{
    return tl_f32x8_join(a.high, a.low);
}

static inline void tl_f32x8_transpose(tl_f32x8 rows[4])
{
    tl_f32x4_transpose(&rows[0].low, &rows[1].low, &rows[2].low, &rows[3].low);
    tl_f32x4_transpose(&rows[0].high, &rows[1].high, &rows[2].high, &rows[3].high);
}

static inline tl_f32x8 tl_f32x8_add(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_add(a.low, b.low), tl_f32x4_add(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_sub(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_sub(a.low, b.low), tl_f32x4_sub(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_mul(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_mul(a.low, b.low), tl_f32x4_mul(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_div(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_div(a.low, b.low), tl_f32x4_div(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_min(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_min(a.low, b.low), tl_f32x4_min(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_max(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_max(a.low, b.low), tl_f32x4_max(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_min_bits(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_min_bits(a.low, b.low), tl_f32x4_min_bits(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_max_bits(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_max_bits(a.low, b.low), tl_f32x4_max_bits(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_and(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_and(a.low, b.low), tl_f32x4_and(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_or(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_or(a.low, b.low), tl_f32x4_or(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_mul_add(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return tl_f32x8_join(tl_f32x4_mul_add(a.low, b.low, c.low), tl_f32x4_mul_add(a.high, b.high, c.high));
}

static inline tl_f32x8 tl_f32x8_mul_sub_from(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return tl_f32x8_join(tl_f32x4_mul_sub_from(a.low, b.low, c.low), tl_f32x4_mul_sub_from(a.high, b.high, c.high));
}

static inline tl_f32x8 tl_f32x8_if_less(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c, tl_f32x8 d)
{
    return tl_f32x8_join(tl_f32x4_if_less(a.low, b.low, c.low, d.low),
                         tl_f32x4_if_less(a.high, b.high, c.high, d.high));
}

static inline tl_f32x8 tl_f32x8_choose(uint32_t mask, tl_f32x8 a, tl_f32x8 b)
{
    static const float signs[16][4] = {
        { 1, 1, 1, 1 },   { -1, 1, 1, 1 },   { 1, -1, 1, 1 },   { -1, -1, 1, 1 },   { 1, 1, -1, 1 },  { -1, 1, -1, 1 },
        { 1, -1, -1, 1 }, { -1, -1, -1, 1 }, { 1, 1, 1, -1 },   { -1, 1, 1, -1 },   { 1, -1, 1, -1 }, { -1, -1, 1, -1 },
        { 1, 1, -1, -1 }, { -1, 1, -1, -1 }, { 1, -1, -1, -1 }, { -1, -1, -1, -1 },
    };
    tl_f32x4 zero = tl_f32x4_all(0.0f);
    return tl_f32x8_join(tl_f32x4_if_less(tl_f32x4_load(signs[mask & 15u]), zero, a.low, b.low),
                         tl_f32x4_if_less(tl_f32x4_load(signs[mask >> 4 & 15u]), zero, a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_abs(tl_f32x8 a)
{
    return tl_f32x8_join(tl_f32x4_abs(a.low), tl_f32x4_abs(a.high));
}

static inline uint32_t tl_f32x8_signs(tl_f32x8 a)
{
    return tl_f32x4_two_signs(a.low, a.high);
}

static inline uint32_t tl_f32x8_less(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x4_two_masks(tl_f32x4_where_less(a.low, b.low), tl_f32x4_where_less(a.high, b.high));
}

static inline uint32_t tl_f32x8_not_less(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x4_two_not_less(a.low, b.low, a.high, b.high);
}

static inline uint32_t tl_f32x8_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x4_two_masks(tl_f32x4_where_less_bits(a.low, b.low), tl_f32x4_where_less_bits(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_where_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_join(tl_f32x4_where_less_bits(a.low, b.low), tl_f32x4_where_less_bits(a.high, b.high));
}

static inline uint32_t tl_f32x8_least_bits(tl_f32x8 a)
{
    tl_f32x4 least = tl_f32x4_min_bits(a.low, a.high);
    static const uint32_t turned[4] = { 2, 3, 0, 1 }, swapped[4] = { 1, 0, 3, 2 };
    least = tl_f32x4_min_bits(least, tl_f32x4_permute(least, turned));
    float first = tl_f32x4_get_x(tl_f32x4_min_bits(least, tl_f32x4_permute(least, swapped)));
    uint32_t bits;
    memcpy(&bits, &first, sizeof bits);
    return bits;
}

static inline void tl_f32x8_store(float *eight, tl_f32x8 a)
{
    tl_f32x4_store(eight, a.low);
    tl_f32x4_store(eight + 4, a.high);
}

#endif
