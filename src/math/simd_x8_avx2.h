// SPDX-License-Identifier: MIT
//
// Eight floats in one register of AVX2.

#ifndef TALUS_SRC_MATH_SIMD_X8_AVX2_H
#define TALUS_SRC_MATH_SIMD_X8_AVX2_H

#include "math/simd.h"

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

static inline tl_f32x8 tl_f32x8_join(tl_f32x4 low, tl_f32x4 high)
{
    return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1);
}

static inline tl_f32x4 tl_f32x8_low(tl_f32x8 a)
{
    return _mm256_castps256_ps128(a);
}

static inline float tl_f32x8_first(tl_f32x8 a)
{
    return _mm256_cvtss_f32(a);
}

static inline tl_f32x8 tl_f32x8_largest(tl_f32x8 a)
{
    __m256 m = _mm256_max_ps(a, _mm256_permute2f128_ps(a, a, 1));
    m = _mm256_max_ps(m, _mm256_permute_ps(m, _MM_SHUFFLE(1, 0, 3, 2)));
    return _mm256_max_ps(m, _mm256_permute_ps(m, _MM_SHUFFLE(2, 3, 0, 1)));
}

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

static inline uint32_t tl_f32x8_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    __m256i less = _mm256_cmpgt_epi32(_mm256_castps_si256(b), _mm256_castps_si256(a));
    return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(less));
}

static inline tl_f32x8 tl_f32x8_where_less_bits(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_castsi256_ps(_mm256_cmpgt_epi32(_mm256_castps_si256(b), _mm256_castps_si256(a)));
}

static inline uint32_t tl_f32x8_least_bits(tl_f32x8 a)
{
    __m128i m = _mm_min_epi32(_mm256_castsi256_si128(_mm256_castps_si256(a)),
                              _mm256_extracti128_si256(_mm256_castps_si256(a), 1));
    m = _mm_min_epi32(m, _mm_shuffle_epi32(m, _MM_SHUFFLE(1, 0, 3, 2)));
    m = _mm_min_epi32(m, _mm_shuffle_epi32(m, _MM_SHUFFLE(2, 3, 0, 1)));
    return (uint32_t)_mm_cvtsi128_si32(m);
}

static inline tl_f32x8 tl_f32x8_and(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_and_ps(a, b);
}

static inline tl_f32x8 tl_f32x8_or(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_or_ps(a, b);
}

static inline uint32_t tl_f32x8_signs(tl_f32x8 a)
{
    return (uint32_t)_mm256_movemask_ps(a);
}

static inline tl_f32x8 tl_f32x8_max(tl_f32x8 a, tl_f32x8 b)
{
    return _mm256_max_ps(a, b);
}

static inline uint32_t tl_f32x8_not_less(tl_f32x8 a, tl_f32x8 b)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_NLT_UQ));
}

static inline tl_f32x8 tl_f32x8_if_less(tl_f32x8 a, tl_f32x8 b, tl_f32x8 c, tl_f32x8 d)
{
    return _mm256_blendv_ps(d, c, _mm256_cmp_ps(a, b, _CMP_LT_OQ));
}

static inline tl_f32x8 tl_f32x8_choose(uint32_t mask, tl_f32x8 a, tl_f32x8 b)
{
    __m256i bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    __m256i set = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32((int)mask), bits), bits);
    return _mm256_blendv_ps(b, a, _mm256_castsi256_ps(set));
}

static inline tl_f32x8 tl_f32x8_abs(tl_f32x8 a)
{
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a);
}

static inline void tl_f32x8_store(float *eight, tl_f32x8 a)
{
    _mm256_storeu_ps(eight, a);
}

static inline uint32_t tl_f32x8_less(tl_f32x8 a, tl_f32x8 b)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
}

#endif
