// SPDX-License-Identifier: MIT
//
// Four floats in a register of AArch64's NEON.
//
// FMIN and FMAX order zeros and make NaN of NaN, so minima and maxima are a comparison and a selection, as in plain C.
// There is no instruction for a mask of sign bits: lanes are narrowed, reduced to a bit each, and added across.

#ifndef TALUS_SRC_MATH_SIMD_X4_NEON_H
#define TALUS_SRC_MATH_SIMD_X4_NEON_H

#include <arm_neon.h>
#include <stdint.h>
#include <string.h>

typedef float32x4_t tl_f32x4;

static inline tl_f32x4 tl_f32x4_all(float value)
{
    return vdupq_n_f32(value);
}

static inline tl_f32x4 tl_f32x4_make(float x, float y, float z, float w)
{
    const float four[4] = { x, y, z, w };
    return vld1q_f32(four);
}

static inline tl_f32x4 tl_f32x4_load(const float *four)
{
    return vld1q_f32(four);
}

/// Of three places; the fourth lane is 0.
static inline tl_f32x4 tl_f32x4_gather_three(const float *x, const float *y, const float *z)
{
    float32x4_t xy = vld1q_lane_f32(y, vld1q_lane_f32(x, vdupq_n_f32(0.0f), 0), 1);
    return vld1q_lane_f32(z, xy, 2);
}

// A load for each float, as with SSE.
static inline tl_f32x4 tl_f32x4_load_three(const float *three)
{
    return tl_f32x4_gather_three(three, three + 1, three + 2);
}

static inline tl_f32x4 tl_f32x4_gather_four(const float *x, const float *y, const float *z, const float *w)
{
    return vld1q_lane_f32(w, tl_f32x4_gather_three(x, y, z), 3);
}

static inline float tl_f32x4_get_x(tl_f32x4 a)
{
    return vgetq_lane_f32(a, 0);
}

static inline float tl_f32x4_get_y(tl_f32x4 a)
{
    return vgetq_lane_f32(a, 1);
}

static inline float tl_f32x4_get_z(tl_f32x4 a)
{
    return vgetq_lane_f32(a, 2);
}

static inline tl_f32x4 tl_f32x4_permute(tl_f32x4 a, const uint32_t *order)
{
    // Four bytes a lane.
    uint32x4_t bytes = vmlaq_n_u32(vdupq_n_u32(0x03020100), vld1q_u32(order), 0x04040404);
    return vreinterpretq_f32_u8(vqtbl1q_u8(vreinterpretq_u8_f32(a), vreinterpretq_u8_u32(bytes)));
}

static inline tl_f32x4 tl_f32x4_rotate_three(tl_f32x4 a)
{
    float32x4_t yzwx = vextq_f32(a, a, 1), yzxw = vrev64q_f32(yzwx);
    return vcombine_f32(vget_low_f32(yzwx), vget_high_f32(yzxw));
}

static inline tl_f32x4 tl_f32x4_add(tl_f32x4 a, tl_f32x4 b)
{
    return vaddq_f32(a, b);
}

static inline tl_f32x4 tl_f32x4_sub(tl_f32x4 a, tl_f32x4 b)
{
    return vsubq_f32(a, b);
}

static inline tl_f32x4 tl_f32x4_mul(tl_f32x4 a, tl_f32x4 b)
{
    return vmulq_f32(a, b);
}

static inline tl_f32x4 tl_f32x4_div(tl_f32x4 a, tl_f32x4 b)
{
    return vdivq_f32(a, b);
}

static inline tl_f32x4 tl_f32x4_min(tl_f32x4 a, tl_f32x4 b)
{
    return vbslq_f32(vcltq_f32(a, b), a, b);
}

static inline tl_f32x4 tl_f32x4_sqrt(tl_f32x4 a)
{
    return vsqrtq_f32(a);
}

static inline tl_f32x4 tl_f32x4_max(tl_f32x4 a, tl_f32x4 b)
{
    return vbslq_f32(vcgtq_f32(a, b), a, b);
}

static inline tl_f32x4 tl_f32x4_and(tl_f32x4 a, tl_f32x4 b)
{
    return vreinterpretq_f32_u32(vandq_u32(vreinterpretq_u32_f32(a), vreinterpretq_u32_f32(b)));
}

static inline tl_f32x4 tl_f32x4_or(tl_f32x4 a, tl_f32x4 b)
{
    return vreinterpretq_f32_u32(vorrq_u32(vreinterpretq_u32_f32(a), vreinterpretq_u32_f32(b)));
}

static inline tl_f32x4 tl_f32x4_neg(tl_f32x4 a)
{
    return vnegq_f32(a);
}

static inline tl_f32x4 tl_f32x4_mul_add(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return vfmaq_f32(c, a, b);
}

static inline tl_f32x4 tl_f32x4_mul_sub_from(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return vfmsq_f32(c, a, b);
}

static inline tl_f32x4 tl_f32x4_choose(tl_f32x4 signs, tl_f32x4 a, tl_f32x4 b)
{
    return vbslq_f32(vcltzq_s32(vreinterpretq_s32_f32(signs)), b, a);
}

static inline tl_f32x4 tl_f32x4_abs(tl_f32x4 a)
{
    return vabsq_f32(a);
}

static inline tl_f32x4 tl_f32x4_if_less(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    return vbslq_f32(vcltq_f32(a, b), c, d);
}

// Lanes are all ones or zero.
static inline uint32_t tl_f32x4_mask(uint32x4_t lanes)
{
    static const uint32_t bits[4] = { 1, 2, 4, 8 };
    return vaddvq_u32(vandq_u32(lanes, vld1q_u32(bits)));
}

static inline uint32_t tl_f32x4_less_equal(tl_f32x4 a, tl_f32x4 b)
{
    return tl_f32x4_mask(vcleq_f32(a, b));
}

static inline uint32_t tl_f32x4_ascending(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c)
{
    return tl_f32x4_mask(vandq_u32(vcleq_f32(a, b), vcleq_f32(b, c)));
}

static inline uint32_t tl_f32x4_signs(tl_f32x4 a)
{
    return tl_f32x4_mask(vcltzq_s32(vreinterpretq_s32_f32(a)));
}

static inline void tl_f32x4_store(float *four, tl_f32x4 a)
{
    vst1q_f32(four, a);
}

static inline void tl_f32x4_store_whole(int32_t *four, tl_f32x4 a)
{
    vst1q_s32(four, vcvtq_s32_f32(a));
}

static inline tl_f32x4 tl_f32x4_max_of_three(tl_f32x4 a)
{
    float32x4_t m = tl_f32x4_max(tl_f32x4_max(a, vdupq_laneq_f32(a, 1)), vdupq_laneq_f32(a, 2));
    return vdupq_laneq_f32(m, 0);
}

static inline float tl_f32x4_least_of_three(tl_f32x4 a)
{
    return vgetq_lane_f32(tl_f32x4_min(tl_f32x4_min(a, vdupq_laneq_f32(a, 1)), vdupq_laneq_f32(a, 2)), 0);
}

// ------------------------------------------------------------------------------- for vectors of two (simd_x8_pair.h)

static inline void tl_f32x4_two_from_bytes(const uint8_t *eight, tl_f32x4 *low, tl_f32x4 *high)
{
    uint16x8_t words = vmovl_u8(vld1_u8(eight));
    *low = vcvtq_f32_u32(vmovl_u16(vget_low_u16(words)));
    *high = vcvtq_f32_u32(vmovl_high_u16(words));
}

static inline tl_f32x4 tl_f32x4_zip_low(tl_f32x4 a, tl_f32x4 b)
{
    return vzip1q_f32(a, b);
}

static inline tl_f32x4 tl_f32x4_zip_high(tl_f32x4 a, tl_f32x4 b)
{
    return vzip2q_f32(a, b);
}

static inline tl_f32x4 tl_f32x4_twice_z_and_low(tl_f32x4 a, tl_f32x4 b)
{
    return vcombine_f32(vdup_laneq_f32(a, 2), vget_low_f32(b));
}

static inline tl_f32x4 tl_f32x4_twice_z_and_high(tl_f32x4 a, tl_f32x4 b)
{
    return vcombine_f32(vdup_laneq_f32(a, 2), vget_high_f32(b));
}

static inline void tl_f32x4_transpose(tl_f32x4 *a, tl_f32x4 *b, tl_f32x4 *c, tl_f32x4 *d)
{
    float64x2_t ab_low = vreinterpretq_f64_f32(vzip1q_f32(*a, *b)), ab_high = vreinterpretq_f64_f32(vzip2q_f32(*a, *b));
    float64x2_t cd_low = vreinterpretq_f64_f32(vzip1q_f32(*c, *d)), cd_high = vreinterpretq_f64_f32(vzip2q_f32(*c, *d));
    *a = vreinterpretq_f32_f64(vzip1q_f64(ab_low, cd_low));
    *b = vreinterpretq_f32_f64(vzip2q_f64(ab_low, cd_low));
    *c = vreinterpretq_f32_f64(vzip1q_f64(ab_high, cd_high));
    *d = vreinterpretq_f32_f64(vzip2q_f64(ab_high, cd_high));
}

static inline tl_f32x4 tl_f32x4_largest(tl_f32x4 a)
{
    return vdupq_n_f32(vmaxvq_f32(a));
}

static inline tl_f32x4 tl_f32x4_min_bits(tl_f32x4 a, tl_f32x4 b)
{
    return vreinterpretq_f32_s32(vminq_s32(vreinterpretq_s32_f32(a), vreinterpretq_s32_f32(b)));
}

static inline tl_f32x4 tl_f32x4_max_bits(tl_f32x4 a, tl_f32x4 b)
{
    return vreinterpretq_f32_s32(vmaxq_s32(vreinterpretq_s32_f32(a), vreinterpretq_s32_f32(b)));
}

static inline tl_f32x4 tl_f32x4_where_less_bits(tl_f32x4 a, tl_f32x4 b)
{
    return vreinterpretq_f32_u32(vcltq_s32(vreinterpretq_s32_f32(a), vreinterpretq_s32_f32(b)));
}

static inline tl_f32x4 tl_f32x4_where_less(tl_f32x4 a, tl_f32x4 b)
{
    return vreinterpretq_f32_u32(vcltq_f32(a, b));
}

// The upper half of each lane has its sign.
static inline uint16x8_t tl_f32x4_upper_halves(tl_f32x4 low, tl_f32x4 high)
{
    return vuzp2q_u16(vreinterpretq_u16_f32(low), vreinterpretq_u16_f32(high));
}

// These lanes are all ones or zero.
static inline uint32_t tl_f32x4_two_masks(tl_f32x4 low, tl_f32x4 high)
{
    static const uint16_t bits[8] = { 1, 2, 4, 8, 16, 32, 64, 128 };
    return vaddvq_u16(vandq_u16(tl_f32x4_upper_halves(low, high), vld1q_u16(bits)));
}

static inline uint32_t tl_f32x4_two_signs(tl_f32x4 low, tl_f32x4 high)
{
    static const int16_t places[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    return vaddvq_u16(vshlq_u16(vshrq_n_u16(tl_f32x4_upper_halves(low, high), 15), vld1q_s16(places)));
}

static inline uint32_t tl_f32x4_two_not_less(tl_f32x4 a_low, tl_f32x4 b_low, tl_f32x4 a_high, tl_f32x4 b_high)
{
    return tl_f32x4_two_masks(tl_f32x4_where_less(a_low, b_low), tl_f32x4_where_less(a_high, b_high)) ^ 0xffu;
}

static inline uint32_t tl_f32x4_four_masks(tl_f32x4 a, tl_f32x4 b, tl_f32x4 c, tl_f32x4 d)
{
    // The bits of the first two in the low bytes, those of the others in the high ones.
    static const uint16_t bits[8] = { 0x0101, 0x0202, 0x0404, 0x0808, 0x1010, 0x2020, 0x4040, 0x8080 };
    uint16x8_t bytes = vsliq_n_u16(tl_f32x4_upper_halves(a, b), tl_f32x4_upper_halves(c, d), 8);
    return vaddvq_u16(vandq_u16(bytes, vld1q_u16(bits)));
}

#endif
