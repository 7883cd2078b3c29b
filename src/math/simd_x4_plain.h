// SPDX-License-Identifier: MIT
//
// Four floats in plain C. What an operation means is what it does here: the other branches give the same bits, NaN
// and -0 included, except where an operation says what it leaves open.

#ifndef TALUS_SRC_MATH_SIMD_X4_PLAIN_H
#define TALUS_SRC_MATH_SIMD_X4_PLAIN_H

#include <math.h>
#include <stdint.h>
#include <string.h>

static inline uint32_t tl_f32_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline float tl_f32_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

typedef struct tl_f32x4 {
    float v[4];
} tl_f32x4;

static inline tl_f32x4 tl_f32x4_make(float x, float y, float z, float w)
{
    tl_f32x4 r = { { x, y, z, w } };
    return r;
}

static inline tl_f32x4 tl_f32x4_all(float value)
{
    return tl_f32x4_make(value, value, value, value);
}

static inline tl_f32x4 tl_f32x4_load(const float *four)
{
    return tl_f32x4_make(four[0], four[1], four[2], four[3]);
}

/// The fourth lane is 0.
static inline tl_f32x4 tl_f32x4_load_three(const float *three)
{
    return tl_f32x4_make(three[0], three[1], three[2], 0.0f);
}

/// Floats from anywhere.
static inline tl_f32x4 tl_f32x4_gather_four(const float *x, const float *y, const float *z, const float *w)
{
    return tl_f32x4_make(*x, *y, *z, *w);
}

static inline float tl_f32x4_get_x(tl_f32x4 a)
{
    return a.v[0];
}

static inline float tl_f32x4_get_y(tl_f32x4 a)
{
    return a.v[1];
}

static inline float tl_f32x4_get_z(tl_f32x4 a)
{
    return a.v[2];
}

/// Lane i: a[order[i]].
static inline tl_f32x4 tl_f32x4_permute(tl_f32x4 a, const uint32_t *order)
{
    return tl_f32x4_make(a.v[order[0]], a.v[order[1]], a.v[order[2]], a.v[order[3]]);
}

/// Lanes 1, 2, 0, 3.
static inline tl_f32x4 tl_f32x4_rotate_three(tl_f32x4 a)
{
    return tl_f32x4_make(a.v[1], a.v[2], a.v[0], a.v[3]);
}

static inline tl_f32x4 tl_f32x4_add(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_make(a.v[0] + b.v[0], a.v[1] + b.v[1], a.v[2] + b.v[2], a.v[3] + b.v[3]);
}

static inline tl_f32x4 tl_f32x4_sub(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_make(a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2], a.v[3] - b.v[3]);
}

static inline tl_f32x4 tl_f32x4_mul(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_make(a.v[0] * b.v[0], a.v[1] * b.v[1], a.v[2] * b.v[2], a.v[3] * b.v[3]);
}

static inline tl_f32x4 tl_f32x4_div(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_make(a.v[0] / b.v[0], a.v[1] / b.v[1], a.v[2] / b.v[2], a.v[3] / b.v[3]);
}

static inline tl_f32x4 tl_f32x4_sqrt(tl_f32x4 a)
{
    return tl_f32x4_make(sqrtf(a.v[0]), sqrtf(a.v[1]), sqrtf(a.v[2]), sqrtf(a.v[3]));
}

static inline tl_f32x4 tl_f32x4_max(tl_f32x4 a, tl_f32x4 b)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    }
    return r;
}

static inline tl_f32x4 tl_f32x4_min(tl_f32x4 a, tl_f32x4 b)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i];
    }
    return r;
}

static inline tl_f32x4 tl_f32x4_or(tl_f32x4 a, tl_f32x4 b)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = tl_f32_of_bits(tl_f32_bits(a.v[i]) | tl_f32_bits(b.v[i]));
    }
    return r;
}

static inline tl_f32x4 tl_f32x4_neg(tl_f32x4 a)
{
    return tl_f32x4_make(-a.v[0], -a.v[1], -a.v[2], -a.v[3]);
}

static inline tl_f32x4 tl_f32x4_mul_add(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return tl_f32x4_add(tl_f32x4_mul(a, b), c);
}

/// c - a b.
static inline tl_f32x4 tl_f32x4_mul_sub_from(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return tl_f32x4_sub(c, tl_f32x4_mul(a, b));
}

/// Lane i: b[i] where signs[i] has its sign bit set, a[i] elsewhere.
static inline tl_f32x4 tl_f32x4_choose(tl_f32x4 signs, tl_f32x4 a, tl_f32x4 b)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = tl_f32_bits(signs.v[i]) >> 31 ? b.v[i] : a.v[i];
    }
    return r;
}

static inline tl_f32x4 tl_f32x4_abs(tl_f32x4 a)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = tl_f32_of_bits(tl_f32_bits(a.v[i]) & 0x7fffffffu);
    }
    return r;
}

/// Lane i: a[i] < b[i] ? c[i] : d[i].
static inline tl_f32x4 tl_f32x4_if_less(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] < b.v[i] ? c.v[i] : d.v[i];
    }
    return r;
}

/// Bit i: a[i] <= b[i], so false for NaN.
static inline uint32_t tl_f32x4_less_equal(tl_f32x4 a, tl_f32x4 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 4; i++) {
        mask |= (uint32_t)(a.v[i] <= b.v[i]) << i;
    }
    return mask;
}

/// Bit i: a[i] <= b[i] and b[i] <= c[i], so false for NaN.
static inline uint32_t tl_f32x4_ascending(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return tl_f32x4_less_equal(a, b) & tl_f32x4_less_equal(b, c);
}

/// Bit i: a[i] has its sign bit set.
static inline uint32_t tl_f32x4_signs(tl_f32x4 a)
{
    uint32_t mask = 0;
    for (int i = 0; i < 4; i++) {
        mask |= (tl_f32_bits(a.v[i]) >> 31) << i;
    }
    return mask;
}

static inline void tl_f32x4_store(float *four, tl_f32x4 a)
{
    memcpy(four, a.v, sizeof a.v);
}

/// Without their fractions; each within the range of an int32_t.
static inline void tl_f32x4_store_whole(int32_t *four, tl_f32x4 a)
{
    for (int i = 0; i < 4; i++) {
        four[i] = (int32_t)a.v[i];
    }
}

/// The largest of the first three lanes, in all lanes.
static inline tl_f32x4 tl_f32x4_max_of_three(tl_f32x4 a)
{
    float xy = a.v[0] > a.v[1] ? a.v[0] : a.v[1];
    return tl_f32x4_all(xy > a.v[2] ? xy : a.v[2]);
}

/// The smallest of the first three lanes.
static inline float tl_f32x4_least_of_three(tl_f32x4 a)
{
    float xy = a.v[0] < a.v[1] ? a.v[0] : a.v[1];
    return xy < a.v[2] ? xy : a.v[2];
}

/// { a[0], b[0], a[1], b[1] }.
static inline tl_f32x4 tl_f32x4_zip_low(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_make(a.v[0], b.v[0], a.v[1], b.v[1]);
}

/// { a[2], b[2], a[3], b[3] }.
static inline tl_f32x4 tl_f32x4_zip_high(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_make(a.v[2], b.v[2], a.v[3], b.v[3]);
}

/// { a[2], a[2], b[0], b[1] }.
static inline tl_f32x4 tl_f32x4_twice_z_and_low(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_make(a.v[2], a.v[2], b.v[0], b.v[1]);
}

/// { a[2], a[2], b[2], b[3] }.
static inline tl_f32x4 tl_f32x4_twice_z_and_high(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_make(a.v[2], a.v[2], b.v[2], b.v[3]);
}

static inline void tl_f32x4_transpose(tl_f32x4 *a, tl_f32x4 *b, tl_f32x4 *c, tl_f32x4 *d)
{
    tl_f32x4 *rows[4] = { a, b, c, d };
    for (int i = 1; i < 4; i++) {
        for (int j = 0; j < i; j++) {
            float kept = rows[i]->v[j];
            rows[i]->v[j] = rows[j]->v[i];
            rows[j]->v[i] = kept;
        }
    }
}

#endif
