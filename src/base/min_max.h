// SPDX-License-Identifier: MIT
//
// The smaller, the larger, and between two bounds.
//
// Of floats that compare equal (-0 and 0) the first is taken, and a NaN in either place gives the first: the results
// are the same with every compiler. Comparisons are written so that they become one minimum or maximum instruction.
//
// WebAssembly's own minimum of two floats is another one, and engines make a branch of a choice between floats, as
// often guessed wrong as not. Its pseudo-minimum of vectors is the one that is wanted, without a branch.

#ifndef TALUS_SRC_BASE_MIN_MAX_H
#define TALUS_SRC_BASE_MIN_MAX_H

#include "base/exact_floats.h"

#include <stddef.h>
#include <stdint.h>

#if defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

#define TL_MIN_MAX_(suffix, type)                                                                                      \
    static inline type tl_min_##suffix(type a, type b)                                                                 \
    {                                                                                                                  \
        return b < a ? b : a;                                                                                          \
    }                                                                                                                  \
    static inline type tl_max_##suffix(type a, type b)                                                                 \
    {                                                                                                                  \
        return b > a ? b : a;                                                                                          \
    }

TL_MIN_MAX_(i32, int32_t)
TL_MIN_MAX_(u32, uint32_t)
TL_MIN_MAX_(i64, int64_t)
TL_MIN_MAX_(u64, uint64_t)
TL_MIN_MAX_(f32, float)
#if defined(__wasm_simd128__)
static inline double tl_min_f64(double a, double b)
{
    return wasm_f64x2_extract_lane(wasm_f64x2_pmin(wasm_f64x2_splat(a), wasm_f64x2_splat(b)), 0);
}
static inline double tl_max_f64(double a, double b)
{
    return wasm_f64x2_extract_lane(wasm_f64x2_pmax(wasm_f64x2_splat(a), wasm_f64x2_splat(b)), 0);
}
#else
TL_MIN_MAX_(f64, double)
#endif

#undef TL_MIN_MAX_

#define TL_CLAMP_(suffix, type)                                                                                        \
    /* `low` <= `high`; a NaN stays one. */                                                                            \
    static inline type tl_clamp_##suffix(type value, type low, type high)                                              \
    {                                                                                                                  \
        return value < low ? low : value > high ? high : value;                                                        \
    }

TL_CLAMP_(i32, int32_t)
TL_CLAMP_(u32, uint32_t)
TL_CLAMP_(i64, int64_t)
TL_CLAMP_(u64, uint64_t)
TL_CLAMP_(f32, float)
TL_CLAMP_(f64, double)

#undef TL_CLAMP_

#endif
