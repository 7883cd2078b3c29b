// SPDX-License-Identifier: MIT
//
// The vocabulary of simd.h, eight floats wide: one register with AVX2, two of four with SSE4.2.
//
// Names with `bits` take the bits of a float as a signed integer. Of numbers that are not negative these have the order
// of the values, and any negative one lies below them; comparing them takes one cycle where floats take four.

#ifndef TALUS_SRC_MATH_SIMD8_H
#define TALUS_SRC_MATH_SIMD8_H

#include "math/simd.h"

#if TL_SIMD_LEVEL >= 2

typedef __m256 tl_f32x8;

static inline tl_f32x8 tl_f32x8_all(float value)
{
    return _mm256_set1_ps(value);
}

static inline tl_f32x8 tl_f32x8_load(const float *eight)
{
    return _mm256_loadu_ps(eight);
}

static inline tl_f32x8 tl_f32x8_from_bytes(const uint8_t *eight)
{
    return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(const void *)eight)));
}

/// The first lane.
static inline float tl_f32x8_first(tl_f32x8 a)
{
    return _mm256_cvtss_f32(a);
}

/// The largest lane, in all lanes.
static inline tl_f32x8 tl_f32x8_largest(tl_f32x8 a)
{
    __m256 m = _mm256_max_ps(a, _mm256_permute2f128_ps(a, a, 1));
    m = _mm256_max_ps(m, _mm256_permute_ps(m, _MM_SHUFFLE(1, 0, 3, 2)));
    return _mm256_max_ps(m, _mm256_permute_ps(m, _MM_SHUFFLE(2, 3, 0, 1)));
}

/// Four floats in each half.
static inline tl_f32x8 tl_f32x8_load_twice(const float *four)
{
    return _mm256_broadcast_ps((const __m128 *)(const void *)four);
}

static inline tl_f32x8 tl_f32x8_load_halves(const float *low, const float *high)
{
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
}

static inline tl_f32x8 tl_f32x8_swap_halves(tl_f32x8 a)
{
    return _mm256_permute2f128_ps(a, a, 1);
}

/// In each half, lane i of vector k becomes lane k of vector i.
static inline void tl_f32x8_transpose(tl_f32x8 rows[4])
{
    __m256 a = _mm256_unpacklo_ps(rows[0], rows[1]), b = _mm256_unpacklo_ps(rows[2], rows[3]);
    __m256 c = _mm256_unpackhi_ps(rows[0], rows[1]), d = _mm256_unpackhi_ps(rows[2], rows[3]);
    rows[0] = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 1, 0));
    rows[1] = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(3, 2, 3, 2));
    rows[2] = _mm256_shuffle_ps(c, d, _MM_SHUFFLE(1, 0, 1, 0));
    rows[3] = _mm256_shuffle_ps(c, d, _MM_SHUFFLE(3, 2, 3, 2));
}

static inline tl_f32x8 tl_f32x8_min(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_min_ps(a, b);
}

static inline tl_f32x8 tl_f32x8_sub(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_sub_ps(a, b);
}

static inline tl_f32x8 tl_f32x8_mul(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_mul_ps(a, b);
}

static inline tl_f32x8 tl_f32x8_add(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_add_ps(a, b);
}

static inline tl_f32x8 tl_f32x8_div(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_div_ps(a, b);
}

static inline tl_f32x8 tl_f32x8_mul_add(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return _mm256_fmadd_ps(a, b, c);
}

/// c - a b.
static inline tl_f32x8 tl_f32x8_mul_sub_from(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return _mm256_fnmadd_ps(a, b, c);
}

static inline tl_f32x8 tl_f32x8_min_bits(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_castsi256_ps(_mm256_min_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
}

static inline tl_f32x8 tl_f32x8_max_bits(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_castsi256_ps(_mm256_max_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
}

/// Bit i: a[i] < b[i], as bits.
static inline uint32_t tl_f32x8_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    __m256i less = _mm256_cmpgt_epi32(_mm256_castps_si256(b), _mm256_castps_si256(a));
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(less));
}

static inline tl_f32x8 tl_f32x8_and(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_and_ps(a, b);
}

static inline tl_f32x8 tl_f32x8_or(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_or_ps(a, b);
}

/// Bit i: a[i] has its sign bit set.
static inline uint32_t tl_f32x8_signs(tl_f32x8 a)
{
    return (uint32_t)_mm256_movemask_ps(a);
}

static inline tl_f32x8 tl_f32x8_max(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_max_ps(a, b);
}

/// Bit i: not a[i] < b[i], so true for NaN.
static inline uint32_t tl_f32x8_not_less(tl_f32x8 a, tl_f32x8 b)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_NLT_UQ));
}

/// Lane i: a[i] < b[i] ? c[i] : d[i].
static inline tl_f32x8 tl_f32x8_if_less(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c, tl_f32x8 d)
{
    return _mm256_blendv_ps(d, c, _mm256_cmp_ps(a, b, _CMP_LT_OQ));
}

static inline tl_f32x8 tl_f32x8_abs(tl_f32x8 a)
{
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a);
}

static inline void tl_f32x8_store(float *eight, tl_f32x8 a)
{
    _mm256_storeu_ps(eight, a);
}

/// Bit i: a[i] < b[i], so false for NaN.
static inline uint32_t tl_f32x8_less(tl_f32x8 a, tl_f32x8 b)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
}

#elif TL_SIMD_LEVEL == 1

typedef struct tl_f32x8 {
    __m128 low, high;
} tl_f32x8;

static inline tl_f32x8 tl_f32x8_make(__m128 low, __m128 high)
{
    tl_f32x8 r = { low, high };
    return r;
}

static inline tl_f32x8 tl_f32x8_all(float value)
{
    return tl_f32x8_make(_mm_set1_ps(value), _mm_set1_ps(value));
}

static inline tl_f32x8 tl_f32x8_load(const float *eight)
{
    return tl_f32x8_make(_mm_loadu_ps(eight), _mm_loadu_ps(eight + 4));
}

static inline __m128 tl_f32x4_from_bytes(const uint8_t *four)
{
    int32_t bytes;
    memcpy(&bytes, four, sizeof bytes);
    return _mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(bytes)));
}

static inline tl_f32x8 tl_f32x8_from_bytes(const uint8_t *eight)
{
    return tl_f32x8_make(tl_f32x4_from_bytes(eight), tl_f32x4_from_bytes(eight + 4));
}

static inline float tl_f32x8_first(tl_f32x8 a)
{
    return _mm_cvtss_f32(a.low);
}

static inline tl_f32x8 tl_f32x8_largest(tl_f32x8 a)
{
    __m128 m = _mm_max_ps(a.low, a.high);
    m = _mm_max_ps(m, _mm_shuffle_ps(m, m, _MM_SHUFFLE(1, 0, 3, 2)));
    m = _mm_max_ps(m, _mm_shuffle_ps(m, m, _MM_SHUFFLE(2, 3, 0, 1)));
    return tl_f32x8_make(m, m);
}

static inline tl_f32x8 tl_f32x8_load_twice(const float *four)
{
    __m128 v = _mm_loadu_ps(four);
    return tl_f32x8_make(v, v);
}

static inline tl_f32x8 tl_f32x8_load_halves(const float *low, const float *high)
{
    return tl_f32x8_make(_mm_loadu_ps(low), _mm_loadu_ps(high));
}

static inline tl_f32x8 tl_f32x8_swap_halves(tl_f32x8 a)
{
    return tl_f32x8_make(a.high, a.low);
}

static inline void tl_f32x8_transpose(tl_f32x8 rows[4])
{
    _MM_TRANSPOSE4_PS(rows[0].low, rows[1].low, rows[2].low, rows[3].low);
    _MM_TRANSPOSE4_PS(rows[0].high, rows[1].high, rows[2].high, rows[3].high);
}

static inline tl_f32x8 tl_f32x8_min(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(_mm_min_ps(a.low, b.low), _mm_min_ps(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_sub(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(_mm_sub_ps(a.low, b.low), _mm_sub_ps(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_mul(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(_mm_mul_ps(a.low, b.low), _mm_mul_ps(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_add(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(_mm_add_ps(a.low, b.low), _mm_add_ps(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_div(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(_mm_div_ps(a.low, b.low), _mm_div_ps(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_mul_add(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return tl_f32x8_add(tl_f32x8_mul(a, b), c);
}

static inline tl_f32x8 tl_f32x8_mul_sub_from(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return tl_f32x8_sub(c, tl_f32x8_mul(a, b));
}

static inline __m128 tl_f32x4_min_bits(__m128 a, __m128 b)
{
    return _mm_castsi128_ps(_mm_min_epi32(_mm_castps_si128(a), _mm_castps_si128(b)));
}

static inline __m128 tl_f32x4_max_bits(__m128 a, __m128 b)
{
    return _mm_castsi128_ps(_mm_max_epi32(_mm_castps_si128(a), _mm_castps_si128(b)));
}

static inline uint32_t tl_f32x4_less_bits(__m128 a, __m128 b)
{
    __m128i less = _mm_cmplt_epi32(_mm_castps_si128(a), _mm_castps_si128(b));
    return (uint32_t)_mm_movemask_ps(_mm_castsi128_ps(less));
}

static inline tl_f32x8 tl_f32x8_min_bits(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(tl_f32x4_min_bits(a.low, b.low), tl_f32x4_min_bits(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_max_bits(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(tl_f32x4_max_bits(a.low, b.low), tl_f32x4_max_bits(a.high, b.high));
}

static inline uint32_t tl_f32x8_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x4_less_bits(a.low, b.low) | tl_f32x4_less_bits(a.high, b.high) << 4;
}

static inline tl_f32x8 tl_f32x8_and(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(_mm_and_ps(a.low, b.low), _mm_and_ps(a.high, b.high));
}

static inline tl_f32x8 tl_f32x8_or(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(_mm_or_ps(a.low, b.low), _mm_or_ps(a.high, b.high));
}

static inline uint32_t tl_f32x8_signs(tl_f32x8 a)
{
    return (uint32_t)_mm_movemask_ps(a.low) | (uint32_t)_mm_movemask_ps(a.high) << 4;
}

static inline tl_f32x8 tl_f32x8_max(tl_f32x8 a, tl_f32x8 b)
{
    return tl_f32x8_make(_mm_max_ps(a.low, b.low), _mm_max_ps(a.high, b.high));
}

static inline uint32_t tl_f32x8_not_less(tl_f32x8 a, tl_f32x8 b)
{
    return (uint32_t)_mm_movemask_ps(_mm_cmpnlt_ps(a.low, b.low)) |
           (uint32_t)_mm_movemask_ps(_mm_cmpnlt_ps(a.high, b.high)) << 4;
}

static inline tl_f32x8 tl_f32x8_if_less(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c, tl_f32x8 d)
{
    return tl_f32x8_make(tl_f32x4_if_less(a.low, b.low, c.low, d.low),
                         tl_f32x4_if_less(a.high, b.high, c.high, d.high));
}

static inline tl_f32x8 tl_f32x8_abs(tl_f32x8 a)
{
    return tl_f32x8_make(tl_f32x4_abs(a.low), tl_f32x4_abs(a.high));
}

static inline void tl_f32x8_store(float *eight, tl_f32x8 a)
{
    _mm_storeu_ps(eight, a.low);
    _mm_storeu_ps(eight + 4, a.high);
}

static inline uint32_t tl_f32x8_less(tl_f32x8 a, tl_f32x8 b)
{
    return (uint32_t)_mm_movemask_ps(_mm_cmplt_ps(a.low, b.low)) |
           (uint32_t)_mm_movemask_ps(_mm_cmplt_ps(a.high, b.high)) << 4;
}

#else

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

static inline float tl_f32x8_first(tl_f32x8 a)
{
    return a.v[0];
}

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

static inline tl_f32x8 tl_f32x8_load_twice(const float *four)
{
    return tl_f32x8_load_halves(four, four);
}

static inline tl_f32x8 tl_f32x8_swap_halves(tl_f32x8 a)
{
    return tl_f32x8_load_halves(a.v + 4, a.v);
}

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

static inline tl_f32x8 tl_f32x8_mul_sub_from(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return tl_f32x8_sub(c, tl_f32x8_mul(a, b));
}

static inline int32_t tl_float_bits(float value)
{
    int32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline tl_f32x8 tl_f32x8_min_bits(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_float_bits(a.v[i]) < tl_float_bits(b.v[i]) ? a.v[i] : b.v[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_max_bits(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_float_bits(a.v[i]) > tl_float_bits(b.v[i]) ? a.v[i] : b.v[i];
    }
    return r;
}

static inline uint32_t tl_f32x8_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t)(tl_float_bits(a.v[i]) < tl_float_bits(b.v[i])) << i;
    }
    return mask;
}

static inline float tl_float_of_bits(int32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline tl_f32x8 tl_f32x8_and(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_float_of_bits(tl_float_bits(a.v[i]) & tl_float_bits(b.v[i]));
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_or(tl_f32x8 a, tl_f32x8 b)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = tl_float_of_bits(tl_float_bits(a.v[i]) | tl_float_bits(b.v[i]));
    }
    return r;
}

static inline uint32_t tl_f32x8_signs(tl_f32x8 a)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t)(tl_float_bits(a.v[i]) < 0) << i;
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

static inline uint32_t tl_f32x8_not_less(tl_f32x8 a, tl_f32x8 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t) !(a.v[i] < b.v[i]) << i;
    }
    return mask;
}

static inline tl_f32x8 tl_f32x8_if_less(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c, tl_f32x8 d)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] < b.v[i] ? c.v[i] : d.v[i];
    }
    return r;
}

static inline tl_f32x8 tl_f32x8_abs(tl_f32x8 a)
{
    tl_f32x8 r;
    for (int i = 0; i < 8; i++) {
        r.v[i] = a.v[i] < 0.0f ? -a.v[i] : a.v[i];
    }
    return r;
}

static inline void tl_f32x8_store(float *eight, tl_f32x8 a)
{
    memcpy(eight, a.v, sizeof a.v);
}

static inline uint32_t tl_f32x8_less(tl_f32x8 a, tl_f32x8 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t)(a.v[i] < b.v[i]) << i;
    }
    return mask;
}

#endif

#endif
