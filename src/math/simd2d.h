// SPDX-License-Identifier: MIT
//
// Two doubles in a register that every processor of the target has: SSE2, NEON, simd128. TL_HAS_F64X2 is 0 where there
// is none, and where the file asks for plain C on a target whose base level is not. Nothing here is fused, so all give
// the same bits.
//
// A mask is a vector whose lanes are all ones or zero.

#ifndef TALUS_SRC_MATH_SIMD2D_H
#define TALUS_SRC_MATH_SIMD2D_H

#include "math/simd.h"

#include <stdbool.h>

#if (defined(__SSE2__) || defined(_M_X64)) && !defined(TALUS_NO_SIMD)

#include <immintrin.h>

#define TL_HAS_F64X2 1

typedef __m128d tl_f64x2;

static inline tl_f64x2 tl_f64x2_all(double value)
{
    return _mm_set1_pd(value);
}

static inline tl_f64x2 tl_f64x2_of_two(double x, double y)
{
    return _mm_set_pd(y, x);
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

/// { a[0], b[0] }.
static inline tl_f64x2 tl_f64x2_lows(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_unpacklo_pd(a, b);
}

/// { a[1], b[1] }.
static inline tl_f64x2 tl_f64x2_highs(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_unpackhi_pd(a, b);
}

/// { a[0] + a[1], b[0] + b[1] }.
static inline tl_f64x2 tl_f64x2_pair_sums(tl_f64x2 a, tl_f64x2 b)
{
    return _mm_add_pd(_mm_unpacklo_pd(a, b), _mm_unpackhi_pd(a, b));
}

/// Four points, x y z x y z ..., as doubles, two and two.
static inline void tl_f64x2_load_points(const float *points, tl_f64x2 x[2], tl_f64x2 y[2], tl_f64x2 z[2])
{
    __m128 a = _mm_loadu_ps(points), b = _mm_loadu_ps(points + 4), c = _mm_loadu_ps(points + 8); // xyzx yzxy zxyz
    __m128 yz = _mm_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1)), xy = _mm_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
    __m128 x4 = _mm_shuffle_ps(a, xy, _MM_SHUFFLE(2, 0, 3, 0)), y4 = _mm_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0)),
           z4 = _mm_shuffle_ps(yz, c, _MM_SHUFFLE(3, 0, 3, 1));
    x[0] = _mm_cvtps_pd(x4);
    y[0] = _mm_cvtps_pd(y4);
    z[0] = _mm_cvtps_pd(z4);
    x[1] = _mm_cvtps_pd(_mm_movehl_ps(x4, x4));
    y[1] = _mm_cvtps_pd(_mm_movehl_ps(y4, y4));
    z[1] = _mm_cvtps_pd(_mm_movehl_ps(z4, z4));
}

/// { a[1], a[0] }.
static inline tl_f64x2 tl_f64x2_swap(tl_f64x2 a)
{
    return _mm_shuffle_pd(a, a, 1);
}

/// Bits 0 and 1: those of a; 2 and 3: those of b.
static inline uint32_t tl_f64x2_two_masks(tl_f64x2 a, tl_f64x2 b)
{
    return tl_f64x2_masks(a) | tl_f64x2_masks(b) << 2;
}

#elif TL_SIMD_LEVEL >= 1 && defined(__aarch64__)

#include <arm_neon.h>

#define TL_HAS_F64X2 1

typedef float64x2_t tl_f64x2;

static inline tl_f64x2 tl_f64x2_all(double value)
{
    return vdupq_n_f64(value);
}

static inline tl_f64x2 tl_f64x2_of_two(double x, double y)
{
    return vsetq_lane_f64(y, vdupq_n_f64(x), 1);
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

// Lanes 0 and 1 as doubles, and 2 and 3.
static inline tl_f64x2 tl_f64x2_of_low(tl_f32x4 a)
{
    return vcvt_f64_f32(vget_low_f32(a));
}

static inline tl_f64x2 tl_f64x2_of_high(tl_f32x4 a)
{
    return vcvt_high_f64_f32(a);
}

static inline tl_f32x4 tl_f64x2_to_floats(tl_f64x2 low, tl_f64x2 high)
{
    return vcvt_high_f32_f64(vcvt_f32_f64(low), high);
}

/// { a[1], b[0] }.
static inline tl_f64x2 tl_f64x2_yx(tl_f64x2 a, tl_f64x2 b)
{
    return vextq_f64(a, b, 1);
}

/// { a[0], b[1] }.
static inline tl_f64x2 tl_f64x2_xy(tl_f64x2 a, tl_f64x2 b)
{
    return vcopyq_laneq_f64(b, 0, a, 0);
}

static inline tl_f64x2 tl_f64x2_lows(tl_f64x2 a, tl_f64x2 b)
{
    return vzip1q_f64(a, b);
}

static inline tl_f64x2 tl_f64x2_highs(tl_f64x2 a, tl_f64x2 b)
{
    return vzip2q_f64(a, b);
}

/// { a[0] + a[1], b[0] + b[1] }.
static inline tl_f64x2 tl_f64x2_pair_sums(tl_f64x2 a, tl_f64x2 b)
{
    return vpaddq_f64(a, b);
}

static inline void tl_f64x2_load_points(const float *points, tl_f64x2 x[2], tl_f64x2 y[2], tl_f64x2 z[2])
{
    float32x4x3_t p = vld3q_f32(points);
    x[0] = tl_f64x2_of_low(p.val[0]);
    y[0] = tl_f64x2_of_low(p.val[1]);
    z[0] = tl_f64x2_of_low(p.val[2]);
    x[1] = tl_f64x2_of_high(p.val[0]);
    y[1] = tl_f64x2_of_high(p.val[1]);
    z[1] = tl_f64x2_of_high(p.val[2]);
}

static inline tl_f64x2 tl_f64x2_swap(tl_f64x2 a)
{
    return vextq_f64(a, a, 1);
}

static inline uint32_t tl_f64x2_two_masks(tl_f64x2 a, tl_f64x2 b)
{
    return tl_f32x4_mask(vuzp1q_u32(vreinterpretq_u32_f64(a), vreinterpretq_u32_f64(b)));
}

#elif TL_SIMD_LEVEL >= 1 && defined(__wasm_simd128__)

#include <wasm_simd128.h>

#define TL_HAS_F64X2 1

typedef v128_t tl_f64x2;

static inline tl_f64x2 tl_f64x2_all(double value)
{
    return wasm_f64x2_splat(value);
}

static inline tl_f64x2 tl_f64x2_of_two(double x, double y)
{
    return wasm_f64x2_make(x, y);
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

static inline tl_f64x2 tl_f64x2_of_low(tl_f32x4 a)
{
    return wasm_f64x2_promote_low_f32x4(a);
}

static inline tl_f64x2 tl_f64x2_of_high(tl_f32x4 a)
{
    return wasm_f64x2_promote_low_f32x4(wasm_i64x2_shuffle(a, a, 1, 1));
}

static inline tl_f32x4 tl_f64x2_to_floats(tl_f64x2 low, tl_f64x2 high)
{
    return wasm_i64x2_shuffle(wasm_f32x4_demote_f64x2_zero(low), wasm_f32x4_demote_f64x2_zero(high), 0, 2);
}

static inline tl_f64x2 tl_f64x2_yx(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_i64x2_shuffle(a, b, 1, 2);
}

static inline tl_f64x2 tl_f64x2_xy(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_i64x2_shuffle(a, b, 0, 3);
}

static inline tl_f64x2 tl_f64x2_lows(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_i64x2_shuffle(a, b, 0, 2);
}

static inline tl_f64x2 tl_f64x2_highs(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_i64x2_shuffle(a, b, 1, 3);
}

static inline tl_f64x2 tl_f64x2_pair_sums(tl_f64x2 a, tl_f64x2 b)
{
    return wasm_f64x2_add(wasm_i64x2_shuffle(a, b, 0, 2), wasm_i64x2_shuffle(a, b, 1, 3));
}

static inline void tl_f64x2_load_points(const float *points, tl_f64x2 x[2], tl_f64x2 y[2], tl_f64x2 z[2])
{
    v128_t a = wasm_v128_load(points), b = wasm_v128_load(points + 4), c = wasm_v128_load(points + 8); // xyzx yzxy zxyz
    x[0] = wasm_f64x2_promote_low_f32x4(wasm_i32x4_shuffle(a, a, 0, 3, 0, 0));
    y[0] = wasm_f64x2_promote_low_f32x4(wasm_i32x4_shuffle(a, b, 1, 4, 0, 0));
    z[0] = wasm_f64x2_promote_low_f32x4(wasm_i32x4_shuffle(a, b, 2, 5, 0, 0));
    x[1] = wasm_f64x2_promote_low_f32x4(wasm_i32x4_shuffle(b, c, 2, 5, 0, 0));
    y[1] = wasm_f64x2_promote_low_f32x4(wasm_i32x4_shuffle(b, c, 3, 6, 0, 0));
    z[1] = wasm_f64x2_promote_low_f32x4(wasm_i32x4_shuffle(c, c, 0, 3, 0, 0));
}

static inline tl_f64x2 tl_f64x2_swap(tl_f64x2 a)
{
    return wasm_i64x2_shuffle(a, a, 1, 0);
}

static inline uint32_t tl_f64x2_two_masks(tl_f64x2 a, tl_f64x2 b)
{
    return (uint32_t)wasm_i32x4_bitmask(wasm_i32x4_shuffle(a, b, 0, 2, 4, 6));
}

#else

#define TL_HAS_F64X2 0

#endif

#endif
