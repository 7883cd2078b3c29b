// SPDX-License-Identifier: MIT
//
// The vocabulary of simd.h, sixteen floats wide: one register with AVX-512, two halves of tl_f32x8 elsewhere.

#ifndef TALUS_SRC_MATH_SIMD16_H
#define TALUS_SRC_MATH_SIMD16_H

#include "base/lowest_bit.h"
#include "math/simd8.h"

#if TL_SIMD_LEVEL == 3

typedef __m512 tl_f32x16;

static inline tl_f32x16 tl_f32x16_all(float value)
{
    return _mm512_set1_ps(value);
}

static inline tl_f32x16 tl_f32x16_load(const float *sixteen)
{
    return _mm512_loadu_ps(sixteen);
}

static inline tl_f32x16 tl_f32x16_from_bytes(const uint8_t *sixteen)
{
    return _mm512_cvtepi32_ps(_mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)(const void *)sixteen)));
}

static inline tl_f32x16 tl_f32x16_mul_add(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    return _mm512_fmadd_ps(a, b, c);
}

static inline tl_f32x16 tl_f32x16_min_bits(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_castsi512_ps(_mm512_min_epi32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
}

static inline tl_f32x16 tl_f32x16_max_bits(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_castsi512_ps(_mm512_max_epi32(_mm512_castps_si512(a), _mm512_castps_si512(b)));
}

/// Bit i: a[i] <= b[i], as bits.
static inline uint32_t tl_f32x16_less_equal_bits(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_cmple_epi32_mask(_mm512_castps_si512(a), _mm512_castps_si512(b));
}

static inline void tl_f32x16_store_bits(uint32_t *sixteen, tl_f32x16 a)
{
    _mm512_storeu_si512(sixteen, _mm512_castps_si512(a));
}

#else

/// Two halves of tl_f32x8.
typedef struct tl_f32x16 {
    tl_f32x8 low, high;
} tl_f32x16;

static inline tl_f32x16 tl_f32x16_all(float value)
{
    tl_f32x8 half = tl_f32x8_all(value);
    tl_f32x16 r = { half, half };
    return r;
}

static inline tl_f32x16 tl_f32x16_load(const float *sixteen)
{
    tl_f32x16 r = { tl_f32x8_load(sixteen), tl_f32x8_load(sixteen + 8) };
    return r;
}

static inline tl_f32x16 tl_f32x16_from_bytes(const uint8_t *sixteen)
{
    tl_f32x16 r = { tl_f32x8_from_bytes(sixteen), tl_f32x8_from_bytes(sixteen + 8) };
    return r;
}

static inline tl_f32x16 tl_f32x16_mul_add(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    tl_f32x16 r = { tl_f32x8_mul_add(a.low, b.low, c.low), tl_f32x8_mul_add(a.high, b.high, c.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_min_bits(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_min_bits(a.low, b.low), tl_f32x8_min_bits(a.high, b.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_max_bits(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_max_bits(a.low, b.low), tl_f32x8_max_bits(a.high, b.high) };
    return r;
}

static inline uint32_t tl_f32x16_less_equal_bits(tl_f32x16 a, tl_f32x16 b)
{
#if TL_SIMD_LEVEL == 1
    tl_f32x4 less[4] = { tl_f32x4_where_less_bits(b.low.low, a.low.low),
                         tl_f32x4_where_less_bits(b.low.high, a.low.high),
                         tl_f32x4_where_less_bits(b.high.low, a.high.low),
                         tl_f32x4_where_less_bits(b.high.high, a.high.high) };
    return tl_f32x4_four_masks(less[0], less[1], less[2], less[3]) ^ 0xffffu;
#else
    return (tl_f32x8_less_bits(b.low, a.low) | tl_f32x8_less_bits(b.high, a.high) << 8) ^ 0xffffu;
#endif
}

static inline void tl_f32x16_store_bits(uint32_t *sixteen, tl_f32x16 a)
{
    tl_f32x8_store((float *)(void *)sixteen, a.low);
    tl_f32x8_store((float *)(void *)(sixteen + 8), a.high);
}

#endif

/// Writes high[i] << 32 | low[i] for each lane i of the mask, in their order. The array holds sixteen.
static inline void tl_u32x16_compress_pairs(uint64_t *to, uint32_t mask, const uint32_t *high, const uint32_t *low)
{
#if TL_SIMD_LEVEL == 3
    __m512i h = _mm512_maskz_compress_epi32((__mmask16)mask, _mm512_loadu_si512(high));
    __m512i l = _mm512_maskz_compress_epi32((__mmask16)mask, _mm512_loadu_si512(low));
    // Interleaved, pairs 4i and 4i + 1 are in quarter i of one register, 4i + 2 and 4i + 3 in that of the other.
    __m512i a = _mm512_unpacklo_epi32(l, h), b = _mm512_unpackhi_epi32(l, h);
    _mm_storeu_si128((__m128i *)(void *)to, _mm512_castsi512_si128(a));
    _mm_storeu_si128((__m128i *)(void *)(to + 2), _mm512_castsi512_si128(b));
    if (_mm_popcnt_u32(mask) > 4) {
        _mm_storeu_si128((__m128i *)(void *)(to + 4), _mm512_extracti32x4_epi32(a, 1));
        _mm_storeu_si128((__m128i *)(void *)(to + 6), _mm512_extracti32x4_epi32(b, 1));
        _mm_storeu_si128((__m128i *)(void *)(to + 8), _mm512_extracti32x4_epi32(a, 2));
        _mm_storeu_si128((__m128i *)(void *)(to + 10), _mm512_extracti32x4_epi32(b, 2));
        _mm_storeu_si128((__m128i *)(void *)(to + 12), _mm512_extracti32x4_epi32(a, 3));
        _mm_storeu_si128((__m128i *)(void *)(to + 14), _mm512_extracti32x4_epi32(b, 3));
    }
#else
    for (; mask != 0; mask &= mask - 1) {
        uint32_t lane = tl_lowest_bit(mask);
        *to++ = (uint64_t)high[lane] << 32 | low[lane];
    }
#endif
}

#endif
