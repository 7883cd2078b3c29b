// SPDX-License-Identifier: MIT
//
// Boxes in two registers, for loops that do little but grow boxes. What every processor of the target has: SSE2,
// NEON, simd128, or plain C. Minima and maxima do not round, so all give the same bits. The fourth lanes hold nothing
// of use.

#ifndef TALUS_SRC_MATH_BOX4_H
#define TALUS_SRC_MATH_BOX4_H

#include "base/cpu.h"
#include "base/exact_floats.h"

#include <talus/vec.h>

#include <stdint.h>

#if defined(__SSE2__) && !defined(TALUS_NO_SIMD)

#include <emmintrin.h>

typedef struct tl_box4 {
    __m128 min, max;
} tl_box4;

/// From arrays of four; the fourth numbers may be anything.
static inline tl_box4 tl_box4_load(const float *min, const float *max)
{
    // An integer's bits in a fourth lane are a denormal, on which arithmetic is slow.
    const __m128 three = _mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0));
    tl_box4 r = { _mm_and_ps(_mm_loadu_ps(min), three), _mm_and_ps(_mm_loadu_ps(max), three) };
    return r;
}

static inline tl_box4 tl_box4_of(tl_aabb box)
{
    tl_box4 r = { _mm_setr_ps(box.min.x, box.min.y, box.min.z, 0.0f),
                  _mm_setr_ps(box.max.x, box.max.y, box.max.z, 0.0f) };
    return r;
}

static inline tl_box4 tl_box4_empty(void)
{
    tl_box4 r = { _mm_set1_ps(INFINITY), _mm_set1_ps(-INFINITY) };
    return r;
}

static inline tl_box4 tl_box4_union(tl_box4 a, tl_box4 b)
{
    tl_box4 r = { _mm_min_ps(a.min, b.min), _mm_max_ps(a.max, b.max) };
    return r;
}

/// What both hold; inside out where that is nothing.
static inline tl_box4 tl_box4_intersection(tl_box4 a, tl_box4 b)
{
    tl_box4 r = { _mm_max_ps(a.min, b.min), _mm_min_ps(a.max, b.max) };
    return r;
}

/// The doubled middle, as a box.
static inline tl_box4 tl_box4_middle(tl_box4 a)
{
    __m128 middle = _mm_add_ps(a.min, a.max);
    tl_box4 r = { middle, middle };
    return r;
}

static inline tl_aabb tl_box4_to_aabb(tl_box4 a)
{
    float min[4], max[4];
    _mm_storeu_ps(min, a.min);
    _mm_storeu_ps(max, a.max);
    tl_aabb r = { tl_vec3_make(min[0], min[1], min[2]), tl_vec3_make(max[0], max[1], max[2]) };
    return r;
}

/// tl_aabb_half_area, to the bit.
static inline float tl_box4_half_area(tl_box4 a)
{
    __m128 size = _mm_sub_ps(a.max, a.min);
    __m128 sides = _mm_mul_ps(size, _mm_shuffle_ps(size, size, _MM_SHUFFLE(3, 0, 2, 1)));
    __m128 two = _mm_add_ss(sides, _mm_shuffle_ps(sides, sides, _MM_SHUFFLE(1, 1, 1, 1)));
    return _mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps(sides, sides, _MM_SHUFFLE(2, 2, 2, 2))));
}

/// Lane i of (a.min - base) * scale, cut to 0 .. last, without its fraction.
static inline void tl_box4_cells(tl_box4 a, const float base[4], const float scale[4], float last, int32_t cells[4])
{
    __m128 place = _mm_mul_ps(_mm_sub_ps(a.min, _mm_loadu_ps(base)), _mm_loadu_ps(scale));
    // A NaN, of infinity times zero, ends up in the first cell.
    place = _mm_min_ps(_mm_max_ps(place, _mm_setzero_ps()), _mm_set1_ps(last));
    _mm_storeu_si128((__m128i *)(void *)cells, _mm_cvttps_epi32(place));
}

#elif TL_CPU_BASE_LEVEL == 1

#include "math/simd.h"

typedef struct tl_box4 {
    tl_f32x4 min, max;
} tl_box4;

static inline tl_box4 tl_box4_load(const float *min, const float *max)
{
    tl_box4 r = { tl_f32x4_load(min), tl_f32x4_load(max) };
    return r;
}

static inline tl_box4 tl_box4_of(tl_aabb box)
{
    tl_box4 r = { tl_f32x4_load_three(&box.min.x), tl_f32x4_load_three(&box.max.x) };
    return r;
}

static inline tl_box4 tl_box4_empty(void)
{
    tl_box4 r = { tl_f32x4_all(INFINITY), tl_f32x4_all(-INFINITY) };
    return r;
}

static inline tl_box4 tl_box4_union(tl_box4 a, tl_box4 b)
{
    tl_box4 r = { tl_f32x4_min(a.min, b.min), tl_f32x4_max(a.max, b.max) };
    return r;
}

static inline tl_box4 tl_box4_intersection(tl_box4 a, tl_box4 b)
{
    tl_box4 r = { tl_f32x4_max(a.min, b.min), tl_f32x4_min(a.max, b.max) };
    return r;
}

static inline tl_box4 tl_box4_middle(tl_box4 a)
{
    tl_f32x4 middle = tl_f32x4_add(a.min, a.max);
    tl_box4 r = { middle, middle };
    return r;
}

static inline tl_aabb tl_box4_to_aabb(tl_box4 a)
{
    tl_aabb r = { tl_vec3_make(tl_f32x4_get_x(a.min), tl_f32x4_get_y(a.min), tl_f32x4_get_z(a.min)),
                  tl_vec3_make(tl_f32x4_get_x(a.max), tl_f32x4_get_y(a.max), tl_f32x4_get_z(a.max)) };
    return r;
}

static inline float tl_box4_half_area(tl_box4 a)
{
    tl_f32x4 size = tl_f32x4_sub(a.max, a.min), sides = tl_f32x4_mul(size, tl_f32x4_rotate_three(size));
    return tl_f32x4_get_x(sides) + tl_f32x4_get_y(sides) + tl_f32x4_get_z(sides);
}

static inline void tl_box4_cells(tl_box4 a, const float base[4], const float scale[4], float last, int32_t cells[4])
{
    tl_f32x4 place = tl_f32x4_mul(tl_f32x4_sub(a.min, tl_f32x4_load(base)), tl_f32x4_load(scale));
    tl_f32x4_store_whole(cells, tl_f32x4_min(tl_f32x4_max(place, tl_f32x4_all(0.0f)), tl_f32x4_all(last)));
}

#else

typedef struct tl_box4 {
    tl_aabb box;
} tl_box4;

static inline tl_box4 tl_box4_load(const float *min, const float *max)
{
    tl_box4 r = { { tl_vec3_make(min[0], min[1], min[2]), tl_vec3_make(max[0], max[1], max[2]) } };
    return r;
}

static inline tl_box4 tl_box4_of(tl_aabb box)
{
    tl_box4 r = { box };
    return r;
}

static inline tl_box4 tl_box4_empty(void)
{
    tl_box4 r = { tl_aabb_empty() };
    return r;
}

static inline tl_box4 tl_box4_union(tl_box4 a, tl_box4 b)
{
    tl_box4 r = { tl_aabb_union(a.box, b.box) };
    return r;
}

static inline tl_box4 tl_box4_intersection(tl_box4 a, tl_box4 b)
{
    tl_box4 r = { tl_aabb_intersection(a.box, b.box) };
    return r;
}

static inline tl_box4 tl_box4_middle(tl_box4 a)
{
    tl_vec3 middle = tl_add(a.box.min, a.box.max);
    tl_box4 r = { { middle, middle } };
    return r;
}

static inline tl_aabb tl_box4_to_aabb(tl_box4 a)
{
    return a.box;
}

static inline float tl_box4_half_area(tl_box4 a)
{
    return tl_aabb_half_area(a.box);
}

static inline void tl_box4_cells(tl_box4 a, const float base[4], const float scale[4], float last, int32_t cells[4])
{
    const float at[3] = { a.box.min.x, a.box.min.y, a.box.min.z };
    for (int i = 0; i < 3; i++) {
        float place = (at[i] - base[i]) * scale[i];
        place = place > 0.0f ? place : 0.0f;
        cells[i] = (int32_t)(place < last ? place : last);
    }
    cells[3] = 0;
}

#endif

#endif
