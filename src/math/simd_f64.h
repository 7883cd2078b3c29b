// SPDX-License-Identifier: MIT
//
// The vocabulary of simd.h for eight doubles: one register with AVX-512, two with AVX2, four of simd2d.h. Nothing here
// is fused, so all give the same bits. There is no plain C branch: eight doubles in an array are slower than a plain
// loop.

#ifndef TALUS_SRC_MATH_SIMD_F64_H
#define TALUS_SRC_MATH_SIMD_F64_H

#include "math/simd.h"
#include "math/simd2d.h"

#include <stdbool.h>

#if TL_SIMD_LEVEL == 3

typedef __m512d tl_f64x8;
typedef __mmask8 tl_mask64x8;

static inline tl_f64x8 tl_f64x8_all(double value)
{
    return _mm512_set1_pd(value);
}

static inline tl_f64x8 tl_f64x8_load(const double *eight)
{
    return _mm512_loadu_pd(eight);
}

static inline void tl_f64x8_store(double *eight, tl_f64x8 a)
{
    _mm512_storeu_pd(eight, a);
}

static inline tl_f64x8 tl_f64x8_add(tl_f64x8 a, tl_f64x8 b)
{
    return _mm512_add_pd(a, b);
}

static inline tl_f64x8 tl_f64x8_sub(tl_f64x8 a, tl_f64x8 b)
{
    return _mm512_sub_pd(a, b);
}

static inline tl_f64x8 tl_f64x8_mul(tl_f64x8 a, tl_f64x8 b)
{
    return _mm512_mul_pd(a, b);
}

static inline tl_f64x8 tl_f64x8_div(tl_f64x8 a, tl_f64x8 b)
{
    return _mm512_div_pd(a, b);
}

static inline tl_mask64x8 tl_f64x8_less(tl_f64x8 a, tl_f64x8 b)
{
    return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}

static inline tl_mask64x8 tl_mask64x8_and(tl_mask64x8 a, tl_mask64x8 b)
{
    return (__mmask8)(a & b);
}

/// Lanes of a that are not in b.
static inline tl_mask64x8 tl_mask64x8_without(tl_mask64x8 a, tl_mask64x8 b)
{
    return (__mmask8)(a & ~b);
}

static inline bool tl_mask64x8_any(tl_mask64x8 a)
{
    return a != 0;
}

/// Lane i: mask[i] ? a[i] : b[i].
static inline tl_f64x8 tl_f64x8_select(tl_mask64x8 mask, tl_f64x8 a, tl_f64x8 b)
{
    return _mm512_mask_blend_pd(mask, b, a);
}

/// The largest of eight numbers, none of them NaN.
static inline double tl_f64x8_largest(tl_f64x8 a)
{
    return _mm512_reduce_max_pd(a);
}

static inline double tl_f64x8_smallest(tl_f64x8 a)
{
    return _mm512_reduce_min_pd(a);
}

/// Bit i: a[i] == b[i].
static inline uint32_t tl_f64x8_equal(tl_f64x8 a, tl_f64x8 b)
{
    return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ);
}

#else

// Registers of WIDE doubles, PARTS of them; the operations below are written once over these.
#if TL_SIMD_LEVEL == 2
enum { TL_F64_WIDE = 4, TL_F64_PARTS = 2 };
typedef __m256d tl_f64_part;
#define TL_F64_ALL(value)      _mm256_set1_pd(value)
#define TL_F64_LOAD(at)        _mm256_loadu_pd(at)
#define TL_F64_STORE(at, a)    _mm256_storeu_pd(at, a)
#define TL_F64_ADD(a, b)       _mm256_add_pd(a, b)
#define TL_F64_SUB(a, b)       _mm256_sub_pd(a, b)
#define TL_F64_MUL(a, b)       _mm256_mul_pd(a, b)
#define TL_F64_DIV(a, b)       _mm256_div_pd(a, b)
#define TL_F64_LESS(a, b)      _mm256_cmp_pd(a, b, _CMP_LT_OQ)
#define TL_F64_AND(a, b)       _mm256_and_pd(a, b)
#define TL_F64_WITHOUT(a, b)   _mm256_andnot_pd(b, a)
#define TL_F64_SELECT(m, a, b) _mm256_blendv_pd(b, a, m)
#define TL_F64_SIGNS(a)        _mm256_movemask_pd(a)
#define TL_F64_EQUAL(a, b)     _mm256_cmp_pd(a, b, _CMP_EQ_OQ)
#define TL_F64_MAX(a, b)       _mm256_max_pd(a, b)
#define TL_F64_MIN(a, b)       _mm256_min_pd(a, b)
#elif TL_SIMD_LEVEL == 1
enum { TL_F64_WIDE = 2, TL_F64_PARTS = 4 };
typedef tl_f64x2 tl_f64_part;
#define TL_F64_ALL(value)      tl_f64x2_all(value)
#define TL_F64_LOAD(at)        tl_f64x2_load(at)
#define TL_F64_STORE(at, a)    tl_f64x2_store(at, a)
#define TL_F64_ADD(a, b)       tl_f64x2_add(a, b)
#define TL_F64_SUB(a, b)       tl_f64x2_sub(a, b)
#define TL_F64_MUL(a, b)       tl_f64x2_mul(a, b)
#define TL_F64_DIV(a, b)       tl_f64x2_div(a, b)
#define TL_F64_LESS(a, b)      tl_f64x2_where_less(a, b)
#define TL_F64_AND(a, b)       tl_f64x2_and(a, b)
#define TL_F64_WITHOUT(a, b)   tl_f64x2_without(a, b)
#define TL_F64_SELECT(m, a, b) tl_f64x2_select(m, a, b)
#define TL_F64_SIGNS(a)        tl_f64x2_masks(a)
#define TL_F64_EQUAL(a, b)     tl_f64x2_where_equal(a, b)
#define TL_F64_MAX(a, b)       tl_f64x2_max(a, b)
#define TL_F64_MIN(a, b)       tl_f64x2_min(a, b)
#else
#error "eight doubles need level 1 at least"
#endif

typedef struct tl_f64x8 {
    tl_f64_part part[TL_F64_PARTS];
} tl_f64x8;
typedef tl_f64x8 tl_mask64x8;

#define TL_F64_EACH(expression)                                                                                        \
    tl_f64x8 r;                                                                                                        \
    for (int i = 0; i < TL_F64_PARTS; i++) {                                                                           \
        r.part[i] = expression;                                                                                        \
    }                                                                                                                  \
    return r

static inline tl_f64x8 tl_f64x8_all(double value)
{
    TL_F64_EACH(TL_F64_ALL(value));
}

static inline tl_f64x8 tl_f64x8_load(const double *eight)
{
    TL_F64_EACH(TL_F64_LOAD(eight + i * TL_F64_WIDE));
}

static inline void tl_f64x8_store(double *eight, tl_f64x8 a)
{
    for (int i = 0; i < TL_F64_PARTS; i++) {
        TL_F64_STORE(eight + i * TL_F64_WIDE, a.part[i]);
    }
}

static inline tl_f64x8 tl_f64x8_add(tl_f64x8 a, tl_f64x8 b)
{
    TL_F64_EACH(TL_F64_ADD(a.part[i], b.part[i]));
}

static inline tl_f64x8 tl_f64x8_sub(tl_f64x8 a, tl_f64x8 b)
{
    TL_F64_EACH(TL_F64_SUB(a.part[i], b.part[i]));
}

static inline tl_f64x8 tl_f64x8_mul(tl_f64x8 a, tl_f64x8 b)
{
    TL_F64_EACH(TL_F64_MUL(a.part[i], b.part[i]));
}

static inline tl_f64x8 tl_f64x8_div(tl_f64x8 a, tl_f64x8 b)
{
    TL_F64_EACH(TL_F64_DIV(a.part[i], b.part[i]));
}

static inline tl_mask64x8 tl_f64x8_less(tl_f64x8 a, tl_f64x8 b)
{
    TL_F64_EACH(TL_F64_LESS(a.part[i], b.part[i]));
}

static inline tl_mask64x8 tl_mask64x8_and(tl_mask64x8 a, tl_mask64x8 b)
{
    TL_F64_EACH(TL_F64_AND(a.part[i], b.part[i]));
}

static inline tl_mask64x8 tl_mask64x8_without(tl_mask64x8 a, tl_mask64x8 b)
{
    TL_F64_EACH(TL_F64_WITHOUT(a.part[i], b.part[i]));
}

static inline bool tl_mask64x8_any(tl_mask64x8 a)
{
#if TL_SIMD_LEVEL == 1
    return tl_f64x2_any(a.part[0], a.part[1], a.part[2], a.part[3]);
#else
    return (TL_F64_SIGNS(a.part[0]) | TL_F64_SIGNS(a.part[1])) != 0;
#endif
}

static inline tl_f64x8 tl_f64x8_select(tl_mask64x8 mask, tl_f64x8 a, tl_f64x8 b)
{
    TL_F64_EACH(TL_F64_SELECT(mask.part[i], a.part[i], b.part[i]));
}

static inline double tl_f64x8_largest(tl_f64x8 a)
{
    double lanes[TL_F64_WIDE];
    for (int i = 1; i < TL_F64_PARTS; i++) {
        a.part[0] = TL_F64_MAX(a.part[0], a.part[i]);
    }
    TL_F64_STORE(lanes, a.part[0]);
    for (int i = 1; i < TL_F64_WIDE; i++) {
        lanes[0] = lanes[i] > lanes[0] ? lanes[i] : lanes[0];
    }
    return lanes[0];
}

static inline double tl_f64x8_smallest(tl_f64x8 a)
{
    double lanes[TL_F64_WIDE];
    for (int i = 1; i < TL_F64_PARTS; i++) {
        a.part[0] = TL_F64_MIN(a.part[0], a.part[i]);
    }
    TL_F64_STORE(lanes, a.part[0]);
    for (int i = 1; i < TL_F64_WIDE; i++) {
        lanes[0] = lanes[i] < lanes[0] ? lanes[i] : lanes[0];
    }
    return lanes[0];
}

static inline uint32_t tl_f64x8_equal(tl_f64x8 a, tl_f64x8 b)
{
    uint32_t bits = 0;
    for (int i = 0; i < TL_F64_PARTS; i++) {
        bits |= (uint32_t)TL_F64_SIGNS(TL_F64_EQUAL(a.part[i], b.part[i])) << (i * TL_F64_WIDE);
    }
    return bits;
}

#endif

#endif
