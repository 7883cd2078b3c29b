// SPDX-License-Identifier: MIT
//
// The vocabulary of simd.h for four doubles. Nothing here is fused, so all instruction sets give the same bits.

#ifndef TALUS_SRC_MATH_SIMD4D_H
#define TALUS_SRC_MATH_SIMD4D_H

#include "math/simd.h"
#include "math/simd2d.h"

#include <math.h>

#if TL_SIMD_LEVEL >= 2

typedef __m256d tl_f64x4;

static inline tl_f64x4 tl_f64x4_all(double value)
{
    return _mm256_set1_pd(value);
}

/// Floats 0, stride and 2 * stride as doubles; the fourth lane is 0.
static inline tl_f64x4 tl_f64x4_gather_three(const float *first, uint32_t stride)
{
    // As integers: compilers make two shuffles of a float that is loaded to be inserted.
    int32_t x, y, z;
    memcpy(&x, first, sizeof x);
    memcpy(&y, first + stride, sizeof y);
    memcpy(&z, first + 2 * (size_t)stride, sizeof z);
    __m128i xyz = _mm_insert_epi32(_mm_insert_epi32(_mm_cvtsi32_si128(x), y, 1), z, 2);
    return _mm256_cvtps_pd(_mm_castsi128_ps(xyz));
}

static inline tl_f64x4 tl_f64x4_of_floats(tl_f32x4 a)
{
    return _mm256_cvtps_pd(a);
}

static inline void tl_f64x4_store_floats(float *four, tl_f64x4 a)
{
    _mm_storeu_ps(four, _mm256_cvtpd_ps(a));
}

static inline tl_f32x4 tl_f64x4_to_floats(tl_f64x4 a)
{
    return _mm256_cvtpd_ps(a);
}

static inline tl_f64x4 tl_f64x4_add(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_add_pd(a, b);
}

static inline tl_f64x4 tl_f64x4_sub(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_sub_pd(a, b);
}

static inline tl_f64x4 tl_f64x4_mul(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_mul_pd(a, b);
}

/// The second where one is no number.
static inline tl_f64x4 tl_f64x4_max(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_max_pd(a, b);
}

/// The second where one is no number.
static inline tl_f64x4 tl_f64x4_min(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_min_pd(a, b);
}

static inline tl_f64x4 tl_f64x4_div(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_div_pd(a, b);
}

/// Doubles 0 .. 3 of places in a row.
static inline tl_f64x4 tl_f64x4_gather(const double *row, const uint32_t at[4])
{
    __m128d low = _mm_loadh_pd(_mm_load_sd(row + at[0]), row + at[1]),
            high = _mm_loadh_pd(_mm_load_sd(row + at[2]), row + at[3]);
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(low), high, 1);
}

static inline __m128 tl_f64x4_two_floats(const float *p, const float *q)
{
    return _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd((const double *)(const void *)p), (const double *)(const void *)q));
}

/// Points of three floats at four places of a row, as doubles.
static inline void tl_f64x4_gather_points(const float *row, const uint32_t at[4], tl_f64x4 *x, tl_f64x4 *y, tl_f64x4 *z)
{
    const float *p = row + 3 * (size_t)at[0], *q = row + 3 * (size_t)at[1], *r = row + 3 * (size_t)at[2],
                *s = row + 3 * (size_t)at[3];
    int32_t height[4]; // as integers: see tl_f64x4_gather_three
    memcpy(&height[0], p + 2, sizeof height[0]);
    memcpy(&height[1], q + 2, sizeof height[1]);
    memcpy(&height[2], r + 2, sizeof height[2]);
    memcpy(&height[3], s + 2, sizeof height[3]);
    __m128i z4 = _mm_insert_epi32(
        _mm_insert_epi32(_mm_insert_epi32(_mm_cvtsi32_si128(height[0]), height[1], 1), height[2], 2), height[3], 3);
    __m128 low = tl_f64x4_two_floats(p, q), high = tl_f64x4_two_floats(r, s);
    *x = _mm256_cvtps_pd(_mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)));
    *y = _mm256_cvtps_pd(_mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)));
    *z = _mm256_cvtps_pd(_mm_castsi128_ps(z4));
}

/// Bit k: lane k of a equals that of b.
static inline uint32_t tl_f64x4_equal(tl_f64x4 a, tl_f64x4 b)
{
    return (uint32_t)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_EQ_OQ));
}

static inline tl_f64x4 tl_f64x4_sqrt(tl_f64x4 a)
{
    return _mm256_sqrt_pd(a);
}

/// Lanes of x where a is less than b, else of y.
static inline tl_f64x4 tl_f64x4_where_less(tl_f64x4 a, tl_f64x4 b, tl_f64x4 x, tl_f64x4 y)
{
    return _mm256_blendv_pd(y, x, _mm256_cmp_pd(a, b, _CMP_LT_OQ));
}

/// Bit k: lane k of a is less than that of b.
static inline uint32_t tl_f64x4_less(tl_f64x4 a, tl_f64x4 b)
{
    return (uint32_t)_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LT_OQ));
}

/// Lanes 1, 2, 3 of a and 0 of b.
static inline tl_f64x4 tl_f64x4_next(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_shuffle_pd(a, _mm256_permute2f128_pd(a, b, 0x21), 5);
}

/// Four points, x y z x y z ..., as doubles.
static inline void tl_f64x4_load_points(const float *points, tl_f64x4 *x, tl_f64x4 *y, tl_f64x4 *z)
{
    __m128 a = _mm_loadu_ps(points), b = _mm_loadu_ps(points + 4), c = _mm_loadu_ps(points + 8); // xyzx yzxy zxyz
    __m128 yz = _mm_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1)), xy = _mm_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
    *x = _mm256_cvtps_pd(_mm_shuffle_ps(a, xy, _MM_SHUFFLE(2, 0, 3, 0)));
    *y = _mm256_cvtps_pd(_mm_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0)));
    *z = _mm256_cvtps_pd(_mm_shuffle_ps(yz, c, _MM_SHUFFLE(3, 0, 3, 1)));
}

/// Lanes 1, 2, 0, 3.
static inline tl_f64x4 tl_f64x4_rotate_three(tl_f64x4 a)
{
    return _mm256_permute4x64_pd(a, _MM_SHUFFLE(3, 0, 2, 1));
}

/// Lanes 1, 0, 3, 2.
static inline tl_f64x4 tl_f64x4_swap_lanes(tl_f64x4 a)
{
    return _mm256_permute_pd(a, 5);
}

/// Lanes 2, 3, 0, 1.
static inline tl_f64x4 tl_f64x4_swap_halves(tl_f64x4 a)
{
    return _mm256_permute2f128_pd(a, a, 1);
}

/// The largest lane of each.
static inline tl_f64x2 tl_f64x4_largest_of_two(tl_f64x4 a, tl_f64x4 b)
{
    const tl_f64x4 two = _mm256_max_pd(_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
    return _mm_max_pd(_mm256_castpd256_pd128(two), _mm256_extractf128_pd(two, 1));
}

static inline double tl_f64x4_get_x(tl_f64x4 a)
{
    return _mm256_cvtsd_f64(a);
}

static inline double tl_f64x4_get_y(tl_f64x4 a)
{
    return _mm_cvtsd_f64(_mm_unpackhi_pd(_mm256_castpd256_pd128(a), _mm256_castpd256_pd128(a)));
}

static inline double tl_f64x4_get_z(tl_f64x4 a)
{
    return _mm_cvtsd_f64(_mm256_extractf128_pd(a, 1));
}

static inline tl_f64x4 tl_f64x4_load(const double *four)
{
    return _mm256_loadu_pd(four);
}

/// The same of what was just stored by twos, or compilers copy by twos: one load of both would wait for both stores.
static inline tl_f64x4 tl_f64x4_load_twos(const double *four)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(four)), _mm_loadu_pd(four + 2), 1);
}

static inline void tl_f64x4_store(double *four, tl_f64x4 a)
{
    _mm256_storeu_pd(four, a);
}

#elif TL_SIMD_LEVEL == 1 && TL_CPU_BASE_LEVEL == 1

// Two registers. (With SSE4.2 compilers make the same of plain C.)
typedef struct tl_f64x4 {
    tl_f64x2 low, high;
} tl_f64x4;

static inline tl_f64x4 tl_f64x4_make(tl_f64x2 low, tl_f64x2 high)
{
    tl_f64x4 r = { low, high };
    return r;
}

static inline tl_f64x4 tl_f64x4_all(double value)
{
    return tl_f64x4_make(tl_f64x2_all(value), tl_f64x2_all(value));
}

static inline tl_f64x4 tl_f64x4_of_floats(tl_f32x4 a)
{
    return tl_f64x4_make(tl_f64x2_of_low(a), tl_f64x2_of_high(a));
}

static inline tl_f64x4 tl_f64x4_gather_three(const float *first, uint32_t stride)
{
    return tl_f64x4_of_floats(tl_f32x4_gather_three(first, first + stride, first + 2 * (size_t)stride));
}

static inline void tl_f64x4_store_floats(float *four, tl_f64x4 a)
{
    tl_f32x4_store(four, tl_f64x2_to_floats(a.low, a.high));
}

static inline tl_f32x4 tl_f64x4_to_floats(tl_f64x4 a)
{
    return tl_f64x2_to_floats(a.low, a.high);
}

static inline tl_f64x4 tl_f64x4_add(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x4_make(tl_f64x2_add(a.low, b.low), tl_f64x2_add(a.high, b.high));
}

static inline tl_f64x4 tl_f64x4_sub(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x4_make(tl_f64x2_sub(a.low, b.low), tl_f64x2_sub(a.high, b.high));
}

static inline tl_f64x4 tl_f64x4_mul(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x4_make(tl_f64x2_mul(a.low, b.low), tl_f64x2_mul(a.high, b.high));
}

static inline tl_f64x4 tl_f64x4_max(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x4_make(tl_f64x2_max(a.low, b.low), tl_f64x2_max(a.high, b.high));
}

static inline tl_f64x4 tl_f64x4_min(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x4_make(tl_f64x2_min(a.low, b.low), tl_f64x2_min(a.high, b.high));
}

static inline tl_f64x4 tl_f64x4_div(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x4_make(tl_f64x2_div(a.low, b.low), tl_f64x2_div(a.high, b.high));
}

static inline tl_f64x4 tl_f64x4_gather(const double *row, const uint32_t at[4])
{
    const double four[4] = { row[at[0]], row[at[1]], row[at[2]], row[at[3]] };
    return tl_f64x4_make(tl_f64x2_load(four), tl_f64x2_load(four + 2));
}

static inline void tl_f64x4_gather_points(const float *row, const uint32_t at[4], tl_f64x4 *x, tl_f64x4 *y, tl_f64x4 *z)
{
    float four[12];
    for (int i = 0; i < 4; i++) {
        memcpy(&four[3 * i], row + 3 * (size_t)at[i], 3 * sizeof *row);
    }
    tl_f64x2 x2[2], y2[2], z2[2];
    tl_f64x2_load_points(four, x2, y2, z2);
    *x = tl_f64x4_make(x2[0], x2[1]);
    *y = tl_f64x4_make(y2[0], y2[1]);
    *z = tl_f64x4_make(z2[0], z2[1]);
}

static inline uint32_t tl_f64x4_equal(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x2_two_masks(tl_f64x2_where_equal(a.low, b.low), tl_f64x2_where_equal(a.high, b.high));
}

static inline tl_f64x4 tl_f64x4_sqrt(tl_f64x4 a)
{
    const double four[4] = { sqrt(tl_f64x2_get_x(a.low)), sqrt(tl_f64x2_get_y(a.low)), sqrt(tl_f64x2_get_x(a.high)),
                             sqrt(tl_f64x2_get_y(a.high)) };
    return tl_f64x4_make(tl_f64x2_load(four), tl_f64x2_load(four + 2));
}

static inline tl_f64x4 tl_f64x4_where_less(tl_f64x4 a, tl_f64x4 b, tl_f64x4 x, tl_f64x4 y)
{
    return tl_f64x4_make(tl_f64x2_select(tl_f64x2_where_less(a.low, b.low), x.low, y.low),
                         tl_f64x2_select(tl_f64x2_where_less(a.high, b.high), x.high, y.high));
}

static inline uint32_t tl_f64x4_less(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x2_two_masks(tl_f64x2_where_less(a.low, b.low), tl_f64x2_where_less(a.high, b.high));
}

static inline tl_f64x4 tl_f64x4_next(tl_f64x4 a, tl_f64x4 b)
{
    return tl_f64x4_make(tl_f64x2_yx(a.low, a.high), tl_f64x2_yx(a.high, b.low));
}

static inline void tl_f64x4_load_points(const float *points, tl_f64x4 *x, tl_f64x4 *y, tl_f64x4 *z)
{
    tl_f64x2 x2[2], y2[2], z2[2];
    tl_f64x2_load_points(points, x2, y2, z2);
    *x = tl_f64x4_make(x2[0], x2[1]);
    *y = tl_f64x4_make(y2[0], y2[1]);
    *z = tl_f64x4_make(z2[0], z2[1]);
}

static inline tl_f64x4 tl_f64x4_rotate_three(tl_f64x4 a)
{
    return tl_f64x4_make(tl_f64x2_yx(a.low, a.high), tl_f64x2_xy(a.low, a.high));
}

static inline tl_f64x4 tl_f64x4_swap_lanes(tl_f64x4 a)
{
    return tl_f64x4_make(tl_f64x2_swap(a.low), tl_f64x2_swap(a.high));
}

static inline tl_f64x4 tl_f64x4_swap_halves(tl_f64x4 a)
{
    return tl_f64x4_make(a.high, a.low);
}

static inline double tl_f64x4_get_x(tl_f64x4 a)
{
    return tl_f64x2_get_x(a.low);
}

static inline double tl_f64x4_get_y(tl_f64x4 a)
{
    return tl_f64x2_get_y(a.low);
}

static inline double tl_f64x4_get_z(tl_f64x4 a)
{
    return tl_f64x2_get_x(a.high);
}

static inline tl_f64x4 tl_f64x4_load(const double *four)
{
    tl_f64x4 r = { tl_f64x2_load(four), tl_f64x2_load(four + 2) };
    return r;
}

static inline tl_f64x4 tl_f64x4_load_twos(const double *four)
{
    return tl_f64x4_load(four);
}

static inline void tl_f64x4_store(double *four, tl_f64x4 a)
{
    tl_f64x2_store(four, a.low);
    tl_f64x2_store(four + 2, a.high);
}

#else

typedef struct tl_f64x4 {
    double v[4];
} tl_f64x4;

static inline tl_f64x4 tl_f64x4_all(double value)
{
    tl_f64x4 r = { { value, value, value, value } };
    return r;
}

static inline tl_f64x4 tl_f64x4_gather_three(const float *first, uint32_t stride)
{
    tl_f64x4 r = { { (double)first[0], (double)first[stride], (double)first[2 * (size_t)stride], 0.0 } };
    return r;
}

static inline tl_f64x4 tl_f64x4_of_floats(tl_f32x4 a)
{
    float four[4];
    tl_f32x4_store(four, a);
    tl_f64x4 r = { { (double)four[0], (double)four[1], (double)four[2], (double)four[3] } };
    return r;
}

static inline void tl_f64x4_store_floats(float *four, tl_f64x4 a)
{
    for (int i = 0; i < 4; i++) {
        four[i] = (float)a.v[i];
    }
}

static inline tl_f32x4 tl_f64x4_to_floats(tl_f64x4 a)
{
    return tl_f32x4_make((float)a.v[0], (float)a.v[1], (float)a.v[2], (float)a.v[3]);
}

static inline tl_f64x4 tl_f64x4_add(tl_f64x4 a, tl_f64x4 b)
{
    tl_f64x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] + b.v[i];
    }
    return r;
}

static inline tl_f64x4 tl_f64x4_sub(tl_f64x4 a, tl_f64x4 b)
{
    tl_f64x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] - b.v[i];
    }
    return r;
}

static inline tl_f64x4 tl_f64x4_mul(tl_f64x4 a, tl_f64x4 b)
{
    tl_f64x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] * b.v[i];
    }
    return r;
}

static inline tl_f64x4 tl_f64x4_max(tl_f64x4 a, tl_f64x4 b)
{
    tl_f64x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    }
    return r;
}

static inline tl_f64x4 tl_f64x4_min(tl_f64x4 a, tl_f64x4 b)
{
    tl_f64x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] < b.v[i] ? a.v[i] : b.v[i];
    }
    return r;
}

static inline tl_f64x4 tl_f64x4_div(tl_f64x4 a, tl_f64x4 b)
{
    tl_f64x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] / b.v[i];
    }
    return r;
}

static inline tl_f64x4 tl_f64x4_gather(const double *row, const uint32_t at[4])
{
    tl_f64x4 r = { { row[at[0]], row[at[1]], row[at[2]], row[at[3]] } };
    return r;
}

static inline void tl_f64x4_gather_points(const float *row, const uint32_t at[4], tl_f64x4 *x, tl_f64x4 *y, tl_f64x4 *z)
{
    for (int i = 0; i < 4; i++) {
        const float *p = row + 3 * (size_t)at[i];
        x->v[i] = (double)p[0];
        y->v[i] = (double)p[1];
        z->v[i] = (double)p[2];
    }
}

static inline tl_f64x4 tl_f64x4_sqrt(tl_f64x4 a)
{
    tl_f64x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = sqrt(a.v[i]);
    }
    return r;
}

static inline tl_f64x4 tl_f64x4_where_less(tl_f64x4 a, tl_f64x4 b, tl_f64x4 x, tl_f64x4 y)
{
    tl_f64x4 r;
    for (int i = 0; i < 4; i++) {
        r.v[i] = a.v[i] < b.v[i] ? x.v[i] : y.v[i];
    }
    return r;
}

static inline uint32_t tl_f64x4_less(tl_f64x4 a, tl_f64x4 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 4; i++) {
        mask |= (a.v[i] < b.v[i] ? 1u : 0u) << i;
    }
    return mask;
}

static inline tl_f64x4 tl_f64x4_next(tl_f64x4 a, tl_f64x4 b)
{
    tl_f64x4 r = { { a.v[1], a.v[2], a.v[3], b.v[0] } };
    return r;
}

static inline uint32_t tl_f64x4_equal(tl_f64x4 a, tl_f64x4 b)
{
    uint32_t mask = 0;
    for (int i = 0; i < 4; i++) {
        mask |= (a.v[i] == b.v[i] ? 1u : 0u) << i;
    }
    return mask;
}

static inline void tl_f64x4_load_points(const float *points, tl_f64x4 *x, tl_f64x4 *y, tl_f64x4 *z)
{
    for (int i = 0; i < 4; i++) {
        x->v[i] = (double)points[3 * i];
        y->v[i] = (double)points[3 * i + 1];
        z->v[i] = (double)points[3 * i + 2];
    }
}

static inline tl_f64x4 tl_f64x4_rotate_three(tl_f64x4 a)
{
    tl_f64x4 r = { { a.v[1], a.v[2], a.v[0], a.v[3] } };
    return r;
}

static inline tl_f64x4 tl_f64x4_swap_lanes(tl_f64x4 a)
{
    tl_f64x4 r = { { a.v[1], a.v[0], a.v[3], a.v[2] } };
    return r;
}

static inline tl_f64x4 tl_f64x4_swap_halves(tl_f64x4 a)
{
    tl_f64x4 r = { { a.v[2], a.v[3], a.v[0], a.v[1] } };
    return r;
}

static inline double tl_f64x4_get_x(tl_f64x4 a)
{
    return a.v[0];
}

static inline double tl_f64x4_get_y(tl_f64x4 a)
{
    return a.v[1];
}

static inline double tl_f64x4_get_z(tl_f64x4 a)
{
    return a.v[2];
}

static inline tl_f64x4 tl_f64x4_load(const double *four)
{
    tl_f64x4 r;
    memcpy(r.v, four, sizeof r.v);
    return r;
}

static inline tl_f64x4 tl_f64x4_load_twos(const double *four)
{
    return tl_f64x4_load(four);
}

static inline void tl_f64x4_store(double *four, tl_f64x4 a)
{
    memcpy(four, a.v, sizeof a.v);
}

#endif

/// Absolute values.
static inline tl_f64x4 tl_f64x4_abs(tl_f64x4 a)
{
    return tl_f64x4_max(a, tl_f64x4_sub(tl_f64x4_all(0.0), a));
}

/// Lanes 0 to 2 of a x b; the fourth is 0 where those of a and b are numbers.
static inline tl_f64x4 tl_f64x4_cross(tl_f64x4 a, tl_f64x4 b)
{
    // z, x, y of the product.
    tl_f64x4 turned =
        tl_f64x4_sub(tl_f64x4_mul(a, tl_f64x4_rotate_three(b)), tl_f64x4_mul(tl_f64x4_rotate_three(a), b));
    return tl_f64x4_rotate_three(turned);
}

#endif
