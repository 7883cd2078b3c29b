// SPDX-License-Identifier: MIT
//
// The vocabulary of simd.h, sixteen floats wide: one register with AVX-512, two halves of tl_f32x8 elsewhere.

#ifndef TALUS_SRC_MATH_SIMD16_H
#define TALUS_SRC_MATH_SIMD16_H

#include "math/simd.h"

#if TL_SIMD_LEVEL == 3

typedef __m512 tl_f32x16;

static inline tl_f32x16 tl_f32x16_all(float value)
{
    return _mm512_set1_ps(value);
}

static inline tl_f32x16 tl_f32x16_from_u16(const uint16_t *sixteen)
{
    return _mm512_cvtepi32_ps(_mm512_cvtepu16_epi32(_mm256_loadu_si256((const __m256i *)(const void *)sixteen)));
}

static inline tl_f32x16 tl_f32x16_mul_add(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    return _mm512_fmadd_ps(a, b, c);
}

static inline tl_f32x16 tl_f32x16_min(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_min_ps(a, b);
}

static inline tl_f32x16 tl_f32x16_max(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_max_ps(a, b);
}

static inline void tl_f32x16_store_bits(uint32_t *sixteen, tl_f32x16 a)
{
    _mm512_storeu_si512(sixteen, _mm512_castps_si512(a));
}

/// Bit i: a[i] <= b[i].
static inline uint32_t tl_f32x16_less_equal(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
}

/// Bit i: sixteen[i] is not 0.
static inline uint32_t tl_u32x16_nonzero(const uint32_t *sixteen)
{
    __m512i v = _mm512_loadu_si512(sixteen);
    return _mm512_test_epi32_mask(v, v);
}

#else

/// Two halves of tl_f32x8.
typedef struct tl_f32x16 {
    tl_f32x8 low, high;
} tl_f32x16;

static inline tl_f32x16 tl_f32x16_all(float value)
{
    tl_f32x16 r = { tl_f32x8_all(value), tl_f32x8_all(value) };
    return r;
}

static inline tl_f32x16 tl_f32x16_min(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_min(a.low, b.low), tl_f32x8_min(a.high, b.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_max(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_max(a.low, b.low), tl_f32x8_max(a.high, b.high) };
    return r;
}

#if TL_SIMD_LEVEL == 2

static inline tl_f32x16 tl_f32x16_from_u16(const uint16_t *sixteen)
{
    const __m128i *halves = (const __m128i *)(const void *)sixteen;
    tl_f32x16 r = { _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(_mm_loadu_si128(halves))),
                    _mm256_cvtepi32_ps(_mm256_cvtepu16_epi32(_mm_loadu_si128(halves + 1))) };
    return r;
}

static inline tl_f32x16 tl_f32x16_mul_add(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    tl_f32x16 r = { _mm256_fmadd_ps(a.low, b.low, c.low), _mm256_fmadd_ps(a.high, b.high, c.high) };
    return r;
}

static inline void tl_f32x16_store_bits(uint32_t *sixteen, tl_f32x16 a)
{
    __m256i *halves = (__m256i *)(void *)sixteen;
    _mm256_storeu_si256(halves, _mm256_castps_si256(a.low));
    _mm256_storeu_si256(halves + 1, _mm256_castps_si256(a.high));
}

static inline uint32_t tl_f32x16_less_equal(tl_f32x16 a, tl_f32x16 b)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a.low, b.low, _CMP_LE_OQ)) |
           (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a.high, b.high, _CMP_LE_OQ)) << 8;
}

static inline uint32_t tl_u32x16_nonzero(const uint32_t *sixteen)
{
    const __m256i *halves = (const __m256i *)(const void *)sixteen;
    __m256i zero = _mm256_setzero_si256();
    __m256i low = _mm256_cmpeq_epi32(_mm256_loadu_si256(halves), zero);
    __m256i high = _mm256_cmpeq_epi32(_mm256_loadu_si256(halves + 1), zero);
    uint32_t empty = (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(low)) |
                     (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(high)) << 8;
    return ~empty & 0xffffu;
}

#elif TL_SIMD_LEVEL == 1

static inline tl_f32x8 tl_f32x8_from_u16(const uint16_t *eight)
{
    __m128i v = _mm_loadu_si128((const __m128i *)(const void *)eight);
    return tl_f32x8_make(_mm_cvtepi32_ps(_mm_cvtepu16_epi32(v)),
                         _mm_cvtepi32_ps(_mm_cvtepu16_epi32(_mm_unpackhi_epi64(v, v))));
}

static inline tl_f32x16 tl_f32x16_from_u16(const uint16_t *sixteen)
{
    tl_f32x16 r = { tl_f32x8_from_u16(sixteen), tl_f32x8_from_u16(sixteen + 8) };
    return r;
}

static inline tl_f32x8 tl_f32x8_mul_add(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c)
{
    return tl_f32x8_make(_mm_add_ps(_mm_mul_ps(a.low, b.low), c.low), _mm_add_ps(_mm_mul_ps(a.high, b.high), c.high));
}

static inline tl_f32x16 tl_f32x16_mul_add(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    tl_f32x16 r = { tl_f32x8_mul_add(a.low, b.low, c.low), tl_f32x8_mul_add(a.high, b.high, c.high) };
    return r;
}

static inline void tl_f32x16_store_bits(uint32_t *sixteen, tl_f32x16 a)
{
    __m128i *quarters = (__m128i *)(void *)sixteen;
    _mm_storeu_si128(quarters, _mm_castps_si128(a.low.low));
    _mm_storeu_si128(quarters + 1, _mm_castps_si128(a.low.high));
    _mm_storeu_si128(quarters + 2, _mm_castps_si128(a.high.low));
    _mm_storeu_si128(quarters + 3, _mm_castps_si128(a.high.high));
}

static inline uint32_t tl_f32x8_less_equal(tl_f32x8 a, tl_f32x8 b)
{
    return (uint32_t)_mm_movemask_ps(_mm_cmple_ps(a.low, b.low)) |
           (uint32_t)_mm_movemask_ps(_mm_cmple_ps(a.high, b.high)) << 4;
}

static inline uint32_t tl_f32x16_less_equal(tl_f32x16 a, tl_f32x16 b)
{
    return tl_f32x8_less_equal(a.low, b.low) | tl_f32x8_less_equal(a.high, b.high) << 8;
}

static inline uint32_t tl_u32x16_nonzero(const uint32_t *sixteen)
{
    uint32_t empty = 0;
    for (int i = 0; i < 4; i++) {
        __m128i v = _mm_loadu_si128((const __m128i *)(const void *)(sixteen + 4 * i));
        __m128i zero = _mm_cmpeq_epi32(v, _mm_setzero_si128());
        empty |= (uint32_t)_mm_movemask_ps(_mm_castsi128_ps(zero)) << (4 * i);
    }
    return ~empty & 0xffffu;
}

#else

static inline tl_f32x16 tl_f32x16_from_u16(const uint16_t *sixteen)
{
    tl_f32x16 r;
    for (int i = 0; i < 8; i++) {
        r.low.v[i] = (float)sixteen[i];
        r.high.v[i] = (float)sixteen[i + 8];
    }
    return r;
}

static inline tl_f32x16 tl_f32x16_mul_add(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    tl_f32x16 r;
    for (int i = 0; i < 8; i++) {
        r.low.v[i] = a.low.v[i] * b.low.v[i] + c.low.v[i];
        r.high.v[i] = a.high.v[i] * b.high.v[i] + c.high.v[i];
    }
    return r;
}

static inline void tl_f32x16_store_bits(uint32_t *sixteen, tl_f32x16 a)
{
    memcpy(sixteen, a.low.v, sizeof a.low.v);
    memcpy(sixteen + 8, a.high.v, sizeof a.high.v);
}

static inline uint32_t tl_f32x16_less_equal(tl_f32x16 a, tl_f32x16 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 8; i++) {
        mask |= (uint32_t)(a.low.v[i] <= b.low.v[i]) << i;
        mask |= (uint32_t)(a.high.v[i] <= b.high.v[i]) << (i + 8);
    }
    return mask;
}

static inline uint32_t tl_u32x16_nonzero(const uint32_t *sixteen)
{
    uint32_t mask = 0;
    for (int i = 0; i < 16; i++) {
        mask |= (uint32_t)(sixteen[i] != 0) << i;
    }
    return mask;
}

#endif
#endif

#endif
