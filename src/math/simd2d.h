// SPDX-License-Identifier: MIT
//
// Two doubles in a register that every processor of the target has: SSE2, NEON, simd128. TL_HAS_F64X2 is 0 where there
// is none. Nothing here is fused, so all give the same bits.
//
// A mask is a vector whose lanes are all ones or zero.

#ifndef TALUS_SRC_MATH_SIMD2D_H
#define TALUS_SRC_MATH_SIMD2D_H

#include "math/simd.h"

#include <stdbool.h>

#if defined(__SSE2__)

#include <immintrin.h>

#define TL_HAS_F64X2 1

typedef __m128d tl_f64x2;

static inline tl_f64x2 tl_f64x2_all(double value)
{
    return _mm_set1_pd(value);
}

static inline tl_f64x2 tl_f64x2_load(const double *two)
{
    return _mm_loadu_pd(two);
}

static inline void tl_f64x2_store(double *two, tl_f64x2 a)
{
    _mm_storeu_pd(two, a);
}

static inline double tl_f64x2_get_x(tl_f64x2 a)
{
    return _mm_cvtsd_f64(a);
}

static inline double tl_f64x2_get_y(tl_f64x2 a)
{
    return _mm_cvtsd_f64(_mm_unpackhi_pd(a, a));
}

static inline tl_f64x2 tl_f64x2_add(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_add_pd(a, b);
}

static inline tl_f64x2 tl_f64x2_sub(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_sub_pd(a, b);
}

static inline tl_f64x2 tl_f64x2_mul(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_mul_pd(a, b);
}

static inline tl_f64x2 tl_f64x2_div(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_div_pd(a, b);
}

static inline tl_f64x2 tl_f64x2_where_less(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_cmplt_pd(a, b);
}

static inline tl_f64x2 tl_f64x2_where_equal(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_cmpeq_pd(a, b);
}

static inline tl_f64x2 tl_f64x2_and(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_and_pd(a, b);
}

static inline tl_f64x2 tl_f64x2_without(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_andnot_pd(b, a);
}

static inline tl_f64x2 tl_f64x2_select(tl_f64x2 mask, tl_f64x2 a, tl_f64x2 b)
{
#if TL_SIMD_LEVEL >= 1
    return _mm_blendv_pd(b, a, mask);
#else
    return _mm_or_pd(_mm_and_pd(mask, a), _mm_andnot_pd(mask, b));
#endif
}

static inline tl_f64x2 tl_f64x2_max(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_max_pd(a, b);
}

static inline tl_f64x2 tl_f64x2_min(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_min_pd(a, b);
}

static inline uint32_t tl_f64x2_masks(tl_f64x2 a)
{
    return (uint32_t)_mm_movemask_pd(a);
}

static inline bool tl_f64x2_any(tl_f64x2 a, tl_f64x2 b, tl_f64x2 c, tl_f64x2 d)
{
    return (_mm_movemask_pd(a) | _mm_movemask_pd(b) | _mm_movemask_pd(c) | _mm_movemask_pd(d)) != 0;
}

#elif TL_CPU_BASE_LEVEL >= 1 && defined(__aarch64__)

#include <arm_neon.h>

#define TL_HAS_F64X2 1

typedef float64x2_t tl_f64x2;

static inline tl_f64x2 tl_f64x2_all(double value)
{
    return vdupq_n_f64(value);
}

static inline tl_f64x2 tl_f64x2_load(const double *two)
{
    return vld1q_f64(two);
}

static inline void tl_f64x2_store(double *two, tl_f64x2 a)
{
    vst1q_f64(two, a);
}

static inline double tl_f64x2_get_x(tl_f64x2 a)
{
    return vgetq_lane_f64(a, 0);
}

static inline double tl_f64x2_get_y(tl_f64x2 a)
{
    return vgetq_lane_f64(a, 1);
}

static inline tl_f64x2 tl_f64x2_add(tl_f64x2 a, tl_f64x2 b)
{
    return vaddq_f64(a, b);
}

static inline tl_f64x2 tl_f64x2_sub(tl_f64x2 a, tl_f64x2 b)
{
    return vsubq_f64(a, b);
}

static inline tl_f64x2 tl_f64x2_mul(tl_f64x2 a, tl_f64x2 b)
{
    return vmulq_f64(a, b);
}

static inline tl_f64x2 tl_f64x2_div(tl_f64x2 a, tl_f64x2 b)
{
    return vdivq_f64(a, b);
}

static inline tl_f64x2 tl_f64x2_where_less(tl_f64x2 a, tl_f64x2 b)
{
    return vreinterpretq_f64_u64(vcltq_f64(a, b));
}

static inline tl_f64x2 tl_f64x2_where_equal(tl_f64x2 a, tl_f64x2 b)
{
    return vreinterpretq_f64_u64(vceqq_f64(a, b));
}

static inline tl_f64x2 tl_f64x2_and(tl_f64x2 a, tl_f64x2 b)
{
    return vreinterpretq_f64_u64(vandq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)));
}

static inline tl_f64x2 tl_f64x2_without(tl_f64x2 a, tl_f64x2 b)
{
    return vreinterpretq_f64_u64(vbicq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)));
}

static inline tl_f64x2 tl_f64x2_select(tl_f64x2 mask, tl_f64x2 a, tl_f64x2 b)
{
    return vbslq_f64(vreinterpretq_u64_f64(mask), a, b);
}

static inline tl_f64x2 tl_f64x2_max(tl_f64x2 a, tl_f64x2 b)
{
    return vbslq_f64(vcgtq_f64(a, b), a, b);
}

static inline tl_f64x2 tl_f64x2_min(tl_f64x2 a, tl_f64x2 b)
{
    return vbslq_f64(vcltq_f64(a, b), a, b);
}

static inline uint32_t tl_f64x2_masks(tl_f64x2 a)
{
    // Narrowed to a word, which is all ones or zero in each half.
    uint64_t both = vget_lane_u64(vreinterpret_u64_u32(vmovn_u64(vreinterpretq_u64_f64(a))), 0);
    return (uint32_t)(both & 1) | (uint32_t)(both >> 62 & 2);
}

static inline bool tl_f64x2_any(tl_f64x2 a, tl_f64x2 b, tl_f64x2 c, tl_f64x2 d)
{
    uint64x2_t ab = vorrq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b));
    uint64x2_t cd = vorrq_u64(vreinterpretq_u64_f64(c), vreinterpretq_u64_f64(d));
    return vmaxvq_u32(vreinterpretq_u32_u64(vorrq_u64(ab, cd))) != 0;
}

#elif TL_CPU_BASE_LEVEL >= 1 && defined(__wasm_simd128__)

#include <wasm_simd128.h>

#define TL_HAS_F64X2 1

typedef v128_t tl_f64x2;

static inline tl_f64x2 tl_f64x2_all(double value)
{
    return wasm_f64x2_splat(value);
}

static inline tl_f64x2 tl_f64x2_load(const double *two)
{
    return wasm_v128_load(two);
}

static inline void tl_f64x2_store(double *two, tl_f64x2 a)
{
    wasm_v128_store(two, a);
}

static inline double tl_f64x2_get_x(tl_f64x2 a)
{
    return wasm_f64x2_extract_lane(a, 0);
}

static inline double tl_f64x2_get_y(tl_f64x2 a)
{
    return wasm_f64x2_extract_lane(a, 1);
}

static inline tl_f64x2 tl_f64x2_add(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_add(a, b);
}

static inline tl_f64x2 tl_f64x2_sub(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_sub(a, b);
}

static inline tl_f64x2 tl_f64x2_mul(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_mul(a, b);
}

static inline tl_f64x2 tl_f64x2_div(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_div(a, b);
}

static inline tl_f64x2 tl_f64x2_where_less(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_lt(a, b);
}

static inline tl_f64x2 tl_f64x2_where_equal(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_eq(a, b);
}

static inline tl_f64x2 tl_f64x2_and(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_v128_and(a, b);
}

static inline tl_f64x2 tl_f64x2_without(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_v128_andnot(a, b);
}

static inline tl_f64x2 tl_f64x2_select(tl_f64x2 mask, tl_f64x2 a, tl_f64x2 b)
{
    return wasm_v128_bitselect(a, b, mask);
}

// Operands swapped: see simd_x4_wasm.h.
static inline tl_f64x2 tl_f64x2_max(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_pmax(b, a);
}

static inline tl_f64x2 tl_f64x2_min(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_pmin(b, a);
}

static inline uint32_t tl_f64x2_masks(tl_f64x2 a)
{
    return (uint32_t)wasm_i64x2_bitmask(a);
}

static inline bool tl_f64x2_any(tl_f64x2 a, tl_f64x2 b, tl_f64x2 c, tl_f64x2 d)
{
    return wasm_v128_any_true(wasm_v128_or(wasm_v128_or(a, b), wasm_v128_or(c, d)));
}

#else

#define TL_HAS_F64X2 0

#endif

#endif
