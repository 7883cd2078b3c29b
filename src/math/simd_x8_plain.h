// SPDX-License-Identifier: MIT
//
// Eight floats in plain C: what the operations mean, as in simd_x4_plain.h.
//
// Names with `bits` take the bits of a float as a signed integer. Of numbers that are not negative these have the order
// of the values, and any negative one lies below them; comparing them takes one cycle where floats take four.

#ifndef TALUS_SRC_MATH_SIMD_X8_PLAIN_H
#define TALUS_SRC_MATH_SIMD_X8_PLAIN_H

#include "math/simd.h"

typedef struct tl_f32x8 {
    float v[8];
} tl_f32x8;

static inline tl_f32x8 tl_f32x8_all(float value)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = value;
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_load(const float *eight)
{
    tl_f32x8 r;
    memcpy(r.v, eight, sizeof r.v);
    return r;
}

static inline tl_f32x8 tl_f32x8_from_bytes(const uint8_t *eight)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = (float)eight[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_join(tl_f32x4 low, tl_f32x4 high)
{
    tl_f32x8 r;
    memcpy(r.v, low.v, sizeof low.v);
    memcpy(r.v + 4, high.v, sizeof high.v);
    return r;
}

static inline tl_f32x4 tl_f32x8_low(tl_f32x8 a)
{
    tl_f32x4 r;
    memcpy(r.v, a.v, sizeof r.v);
    return r;
}

/// The first lane.
static inline float tl_f32x8_first(tl_f32x8 a)
{
    return a.v[0];
}

/// The largest lane, in all lanes. They are numbers; which zero is the larger is open.
static inline tl_f32x8 tl_f32x8_largest(tl_f32x8 a)
{
    float largest = a.v[0];
    for (int i = 1; i < 8; i++) {
        largest = a.v[i] > largest ? a.v[i] : largest;
    }
    return tl_f32x8_all(largest);
}

static inline tl_f32x8 tl_f32x8_load_halves(const float *low, const float *high)
{
    tl_f32x8 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = low[i];
        r.v[4 + i] = high[i];
    }
    return r;
}

/// Four floats in each half.
static inline tl_f32x8 tl_f32x8_load_twice(const float *four)
{
    return tl_f32x8_load_halves(four, four);
}

static inline tl_f32x8 tl_f32x8_swap_halves(tl_f32x8 a)
{
    return tl_f32x8_load_halves(a.v + 4, a.v);
}

/// In each half, lane i of vector k becomes lane k of vector i.
static inline void tl_f32x8_transpose(tl_f32x8 rows[4])
{
    for (int half = 0; half < 8; half += 4) {
        for (int i = 0; i < 4; i++) {
            for (int k = 0; k < i; k++) {
                float swap = rows[i].v[half + k];
                rows[i].v[half + k] = rows[k].v[half + i];
                rows[k].v[half + i] = swap;
            }
        }
    }
}

static inline tl_f32x8 tl_f32x8_min(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_sub(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] - b.v[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_mul(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] * b.v[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_add(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] + b.v[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_div(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] / b.v[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_mul_add(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return tl_f32x8_add(tl_f32x8_mul(a, b), c);
}

/// c - a b.
static inline tl_f32x8 tl_f32x8_mul_sub_from(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return tl_f32x8_sub(c, tl_f32x8_mul(a, b));
}

static inline int32_t tl_f32_key(float value)
{
    int32_t key;
    memcpy(&key, &value, sizeof key);
    return key;
}

static inline tl_f32x8 tl_f32x8_min_bits(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_f32_key(a.v[i]) < tl_f32_key(b.v[i]) ? a.v[i] : b.v[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_max_bits(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_f32_key(a.v[i]) > tl_f32_key(b.v[i]) ? a.v[i] : b.v[i];
    }
    return r;
}

/// Bit i: a[i] < b[i], as bits.
static inline uint32_t tl_f32x8_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t)(tl_f32_key(a.v[i]) < tl_f32_key(b.v[i])) << i;
    }
    return mask;
}

/// All ones where a[i] < b[i], as bits, else 0.
static inline tl_f32x8 tl_f32x8_where_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_f32_of_bits(tl_f32_key(a.v[i]) < tl_f32_key(b.v[i]) ? UINT32_MAX : 0);
    }
    return r;
}

/// The least lane, as bits.
static inline uint32_t tl_f32x8_least_bits(tl_f32x8 a)
{
    int32_t least = tl_f32_key(a.v[0]);
    for (int i = 1; i < 8; i++) {
        least = tl_f32_key(a.v[i]) < least ? tl_f32_key(a.v[i]) : least;
    }
    return (uint32_t)least;
}

static inline tl_f32x8 tl_f32x8_and(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_f32_of_bits(tl_f32_bits(a.v[i]) & tl_f32_bits(b.v[i]));
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_or(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_f32_of_bits(tl_f32_bits(a.v[i]) | tl_f32_bits(b.v[i]));
    }
    return r;
}

/// Bit i: a[i] has its sign bit set.
static inline uint32_t tl_f32x8_signs(tl_f32x8 a)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t)(tl_f32_key(a.v[i]) < 0) << i;
    }
    return mask;
}

static inline tl_f32x8 tl_f32x8_max(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    }
    return r;
}

/// Bit i: not a[i] < b[i], so true for NaN.
static inline uint32_t tl_f32x8_not_less(tl_f32x8 a, tl_f32x8 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t) !(a.v[i] < b.v[i]) << i;
    }
    return mask;
}

/// Lane i: a[i] < b[i] ? c[i] : d[i].
static inline tl_f32x8 tl_f32x8_if_less(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c, tl_f32x8 d)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] < b.v[i] ? c.v[i] : d.v[i];
    }
    return r;
}

/// Lane i is a[i] where bit i of the mask is set, else b[i]. Higher bits do not count.
static inline tl_f32x8 tl_f32x8_choose(uint32_t mask, tl_f32x8 a, tl_f32x8 b)
{
    for (int i = 0; i < 8; i++) {
        a.v[i] = (mask >> i & 1u) != 0 ? a.v[i] : b.v[i];
    }
    return a;
}

static inline tl_f32x8 tl_f32x8_abs(tl_f32x8 a)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_f32_of_bits(tl_f32_bits(a.v[i]) & 0x7fffffffu);
    }
    return r;
}

static inline void tl_f32x8_store(float *eight, tl_f32x8 a)
{
    memcpy(eight, a.v, sizeof a.v);
}

/// Bit i: a[i] < b[i], so false for NaN.
static inline uint32_t tl_f32x8_less(tl_f32x8 a, tl_f32x8 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t)(a.v[i] < b.v[i]) << i;
    }
    return mask;
}

#endif
