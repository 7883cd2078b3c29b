// SPDX-License-Identifier: MIT
//
// A small vocabulary of vectors. A kernel is written once over it and compiled once per instruction set; simd_target.h
// chooses the branch below. Names say element and lanes: tl_f32x8 is eight floats.
//
// A file that chooses none gets plain C whatever its compiler flags are: the twin that every other branch is compared
// with. `tl_*_mul_add` is fused where the instruction set has it and rounded twice where it has not, so it is only for
// values whose error bound covers both.

#ifndef TALUS_SRC_MATH_SIMD_H
#define TALUS_SRC_MATH_SIMD_H

#include "base/compiler.h"

#include <stdint.h>
#include <string.h>

#ifndef TL_SIMD_LEVEL
#define TL_SIMD_LEVEL 0
#endif

#if TL_SIMD_LEVEL > 0
#include <immintrin.h>
#endif

// ----------------------------------------------------------------------------------------------- four floats

#if TL_SIMD_LEVEL >= 1

typedef __m128 tl_f32x4;

static inline tl_f32x4 tl_f32x4_all(float value)
{
    return _mm_set1_ps(value);
}

static inline tl_f32x4 tl_f32x4_make(float x, float y, float z, float w)
{
    return _mm_setr_ps(x, y, z, w);
}

static inline tl_f32x4 tl_f32x4_load(const float *four)
{
    return _mm_loadu_ps(four);
}

/// The fourth lane is 0. A load for each float: callers store them one by one just before, and a wider load would wait
/// until those stores have reached the cache.
static inline tl_f32x4 tl_f32x4_load_three(const float *three)
{
    __m128 y = _mm_load_ss(three + 1);
    TL_KEEP_VECTOR(y); // or clang joins it with its neighbour
    __m128 xy = _mm_insert_ps(_mm_load_ss(three), y, 0x10);
    return _mm_insert_ps(xy, _mm_load_ss(three + 2), 0x20);
}

static inline float tl_f32x4_get_x(tl_f32x4 a)
{
    return _mm_cvtss_f32(a);
}

static inline float tl_f32x4_get_y(tl_f32x4 a)
{
    return _mm_cvtss_f32(_mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 1, 1, 1)));
}

static inline float tl_f32x4_get_z(tl_f32x4 a)
{
    return _mm_cvtss_f32(_mm_shuffle_ps(a, a, _MM_SHUFFLE(2, 2, 2, 2)));
}

/// Lane i: a[order[i]].
static inline tl_f32x4 tl_f32x4_permute(tl_f32x4 a, const uint32_t *order)
{
    __m128i lanes = _mm_loadu_si128((const __m128i *)(const void *)order);
#if TL_SIMD_LEVEL >= 2
    return _mm_permutevar_ps(a, lanes);
#else
    // Four bytes a lane.
    __m128i first = _mm_mullo_epi32(lanes, _mm_set1_epi32(0x04040404));
    __m128i bytes = _mm_add_epi32(first, _mm_set1_epi32(0x03020100));
    return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(a), bytes));
#endif
}

static inline tl_f32x4 tl_f32x4_add(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_add_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_sub(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_sub_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_mul(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_mul_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_div(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_div_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_max(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_max_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_or(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_or_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_neg(tl_f32x4 a)
{
    return _mm_xor_ps(_mm_set1_ps(-0.0f), a);
}

static inline tl_f32x4 tl_f32x4_mul_add(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
#if TL_SIMD_LEVEL >= 2
    return _mm_fmadd_ps(a, b, c);
#else
    return _mm_add_ps(_mm_mul_ps(a, b), c);
#endif
}

/// c - a b.
static inline tl_f32x4 tl_f32x4_mul_sub_from(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
#if TL_SIMD_LEVEL >= 2
    return _mm_fnmadd_ps(a, b, c);
#else
    return _mm_sub_ps(c, _mm_mul_ps(a, b));
#endif
}

/// Lane i: b[i] where signs[i] has its sign bit set, a[i] elsewhere.
static inline tl_f32x4 tl_f32x4_choose(tl_f32x4 signs, tl_f32x4 a, tl_f32x4 b)
{
    return _mm_blendv_ps(a, b, signs);
}

static inline tl_f32x4 tl_f32x4_abs(tl_f32x4 a)
{
    return _mm_andnot_ps(_mm_set1_ps(-0.0f), a);
}

/// Lane i: a[i] < b[i] ? c[i] : d[i].
static inline tl_f32x4 tl_f32x4_if_less(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    return _mm_blendv_ps(d, c, _mm_cmplt_ps(a, b));
}

/// Bit i: a[i] <= b[i], so false for NaN.
static inline uint32_t tl_f32x4_less_equal(tl_f32x4 a, tl_f32x4 b)
{
    return (uint32_t)_mm_movemask_ps(_mm_cmple_ps(a, b));
}

/// Bit i: a[i] <= b[i] and b[i] <= c[i], so false for NaN.
static inline uint32_t tl_f32x4_ascending(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return (uint32_t)_mm_movemask_ps(_mm_and_ps(_mm_cmple_ps(a, b), _mm_cmple_ps(b, c)));
}

/// Bit i: a[i] has its sign bit set.
static inline uint32_t tl_f32x4_signs(tl_f32x4 a)
{
    return (uint32_t)_mm_movemask_ps(a);
}

static inline void tl_f32x4_store(float *four, tl_f32x4 a)
{
    _mm_storeu_ps(four, a);
}

/// The largest of the first three lanes, in all lanes.
static inline tl_f32x4 tl_f32x4_max_of_three(tl_f32x4 a)
{
    __m128 y = _mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 1, 1, 1));
    __m128 z = _mm_shuffle_ps(a, a, _MM_SHUFFLE(2, 2, 2, 2));
    __m128 m = _mm_max_ps(_mm_max_ps(a, y), z);
    return _mm_shuffle_ps(m, m, _MM_SHUFFLE(0, 0, 0, 0));
}

/// The smallest of the first three lanes.
static inline float tl_f32x4_least_of_three(tl_f32x4 a)
{
    __m128 y = _mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 1, 1, 1));
    __m128 z = _mm_shuffle_ps(a, a, _MM_SHUFFLE(2, 2, 2, 2));
    return _mm_cvtss_f32(_mm_min_ss(_mm_min_ss(a, y), z));
}

#else

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

static inline tl_f32x4 tl_f32x4_load_three(const float *three)
{
    return tl_f32x4_make(three[0], three[1], three[2], 0.0f);
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

static inline tl_f32x4 tl_f32x4_permute(tl_f32x4 a, const uint32_t *order)
{
    return tl_f32x4_make(a.v[order[0]], a.v[order[1]], a.v[order[2]], a.v[order[3]]);
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

static inline tl_f32x4 tl_f32x4_max(tl_f32x4 a, tl_f32x4 b)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    }
    return r;
}

static inline uint32_t tl_f32_bits(float a)
{
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

static inline tl_f32x4 tl_f32x4_or(tl_f32x4 a, tl_f32x4 b)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        uint32_t bits = tl_f32_bits(a.v[i]) | tl_f32_bits(b.v[i]);
        memcpy(&r.v[i], &bits, sizeof bits);
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

static inline tl_f32x4 tl_f32x4_mul_sub_from(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return tl_f32x4_sub(c, tl_f32x4_mul(a, b));
}

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
        uint32_t bits;
        memcpy(&bits, &a.v[i], sizeof bits);
        bits &= 0x7fffffffu;
        memcpy(&r.v[i], &bits, sizeof bits);
    }
    return r;
}

static inline tl_f32x4 tl_f32x4_if_less(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    tl_f32x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] < b.v[i] ? c.v[i] : d.v[i];
    }
    return r;
}

static inline uint32_t tl_f32x4_less_equal(tl_f32x4 a, tl_f32x4 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 4; i++) {
        mask |= (uint32_t)(a.v[i] <= b.v[i]) << i;
    }
    return mask;
}

static inline uint32_t tl_f32x4_ascending(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return tl_f32x4_less_equal(a, b) & tl_f32x4_less_equal(b, c);
}

static inline uint32_t tl_f32x4_signs(tl_f32x4 a)
{
    uint32_t mask = 0;
    for (int i = 0; i < 4; i++) {
        uint32_t bits;
        memcpy(&bits, &a.v[i], sizeof bits);
        mask |= (bits >> 31) << i;
    }
    return mask;
}

static inline void tl_f32x4_store(float *four, tl_f32x4 a)
{
    memcpy(four, a.v, sizeof a.v);
}

static inline tl_f32x4 tl_f32x4_max_of_three(tl_f32x4 a)
{
    float xy = a.v[0] > a.v[1] ? a.v[0] : a.v[1];
    return tl_f32x4_all(xy > a.v[2] ? xy : a.v[2]);
}

static inline float tl_f32x4_least_of_three(tl_f32x4 a)
{
    float xy = a.v[0] < a.v[1] ? a.v[0] : a.v[1];
    return xy < a.v[2] ? xy : a.v[2];
}

#endif

#endif
