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

static inline tl_f32x16 tl_f32x16_join(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    return _mm512_insertf32x8(_mm512_castps256_ps512(tl_f32x8_join(a, b)), tl_f32x8_join(c, d), 1);
}

static inline void tl_f32x16_transpose(tl_f32x16 rows[4])
{
    __m512 a = _mm512_unpacklo_ps(rows[0], rows[1]), b = _mm512_unpacklo_ps(rows[2], rows[3]);
    __m512 c = _mm512_unpackhi_ps(rows[0], rows[1]), d = _mm512_unpackhi_ps(rows[2], rows[3]);
    rows[0] = _mm512_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 1, 0));
    rows[1] = _mm512_shuffle_ps(a, b, _MM_SHUFFLE(3, 2, 3, 2));
    rows[2] = _mm512_shuffle_ps(c, d, _MM_SHUFFLE(1, 0, 1, 0));
    rows[3] = _mm512_shuffle_ps(c, d, _MM_SHUFFLE(3, 2, 3, 2));
}

static inline float tl_f32x16_first(tl_f32x16 a)
{
    return _mm512_cvtss_f32(a);
}

static inline tl_f32x16 tl_f32x16_add(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_add_ps(a, b);
}

static inline tl_f32x16 tl_f32x16_sub(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_sub_ps(a, b);
}

static inline tl_f32x16 tl_f32x16_mul(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_mul_ps(a, b);
}

static inline tl_f32x16 tl_f32x16_div(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_div_ps(a, b);
}

static inline tl_f32x16 tl_f32x16_mul_sub_from(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    return _mm512_fnmadd_ps(a, b, c);
}

static inline tl_f32x16 tl_f32x16_abs(tl_f32x16 a)
{
    return _mm512_abs_ps(a);
}

static inline tl_f32x16 tl_f32x16_min(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_min_ps(a, b);
}

static inline tl_f32x16 tl_f32x16_max(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_max_ps(a, b);
}

static inline uint32_t tl_f32x16_less(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
}

static inline tl_f32x8 tl_f32x16_larger_half(tl_f32x16 a)
{
    return _mm256_max_ps(_mm512_castps512_ps256(a), _mm512_extractf32x8_ps(a, 1));
}

static inline tl_f32x16 tl_f32x16_choose(uint32_t mask, tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_mask_blend_ps((__mmask16)mask, b, a);
}

static inline void tl_f32x16_store(float *sixteen, tl_f32x16 a)
{
    _mm512_storeu_ps(sixteen, a);
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

static inline tl_f32x16 tl_f32x16_where_less_bits(tl_f32x16 a, tl_f32x16 b)
{
    __mmask16 less = _mm512_cmplt_epi32_mask(_mm512_castps_si512(a), _mm512_castps_si512(b));
    return _mm512_castsi512_ps(_mm512_movm_epi32(less));
}

static inline tl_f32x16 tl_f32x16_and(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_and_ps(a, b);
}

static inline tl_f32x16 tl_f32x16_or(tl_f32x16 a, tl_f32x16 b)
{
    return _mm512_or_ps(a, b);
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

/// The lanes of a, b, c and d one after another.
static inline tl_f32x16 tl_f32x16_join(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    tl_f32x16 r = { tl_f32x8_join(a, b), tl_f32x8_join(c, d) };
    return r;
}

/// Turns each quarter of four rows into its columns.
static inline void tl_f32x16_transpose(tl_f32x16 rows[4])
{
    tl_f32x8 low[4] = { rows[0].low, rows[1].low, rows[2].low, rows[3].low };
    tl_f32x8 high[4] = { rows[0].high, rows[1].high, rows[2].high, rows[3].high };
    tl_f32x8_transpose(low);
    tl_f32x8_transpose(high);
    for (int i = 0; i < 4; i++) {
        rows[i].low = low[i];
        rows[i].high = high[i];
    }
}

/// The first lane.
static inline float tl_f32x16_first(tl_f32x16 a)
{
    return tl_f32x8_first(a.low);
}

static inline tl_f32x16 tl_f32x16_add(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_add(a.low, b.low), tl_f32x8_add(a.high, b.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_sub(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_sub(a.low, b.low), tl_f32x8_sub(a.high, b.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_mul(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_mul(a.low, b.low), tl_f32x8_mul(a.high, b.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_div(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_div(a.low, b.low), tl_f32x8_div(a.high, b.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_mul_sub_from(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    tl_f32x16 r = { tl_f32x8_mul_sub_from(a.low, b.low, c.low), tl_f32x8_mul_sub_from(a.high, b.high, c.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_abs(tl_f32x16 a)
{
    tl_f32x16 r = { tl_f32x8_abs(a.low), tl_f32x8_abs(a.high) };
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

/// Bit i: a[i] < b[i].
static inline uint32_t tl_f32x16_less(tl_f32x16 a, tl_f32x16 b)
{
    return tl_f32x8_less(a.low, b.low) | tl_f32x8_less(a.high, b.high) << 8;
}

/// Lane i: the larger one of a[i] and a[i + 8].
static inline tl_f32x8 tl_f32x16_larger_half(tl_f32x16 a)
{
    return tl_f32x8_max(a.low, a.high);
}

/// Lane i is a[i] where bit i of the mask is set, else b[i].
static inline tl_f32x16 tl_f32x16_choose(uint32_t mask, tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_choose(mask, a.low, b.low), tl_f32x8_choose(mask >> 8, a.high, b.high) };
    return r;
}

static inline void tl_f32x16_store(float *sixteen, tl_f32x16 a)
{
    tl_f32x8_store(sixteen, a.low);
    tl_f32x8_store(sixteen + 8, a.high);
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

static inline tl_f32x16 tl_f32x16_where_less_bits(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_where_less_bits(a.low, b.low), tl_f32x8_where_less_bits(a.high, b.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_and(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_and(a.low, b.low), tl_f32x8_and(a.high, b.high) };
    return r;
}

static inline tl_f32x16 tl_f32x16_or(tl_f32x16 a, tl_f32x16 b)
{
    tl_f32x16 r = { tl_f32x8_or(a.low, b.low), tl_f32x8_or(a.high, b.high) };
    return r;
}

static inline void tl_f32x16_store_bits(uint32_t *sixteen, tl_f32x16 a)
{
    tl_f32x8_store((float *)(void *)sixteen, a.low);
    tl_f32x8_store((float *)(void *)(sixteen + 8), a.high);
}

#endif

/// The least lane, as bits.
static inline uint32_t tl_f32x16_least_bits(tl_f32x16 a)
{
#if TL_SIMD_LEVEL == 3
    return tl_f32x8_least_bits(tl_f32x8_min_bits(_mm512_castps512_ps256(a), _mm512_extractf32x8_ps(a, 1)));
#else
    return tl_f32x8_least_bits(tl_f32x8_min_bits(a.low, a.high));
#endif
}

/// Writes a value to each lane of the mask.
static inline void tl_u32x16_store_where(uint32_t *sixteen, uint32_t mask, uint32_t value)
{
#if TL_SIMD_LEVEL == 3
    _mm512_mask_storeu_epi32(sixteen, (__mmask16)mask, _mm512_set1_epi32((int)value));
#elif TL_SIMD_LEVEL == 2
    for (uint32_t i = 0; i < 16; i += 8) { // a masked store would take many times as long on AMD's processors
        __m256i *eight = (__m256i *)(void *)(sixteen + i);
        __m256i bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        __m256i chosen = _mm256_and_si256(_mm256_set1_epi32((int)(mask >> i)), bits);
        __m256i set = _mm256_cmpeq_epi32(chosen, bits);
        __m256i value_lanes = _mm256_set1_epi32((int)value);
        _mm256_storeu_si256(eight, _mm256_blendv_epi8(_mm256_loadu_si256(eight), value_lanes, set));
    }
#else
    for (uint32_t i = 0; i < 16; i++) {
        sixteen[i] = (mask >> i & 1u) != 0 ? value : sixteen[i];
    }
#endif
}

/// The largest lane. They are numbers; which zero is the larger is open.
static inline float tl_f32x16_largest(tl_f32x16 a)
{
    return tl_f32x8_first(tl_f32x8_largest(tl_f32x16_larger_half(a)));
}

/// Lane 0: the largest lane of a, lane 1: of b, lane 2: of c. They are numbers; which zero is the larger is open.
static inline tl_f32x4 tl_f32x16_largest_of_each(tl_f32x16 a, tl_f32x16 b, tl_f32x16 c)
{
    tl_f32x8 rows[4] = { tl_f32x16_larger_half(a), tl_f32x16_larger_half(b), tl_f32x16_larger_half(c) };
    rows[3] = rows[2];
    tl_f32x8_transpose(rows);
    tl_f32x8 four = tl_f32x8_max(tl_f32x8_max(rows[0], rows[1]), tl_f32x8_max(rows[2], rows[3]));
    return tl_f32x8_low(tl_f32x8_max(four, tl_f32x8_swap_halves(four)));
}

/// Bit i: that lane has the value.
static inline uint32_t tl_u32x16_equal(const uint32_t *sixteen, uint32_t value)
{
#if TL_SIMD_LEVEL == 3
    return _mm512_cmpeq_epi32_mask(_mm512_loadu_si512(sixteen), _mm512_set1_epi32((int)value));
#elif TL_SIMD_LEVEL == 2
    __m256i all = _mm256_set1_epi32((int)value);
    __m256i low = _mm256_cmpeq_epi32(_mm256_loadu_si256((const __m256i *)(const void *)sixteen), all);
    __m256i high = _mm256_cmpeq_epi32(_mm256_loadu_si256((const __m256i *)(const void *)(sixteen + 8)), all);
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(low)) |
           (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(high)) << 8;
#else
    uint32_t mask = 0;
    for (uint32_t i = 0; i < 16; i++) {
        mask |= (uint32_t)(sixteen[i] == value) << i;
    }
    return mask;
#endif
}

/// Writes high[i] << 32 | low[i] for each lane i of the mask, in their order. The array holds sixteen; those behind
/// the lanes' become anything.
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
    // Four at a time, there or not: how many there are is hard to predict, that it is not more is easy.
    do {
        for (uint32_t i = 0; i < 4; i++) {
            uint32_t lane = tl_lowest_bit(mask | 0x8000u);
            *to++ = (uint64_t)high[lane] << 32 | low[lane];
            mask &= mask - 1;
        }
    } while (mask != 0);
#endif
}

#endif
