// SPDX-License-Identifier: MIT
//
// The vocabulary of simd.h for four doubles. Nothing here is fused, so all instruction sets give the same bits.

#ifndef TALUS_SRC_MATH_SIMD4D_H
#define TALUS_SRC_MATH_SIMD4D_H

#include "math/simd.h"

#if TL_SIMD_LEVEL >= 2

typedef __m256d tl_f64x4;

static inline tl_f64x4 tl_f64x4_all(double value)
{
    return _mm256_set1_pd(value);
}

/// Four floats as doubles.
static inline tl_f64x4 tl_f64x4_make(float x, float y, float z, float w)
{
    return _mm256_cvtps_pd(_mm_setr_ps(x, y, z, w));
}

static inline tl_f64x4 tl_f64x4_sub(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_sub_pd(a, b);
}

static inline tl_f64x4 tl_f64x4_mul(tl_f64x4 a, tl_f64x4 b)
{
    return _mm256_mul_pd(a, b);
}

/// Lanes 1, 2, 0, 3.
static inline tl_f64x4 tl_f64x4_rotate_three(tl_f64x4 a)
{
    return _mm256_permute4x64_pd(a, _MM_SHUFFLE(3, 0, 2, 1));
}

/// Lane 0 in all lanes.
static inline tl_f64x4 tl_f64x4_first(tl_f64x4 a)
{
    return _mm256_broadcastsd_pd(_mm256_castpd256_pd128(a));
}

static inline void tl_f64x4_store(double *four, tl_f64x4 a)
{
    _mm256_storeu_pd(four, a);
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

static inline tl_f64x4 tl_f64x4_make(float x, float y, float z, float w)
{
    tl_f64x4 r = { { (double)x, (double)y, (double)z, (double)w } };
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

static inline tl_f64x4 tl_f64x4_rotate_three(tl_f64x4 a)
{
    tl_f64x4 r = { { a.v[1], a.v[2], a.v[0], a.v[3] } };
    return r;
}

static inline tl_f64x4 tl_f64x4_first(tl_f64x4 a)
{
    return tl_f64x4_all(a.v[0]);
}

static inline void tl_f64x4_store(double *four, tl_f64x4 a)
{
    memcpy(four, a.v, sizeof a.v);
}

#endif

#endif
