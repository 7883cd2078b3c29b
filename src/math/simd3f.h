// SPDX-License-Identifier: MIT
//
// Three floats, a point, in a register that every processor of the target has: SSE2, NEON, simd128. Nothing here is
// fused, so all give the bits of the plain C at the end. The register has a fourth lane, which nothing reads.

#ifndef TALUS_SRC_MATH_SIMD3F_H
#define TALUS_SRC_MATH_SIMD3F_H

#include "math/simd.h"

#include <stdbool.h>
#include <talus/vec.h>

#if (defined(__SSE2__) || defined(_M_X64)) && !defined(TALUS_NO_SIMD)

#include <immintrin.h>

typedef __m128 tl_f32x3;

static inline tl_f32x3 tl_f32x3_of(tl_vec3 v)
{
    return _mm_setr_ps(v.x, v.y, v.z, 0.0f);
}

/// Three numbers of 16 bits; eight bytes are read.
static inline tl_f32x3 tl_f32x3_from_u16(const void *numbers)
{
    const __m128i words = _mm_loadl_epi64((const __m128i *)numbers);
    return _mm_cvtepi32_ps(_mm_unpacklo_epi16(words, _mm_setzero_si128()));
}

static inline tl_vec3 tl_f32x3_get(tl_f32x3 a)
{
    return tl_vec3_make(_mm_cvtss_f32(a), _mm_cvtss_f32(_mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 1, 1, 1))),
                        _mm_cvtss_f32(_mm_movehl_ps(a, a)));
}

static inline tl_f32x3 tl_f32x3_add(tl_f32x3 a, tl_f32x3 b)
{
    return _mm_add_ps(a, b);
}

static inline tl_f32x3 tl_f32x3_sub(tl_f32x3 a, tl_f32x3 b)
{
    return _mm_sub_ps(a, b);
}

static inline tl_f32x3 tl_f32x3_mul(tl_f32x3 a, tl_f32x3 b)
{
    return _mm_mul_ps(a, b);
}

/// Lane i: a[i] > b[i] ? a[i] : b[i].
static inline tl_f32x3 tl_f32x3_max(tl_f32x3 a, tl_f32x3 b)
{
    return _mm_max_ps(a, b);
}

/// Whether a[i] <= b[i] and c[i] <= d[i] in each lane.
static inline bool tl_f32x3_are_ordered(tl_f32x3 a, tl_f32x3 b, tl_f32x3 c, tl_f32x3 d)
{
    return (~_mm_movemask_ps(_mm_and_ps(_mm_cmple_ps(a, b), _mm_cmple_ps(c, d))) & 7) == 0;
}

#elif TL_SIMD_LEVEL >= 1 && (defined(__aarch64__) || defined(__wasm_simd128__))

typedef tl_f32x4 tl_f32x3;

static inline tl_f32x3 tl_f32x3_of(tl_vec3 v)
{
    return tl_f32x4_make(v.x, v.y, v.z, 0.0f);
}

static inline tl_f32x3 tl_f32x3_from_u16(const void *numbers)
{
#if defined(__aarch64__)
    return vcvtq_f32_u32(vmovl_u16(vld1_u16(numbers)));
#else
    return wasm_f32x4_convert_i32x4(wasm_u32x4_load16x4(numbers));
#endif
}

static inline tl_vec3 tl_f32x3_get(tl_f32x3 a)
{
    return tl_vec3_make(tl_f32x4_get_x(a), tl_f32x4_get_y(a), tl_f32x4_get_z(a));
}

static inline tl_f32x3 tl_f32x3_add(tl_f32x3 a, tl_f32x3 b)
{
    return tl_f32x4_add(a, b);
}

static inline tl_f32x3 tl_f32x3_sub(tl_f32x3 a, tl_f32x3 b)
{
    return tl_f32x4_sub(a, b);
}

static inline tl_f32x3 tl_f32x3_mul(tl_f32x3 a, tl_f32x3 b)
{
    return tl_f32x4_mul(a, b);
}

static inline tl_f32x3 tl_f32x3_max(tl_f32x3 a, tl_f32x3 b)
{
    return tl_f32x4_max(a, b);
}

static inline bool tl_f32x3_are_ordered(tl_f32x3 a, tl_f32x3 b, tl_f32x3 c, tl_f32x3 d)
{
#if defined(__aarch64__)
    const uint32x4_t three = { UINT32_MAX, UINT32_MAX, UINT32_MAX, 0 };
    return vminvq_u32(vornq_u32(vandq_u32(vcleq_f32(a, b), vcleq_f32(c, d)), three)) != 0;
#else
    return (~wasm_i32x4_bitmask(wasm_v128_and(wasm_f32x4_le(a, b), wasm_f32x4_le(c, d))) & 7) == 0;
#endif
}

#else

typedef tl_vec3 tl_f32x3;

static inline tl_f32x3 tl_f32x3_of(tl_vec3 v)
{
    return v;
}

static inline tl_f32x3 tl_f32x3_from_u16(const void *numbers)
{
    uint16_t three[3];
    memcpy(three, numbers, sizeof three);
    return tl_vec3_make((float)three[0], (float)three[1], (float)three[2]);
}

static inline tl_vec3 tl_f32x3_get(tl_f32x3 a)
{
    return a;
}

static inline tl_f32x3 tl_f32x3_add(tl_f32x3 a, tl_f32x3 b)
{
    return tl_add(a, b);
}

static inline tl_f32x3 tl_f32x3_sub(tl_f32x3 a, tl_f32x3 b)
{
    return tl_sub(a, b);
}

static inline tl_f32x3 tl_f32x3_mul(tl_f32x3 a, tl_f32x3 b)
{
    return tl_vec3_make(a.x * b.x, a.y * b.y, a.z * b.z);
}

static inline tl_f32x3 tl_f32x3_max(tl_f32x3 a, tl_f32x3 b)
{
    return tl_vec3_make(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}

static inline bool tl_f32x3_are_ordered(tl_f32x3 a, tl_f32x3 b, tl_f32x3 c, tl_f32x3 d)
{
    return a.x <= b.x && a.y <= b.y && a.z <= b.z && c.x <= d.x && c.y <= d.y && c.z <= d.z;
}

#endif

#endif
