// SPDX-License-Identifier: MIT
//
// Four floats in a v128 of WebAssembly.
//
// f32x4.pmin(a, b) is b < a ? b : a, and pmax(a, b) is a < b ? b : a: with the operands swapped they are the plain C
// forms to the bit, and one instruction of x86 each. f32x4.min and max order zeros and make quiet NaN, so they are not
// used; nor is relaxed SIMD, whose results depend on the machine.

#ifndef TALUS_SRC_MATH_SIMD_X4_WASM_H
#define TALUS_SRC_MATH_SIMD_X4_WASM_H

#include <stdint.h>
#include <string.h>
#include <wasm_simd128.h>

typedef v128_t tl_f32x4;

static inline tl_f32x4 tl_f32x4_all(float value)
{
    return wasm_f32x4_splat(value);
}

static inline tl_f32x4 tl_f32x4_make(float x, float y, float z, float w)
{
    return wasm_f32x4_make(x, y, z, w);
}

static inline tl_f32x4 tl_f32x4_load(const float *four)
{
    return wasm_v128_load(four);
}

/// Of three places; the fourth lane is 0.
static inline tl_f32x4 tl_f32x4_gather_three(const float *x, const float *y, const float *z)
{
    v128_t xy = wasm_v128_load32_lane(y, wasm_v128_load32_zero(x), 1);
    return wasm_v128_load32_lane(z, xy, 2);
}

// A load for each float, as with SSE.
static inline tl_f32x4 tl_f32x4_load_three(const float *three)
{
    return tl_f32x4_gather_three(three, three + 1, three + 2);
}

static inline tl_f32x4 tl_f32x4_gather_four(const float *x, const float *y, const float *z, const float *w)
{
    return wasm_v128_load32_lane(w, tl_f32x4_gather_three(x, y, z), 3);
}

static inline float tl_f32x4_get_x(tl_f32x4 a)
{
    return wasm_f32x4_extract_lane(a, 0);
}

static inline float tl_f32x4_get_y(tl_f32x4 a)
{
    return wasm_f32x4_extract_lane(a, 1);
}

static inline float tl_f32x4_get_z(tl_f32x4 a)
{
    return wasm_f32x4_extract_lane(a, 2);
}

static inline tl_f32x4 tl_f32x4_permute(tl_f32x4 a, const uint32_t *order)
{
    // Four bytes a lane.
    v128_t first = wasm_i32x4_mul(wasm_v128_load(order), wasm_i32x4_splat(0x04040404));
    return wasm_i8x16_swizzle(a, wasm_i32x4_add(first, wasm_i32x4_splat(0x03020100)));
}

static inline tl_f32x4 tl_f32x4_rotate_three(tl_f32x4 a)
{
    return wasm_i32x4_shuffle(a, a, 1, 2, 0, 3);
}

static inline tl_f32x4 tl_f32x4_add(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_f32x4_add(a, b);
}

static inline tl_f32x4 tl_f32x4_sub(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_f32x4_sub(a, b);
}

static inline tl_f32x4 tl_f32x4_mul(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_f32x4_mul(a, b);
}

static inline tl_f32x4 tl_f32x4_div(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_f32x4_div(a, b);
}

static inline tl_f32x4 tl_f32x4_min(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_f32x4_pmin(b, a);
}

static inline tl_f32x4 tl_f32x4_sqrt(tl_f32x4 a)
{
    return wasm_f32x4_sqrt(a);
}

static inline tl_f32x4 tl_f32x4_max(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_f32x4_pmax(b, a);
}

static inline tl_f32x4 tl_f32x4_and(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_v128_and(a, b);
}

static inline tl_f32x4 tl_f32x4_or(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_v128_or(a, b);
}

static inline tl_f32x4 tl_f32x4_neg(tl_f32x4 a)
{
    return wasm_f32x4_neg(a);
}

static inline tl_f32x4 tl_f32x4_mul_add(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return wasm_f32x4_add(wasm_f32x4_mul(a, b), c);
}

static inline tl_f32x4 tl_f32x4_mul_sub_from(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return wasm_f32x4_sub(c, wasm_f32x4_mul(a, b));
}

static inline tl_f32x4 tl_f32x4_choose(tl_f32x4 signs, tl_f32x4 a, tl_f32x4 b)
{
    return wasm_v128_bitselect(b, a, wasm_i32x4_shr(signs, 31));
}

static inline tl_f32x4 tl_f32x4_abs(tl_f32x4 a)
{
    return wasm_f32x4_abs(a);
}

static inline tl_f32x4 tl_f32x4_if_less(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    return wasm_v128_bitselect(c, d, wasm_f32x4_lt(a, b));
}

static inline uint32_t tl_f32x4_less_equal(tl_f32x4 a, tl_f32x4 b)
{
    return (uint32_t)wasm_i32x4_bitmask(wasm_f32x4_le(a, b));
}

static inline uint32_t tl_f32x4_ascending(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return (uint32_t)wasm_i32x4_bitmask(wasm_v128_and(wasm_f32x4_le(a, b), wasm_f32x4_le(b, c)));
}

static inline uint32_t tl_f32x4_signs(tl_f32x4 a)
{
    return (uint32_t)wasm_i32x4_bitmask(a);
}

static inline void tl_f32x4_store(float *four, tl_f32x4 a)
{
    wasm_v128_store(four, a);
}

static inline void tl_f32x4_store_whole(int32_t *four, tl_f32x4 a)
{
    wasm_v128_store(four, wasm_i32x4_trunc_sat_f32x4(a));
}

static inline tl_f32x4 tl_f32x4_max_of_three(tl_f32x4 a)
{
    v128_t y = wasm_i32x4_shuffle(a, a, 1, 1, 1, 1), z = wasm_i32x4_shuffle(a, a, 2, 2, 2, 2);
    v128_t m = tl_f32x4_max(tl_f32x4_max(a, y), z);
    return wasm_i32x4_shuffle(m, m, 0, 0, 0, 0);
}

static inline float tl_f32x4_least_of_three(tl_f32x4 a)
{
    v128_t y = wasm_i32x4_shuffle(a, a, 1, 1, 1, 1), z = wasm_i32x4_shuffle(a, a, 2, 2, 2, 2);
    return wasm_f32x4_extract_lane(tl_f32x4_min(tl_f32x4_min(a, y), z), 0);
}

// ------------------------------------------------------------------------------- for vectors of two (simd_x8_pair.h)

static inline void tl_f32x4_two_from_bytes(const uint8_t *eight, tl_f32x4 *low, tl_f32x4 *high)
{
    v128_t words = wasm_u16x8_load8x8(eight);
    *low = wasm_f32x4_convert_i32x4(wasm_u32x4_extend_low_u16x8(words));
    *high = wasm_f32x4_convert_i32x4(wasm_u32x4_extend_high_u16x8(words));
}

static inline tl_f32x4 tl_f32x4_zip_low(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_i32x4_shuffle(a, b, 0, 4, 1, 5);
}

static inline tl_f32x4 tl_f32x4_zip_high(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_i32x4_shuffle(a, b, 2, 6, 3, 7);
}

static inline tl_f32x4 tl_f32x4_twice_z_and_low(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_i32x4_shuffle(a, b, 2, 2, 4, 5);
}

static inline tl_f32x4 tl_f32x4_twice_z_and_high(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_i32x4_shuffle(a, b, 2, 2, 6, 7);
}

static inline void tl_f32x4_transpose(tl_f32x4 *a, tl_f32x4 *b, tl_f32x4 *c, tl_f32x4 *d)
{
    v128_t ab_low = wasm_i32x4_shuffle(*a, *b, 0, 4, 1, 5), ab_high = wasm_i32x4_shuffle(*a, *b, 2, 6, 3, 7);
    v128_t cd_low = wasm_i32x4_shuffle(*c, *d, 0, 4, 1, 5), cd_high = wasm_i32x4_shuffle(*c, *d, 2, 6, 3, 7);
    *a = wasm_i64x2_shuffle(ab_low, cd_low, 0, 2);
    *b = wasm_i64x2_shuffle(ab_low, cd_low, 1, 3);
    *c = wasm_i64x2_shuffle(ab_high, cd_high, 0, 2);
    *d = wasm_i64x2_shuffle(ab_high, cd_high, 1, 3);
}

static inline tl_f32x4 tl_f32x4_largest(tl_f32x4 a)
{
    v128_t m = tl_f32x4_max(a, wasm_i32x4_shuffle(a, a, 2, 3, 0, 1));
    return tl_f32x4_max(m, wasm_i32x4_shuffle(m, m, 1, 0, 3, 2));
}

static inline tl_f32x4 tl_f32x4_min_bits(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_i32x4_min(a, b);
}

static inline tl_f32x4 tl_f32x4_max_bits(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_i32x4_max(a, b);
}

static inline tl_f32x4 tl_f32x4_where_less_bits(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_i32x4_lt(a, b);
}

static inline tl_f32x4 tl_f32x4_where_less(tl_f32x4 a, tl_f32x4 b)
{
    return wasm_f32x4_lt(a, b);
}

// Narrowing keeps signs: two instructions instead of two bit masks, a shift and an or.
static inline uint32_t tl_f32x4_two_signs(tl_f32x4 low, tl_f32x4 high)
{
    return (uint32_t)wasm_i16x8_bitmask(wasm_i16x8_narrow_i32x4(low, high));
}

// These lanes are all ones or zero.
static inline uint32_t tl_f32x4_two_masks(tl_f32x4 low, tl_f32x4 high)
{
    return tl_f32x4_two_signs(low, high);
}

static inline uint32_t tl_f32x4_two_not_less(tl_f32x4 a_low, tl_f32x4 b_low, tl_f32x4 a_high, tl_f32x4 b_high)
{
    return tl_f32x4_two_masks(tl_f32x4_where_less(a_low, b_low), tl_f32x4_where_less(a_high, b_high)) ^ 0xffu;
}

static inline uint32_t tl_f32x4_four_masks(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    return (uint32_t)wasm_i8x16_bitmask(
        wasm_i8x16_narrow_i16x8(wasm_i16x8_narrow_i32x4(a, b), wasm_i16x8_narrow_i32x4(c, d)));
}

#endif
