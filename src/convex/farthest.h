// SPDX-License-Identifier: MIT
//
// The farthest of a few points along a direction, in double, with no branch that depends on the data: which vertex wins
// is as good as random to a branch predictor, and a wrong guess costs more than four points.
//
// Points stay where they are, x y z x y z ...; four of them are turned to three registers at a time. The first pass
// keeps the largest product, the second finds the first that equals it: the lowest index wins, as it does in plain C.

#ifndef TALUS_SRC_CONVEX_FARTHEST_H
#define TALUS_SRC_CONVEX_FARTHEST_H

#include "base/lowest_bit.h"
#include "math/vec3d.h"

#if defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>

enum { TL_FARTHEST_BLOCK = 32 }; // products that are kept at a time; their mask is one word

static inline __m128d tl_farthest_two(const __m128d d[3], __m128 x, __m128 y, __m128 z)
{
    return _mm_add_pd(_mm_add_pd(_mm_mul_pd(d[0], _mm_cvtps_pd(x)), _mm_mul_pd(d[1], _mm_cvtps_pd(y))),
                      _mm_mul_pd(d[2], _mm_cvtps_pd(z)));
}

// The products of four points; returns the larger ones.
static inline __m128d tl_farthest_four(const __m128d d[3], const tl_vec3 *points, double *dots)
{
    const float *p = &points->x;
    __m128 a = _mm_loadu_ps(p), b = _mm_loadu_ps(p + 4), c = _mm_loadu_ps(p + 8); // xyzx yzxy zxyz
    __m128 yz = _mm_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1)), xy = _mm_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
    __m128 x = _mm_shuffle_ps(a, xy, _MM_SHUFFLE(2, 0, 3, 0)), y = _mm_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0)),
           z = _mm_shuffle_ps(yz, c, _MM_SHUFFLE(3, 0, 3, 1));
    __m128d low = tl_farthest_two(d, x, y, z),
            high = tl_farthest_two(d, _mm_movehl_ps(x, x), _mm_movehl_ps(y, y), _mm_movehl_ps(z, z));
    _mm_storeu_pd(dots, low);
    _mm_storeu_pd(dots + 2, high);
    return _mm_max_pd(low, high);
}

// Bit k of the result: product k is the largest. Of four.
static inline uint32_t tl_farthest_mask(const double *dots, __m128d largest)
{
    return (uint32_t)_mm_movemask_pd(_mm_cmpeq_pd(_mm_load_pd(dots), largest)) |
           (uint32_t)_mm_movemask_pd(_mm_cmpeq_pd(_mm_load_pd(dots + 2), largest)) << 2;
}

// Of 4 .. TL_FARTHEST_BLOCK points.
static inline uint32_t tl_farthest_of_block(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction,
                                            double *dot_out)
{
    _Alignas(16) double dots[TL_FARTHEST_BLOCK];
    const __m128d d[3] = { _mm_set1_pd(direction->x), _mm_set1_pd(direction->y), _mm_set1_pd(direction->z) };
    __m128d best = tl_farthest_four(d, points, dots);
    uint32_t i = 4, mask = 0;
    for (; i + 4 <= count; i += 4) {
        best = _mm_max_pd(best, tl_farthest_four(d, points + i, dots + i));
    }
    if (i < count) {
        // Some of the last four are computed again. What lies beyond in the row must not win: NaN equals nothing, not
        // even where the direction or all points are infinite.
        best = _mm_max_pd(best, tl_farthest_four(d, points + (count - 4), dots + (count - 4)));
        for (uint32_t k = count; k < i + 4; k++) {
            dots[k] = (double)NAN;
        }
    }
    best = _mm_max_pd(best, _mm_shuffle_pd(best, best, 1));
    for (i = 0; i < count; i += 4) {
        mask |= tl_farthest_mask(dots + i, best) << i;
    }
    *dot_out = _mm_cvtsd_f64(best);
    return mask != 0 ? tl_lowest_bit(mask) : 0; // 0: the direction is not finite
}

#endif

static inline uint32_t tl_farthest_plain(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction)
{
    uint32_t best = 0;
    double best_dot = tl_vec3d_dot(*direction, tl_vec3d_from(points[0]));
    for (uint32_t i = 1; i < count; i++) {
        double dot = tl_vec3d_dot(*direction, tl_vec3d_from(points[i]));
        best = dot > best_dot ? i : best;
        best_dot = dot > best_dot ? dot : best_dot;
    }
    return best;
}

#if defined(__SSE2__) || defined(_M_X64)
static inline uint32_t tl_farthest_of_many(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction)
{
    uint32_t best = 0;
    double best_dot = -(double)INFINITY, dot;
    for (uint32_t from = 0; from < count;) {
        uint32_t left = count - from, size = left < TL_FARTHEST_BLOCK ? left : TL_FARTHEST_BLOCK;
        if (size < 4) {
            from = count - 4;
            size = 4;
        }
        uint32_t index = from + tl_farthest_of_block(points + from, size, direction, &dot);
        best = dot > best_dot ? index : best;
        best_dot = dot > best_dot ? dot : best_dot;
        from += size;
    }
    return best;
}
#endif

// Of count >= 1 points; the lowest index of several that are equally far.
static inline uint32_t tl_farthest(const tl_vec3 *points, uint32_t count, const tl_vec3d *direction)
{
#if defined(__SSE2__) || defined(_M_X64)
    if (count >= 4) {
        double dot;
        return count <= TL_FARTHEST_BLOCK ? tl_farthest_of_block(points, count, direction, &dot)
                                          : tl_farthest_of_many(points, count, direction);
    }
#endif
    return tl_farthest_plain(points, count, direction);
}

#endif
