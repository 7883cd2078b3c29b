// SPDX-License-Identifier: MIT
//
// Four floats at a time, for the support kernels: SSE2 where it is part of the platform, plain C elsewhere, with the
// same operations in the same order, so that both give the same bits.

#ifndef TALUS_SRC_HULL_LANES_H
#define TALUS_SRC_HULL_LANES_H

#include "base/lowest_bit.h"

#include <stdint.h>

#if defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>

typedef __m128 tl_lanes;

static inline tl_lanes tl_lanes_load(const float *p)
{
    return _mm_load_ps(p);
}

static inline void tl_lanes_store(float *p, tl_lanes a)
{
    _mm_store_ps(p, a);
}

static inline tl_lanes tl_lanes_all(float a)
{
    return _mm_set1_ps(a);
}

static inline tl_lanes tl_lanes_add(tl_lanes a, tl_lanes b)
{
    return _mm_add_ps(a, b);
}

static inline tl_lanes tl_lanes_sub(tl_lanes a, tl_lanes b)
{
    return _mm_sub_ps(a, b);
}

static inline tl_lanes tl_lanes_mul(tl_lanes a, tl_lanes b)
{
    return _mm_mul_ps(a, b);
}

static inline tl_lanes tl_lanes_max(tl_lanes a, tl_lanes b)
{
    return _mm_max_ps(a, b);
}

static inline tl_lanes tl_lanes_abs(tl_lanes a)
{
    return _mm_andnot_ps(_mm_set1_ps(-0.0f), a);
}

// Bit k is set when a >= b in lane k.
static inline uint32_t tl_lanes_mask_ge(tl_lanes a, tl_lanes b)
{
    return (uint32_t)_mm_movemask_ps(_mm_cmpge_ps(a, b));
}

static inline float tl_lanes_largest(tl_lanes a)
{
    tl_lanes b = _mm_max_ps(a, _mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 0, 3, 2)));
    return _mm_cvtss_f32(_mm_max_ps(b, _mm_shuffle_ps(b, b, _MM_SHUFFLE(2, 3, 0, 1))));
}

#else

typedef struct tl_lanes {
    float v[4];
} tl_lanes;

static inline tl_lanes tl_lanes_load(const float *p)
{
    tl_lanes r = { { p[0], p[1], p[2], p[3] } };
    return r;
}

static inline void tl_lanes_store(float *p, tl_lanes a)
{
    for (int i = 0; i < 4; i++) {
        p[i] = a.v[i];
    }
}

static inline tl_lanes tl_lanes_all(float a)
{
    tl_lanes r = { { a, a, a, a } };
    return r;
}

static inline tl_lanes tl_lanes_add(tl_lanes a, tl_lanes b)
{
    for (int i = 0; i < 4; i++) {
        a.v[i] += b.v[i];
    }
    return a;
}

static inline tl_lanes tl_lanes_sub(tl_lanes a, tl_lanes b)
{
    for (int i = 0; i < 4; i++) {
        a.v[i] -= b.v[i];
    }
    return a;
}

static inline tl_lanes tl_lanes_mul(tl_lanes a, tl_lanes b)
{
    for (int i = 0; i < 4; i++) {
        a.v[i] *= b.v[i];
    }
    return a;
}

static inline tl_lanes tl_lanes_max(tl_lanes a, tl_lanes b)
{
    for (int i = 0; i < 4; i++) {
        a.v[i] = a.v[i] > b.v[i] ? a.v[i] : b.v[i];
    }
    return a;
}

static inline tl_lanes tl_lanes_abs(tl_lanes a)
{
    for (int i = 0; i < 4; i++) {
        a.v[i] = a.v[i] < 0.0f ? -a.v[i] : a.v[i];
    }
    return a;
}

static inline uint32_t tl_lanes_mask_ge(tl_lanes a, tl_lanes b)
{
    uint32_t mask = 0;
    for (uint32_t i = 0; i < 4; i++) {
        mask |= (a.v[i] >= b.v[i] ? 1u : 0u) << i;
    }
    return mask;
}

static inline float tl_lanes_largest(tl_lanes a)
{
    float b = a.v[0] > a.v[2] ? a.v[0] : a.v[2];
    float c = a.v[1] > a.v[3] ? a.v[1] : a.v[3];
    return b > c ? b : c;
}

#endif

#endif
