// SPDX-License-Identifier: MIT
//
// Four floats in an x86 register: SSE4.2, and with AVX2 the fused and the shorter forms.

#ifndef TALUS_SRC_MATH_SIMD_X4_SSE_H
#define TALUS_SRC_MATH_SIMD_X4_SSE_H

#include "base/compiler.h"

#include <immintrin.h>
#include <stdint.h>
#include <string.h>

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

// A load for each float: callers store them one by one just before, and a wider load would wait until those stores have
// reached the cache.
static inline tl_f32x4 tl_f32x4_load_three(const float *three)
{
    __m128 y = _mm_load_ss(three + 1);
    TL_KEEP_VECTOR(y); // or clang joins it with its neighbour
    __m128 xy = _mm_insert_ps(_mm_load_ss(three), y, 0x10);
    return _mm_insert_ps(xy, _mm_load_ss(three + 2), 0x20);
}

// As integers: compilers make two shuffles of a float that is loaded to be inserted.
static inline tl_f32x4 tl_f32x4_gather_four(const float *x, const float *y, const float *z, const float *w)
{
    int32_t lane[4];
    memcpy(&lane[0], x, sizeof *lane);
    memcpy(&lane[1], y, sizeof *lane);
    memcpy(&lane[2], z, sizeof *lane);
    memcpy(&lane[3], w, sizeof *lane);
    __m128i xy = _mm_insert_epi32(_mm_cvtsi32_si128(lane[0]), lane[1], 1);
    return _mm_castsi128_ps(_mm_insert_epi32(_mm_insert_epi32(xy, lane[2], 2), lane[3], 3));
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

static inline tl_f32x4 tl_f32x4_rotate_three(tl_f32x4 a)
{
    return _mm_shuffle_ps(a, a, _MM_SHUFFLE(3, 0, 2, 1));
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

static inline tl_f32x4 tl_f32x4_min(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_min_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_sqrt(tl_f32x4 a)
{
    return _mm_sqrt_ps(a);
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

static inline tl_f32x4 tl_f32x4_mul_sub_from(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
#if TL_SIMD_LEVEL >= 2
    return _mm_fnmadd_ps(a, b, c);
#else
    return _mm_sub_ps(c, _mm_mul_ps(a, b));
#endif
}

static inline tl_f32x4 tl_f32x4_choose(tl_f32x4 signs, tl_f32x4 a, tl_f32x4 b)
{
    return _mm_blendv_ps(a, b, signs);
}

static inline tl_f32x4 tl_f32x4_abs(tl_f32x4 a)
{
    return _mm_andnot_ps(_mm_set1_ps(-0.0f), a);
}

static inline tl_f32x4 tl_f32x4_if_less(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    return _mm_blendv_ps(d, c, _mm_cmplt_ps(a, b));
}

static inline uint32_t tl_f32x4_less_equal(tl_f32x4 a, tl_f32x4 b)
{
    return (uint32_t)_mm_movemask_ps(_mm_cmple_ps(a, b));
}

static inline uint32_t tl_f32x4_ascending(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return (uint32_t)_mm_movemask_ps(_mm_and_ps(_mm_cmple_ps(a, b), _mm_cmple_ps(b, c)));
}

static inline uint32_t tl_f32x4_signs(tl_f32x4 a)
{
    return (uint32_t)_mm_movemask_ps(a);
}

static inline void tl_f32x4_store(float *four, tl_f32x4 a)
{
    _mm_storeu_ps(four, a);
}

static inline void tl_f32x4_store_whole(int32_t *four, tl_f32x4 a)
{
    _mm_storeu_si128((__m128i *)(void *)four, _mm_cvttps_epi32(a));
}

static inline tl_f32x4 tl_f32x4_max_of_three(tl_f32x4 a)
{
    __m128 y = _mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 1, 1, 1));
    __m128 z = _mm_shuffle_ps(a, a, _MM_SHUFFLE(2, 2, 2, 2));
    __m128 m = _mm_max_ps(_mm_max_ps(a, y), z);
    return _mm_shuffle_ps(m, m, _MM_SHUFFLE(0, 0, 0, 0));
}

static inline float tl_f32x4_least_of_three(tl_f32x4 a)
{
    __m128 y = _mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 1, 1, 1));
    __m128 z = _mm_shuffle_ps(a, a, _MM_SHUFFLE(2, 2, 2, 2));
    return _mm_cvtss_f32(_mm_min_ss(_mm_min_ss(a, y), z));
}

// ------------------------------------------------------------------------------- for vectors of two (simd_x8_pair.h)

static inline void tl_f32x4_two_from_bytes(const uint8_t *eight, tl_f32x4 *low, tl_f32x4 *high)
{
    int32_t bytes[2];
    memcpy(bytes, eight, sizeof bytes);
    *low = _mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(bytes[0])));
    *high = _mm_cvtepi32_ps(_mm_cvtepu8_epi32(_mm_cvtsi32_si128(bytes[1])));
}

static inline tl_f32x4 tl_f32x4_zip_low(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_unpacklo_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_zip_high(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_unpackhi_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_twice_z_and_low(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 2));
}

static inline tl_f32x4 tl_f32x4_twice_z_and_high(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 2, 2, 2));
}

static inline void tl_f32x4_transpose(tl_f32x4 *a, tl_f32x4 *b, tl_f32x4 *c, tl_f32x4 *d)
{
    _MM_TRANSPOSE4_PS(*a, *b, *c, *d);
}

static inline tl_f32x4 tl_f32x4_largest(tl_f32x4 a)
{
    __m128 m = _mm_max_ps(a, _mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 0, 3, 2)));
    return _mm_max_ps(m, _mm_shuffle_ps(m, m, _MM_SHUFFLE(2, 3, 0, 1)));
}

static inline tl_f32x4 tl_f32x4_and(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_and_ps(a, b);
}

static inline tl_f32x4 tl_f32x4_min_bits(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_castsi128_ps(_mm_min_epi32(_mm_castps_si128(a), _mm_castps_si128(b)));
}

static inline tl_f32x4 tl_f32x4_max_bits(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_castsi128_ps(_mm_max_epi32(_mm_castps_si128(a), _mm_castps_si128(b)));
}

static inline tl_f32x4 tl_f32x4_where_less_bits(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_castsi128_ps(_mm_cmplt_epi32(_mm_castps_si128(a), _mm_castps_si128(b)));
}

static inline tl_f32x4 tl_f32x4_where_less(tl_f32x4 a, tl_f32x4 b)
{
    return _mm_cmplt_ps(a, b);
}

static inline uint32_t tl_f32x4_two_signs(tl_f32x4 low, tl_f32x4 high)
{
    return (uint32_t)_mm_movemask_ps(low) | (uint32_t)_mm_movemask_ps(high) << 4;
}

// These lanes are all ones or zero.
static inline uint32_t tl_f32x4_two_masks(tl_f32x4 low, tl_f32x4 high)
{
    return tl_f32x4_two_signs(low, high);
}

static inline uint32_t tl_f32x4_two_not_less(tl_f32x4 a_low, tl_f32x4 b_low, tl_f32x4 a_high, tl_f32x4 b_high)
{
    return tl_f32x4_two_masks(_mm_cmpnlt_ps(a_low, b_low), _mm_cmpnlt_ps(a_high, b_high));
}

static inline uint32_t tl_f32x4_four_masks(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    return tl_f32x4_two_masks(a, b) | tl_f32x4_two_masks(c, d) << 8;
}

#endif
