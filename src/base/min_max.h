// SPDX-License-Identifier: MIT
//
// The smaller, the larger, and between two bounds.
//
// Of floats that compare equal (-0 and 0) the first is taken, and a NaN in either place gives the first: the results
// are the same with every compiler. Comparisons are written so that they become one minimum or maximum instruction.

#ifndef TALUS_SRC_BASE_MIN_MAX_H
#define TALUS_SRC_BASE_MIN_MAX_H

#include "base/exact_floats.h"

#include <stddef.h>
#include <stdint.h>

#define TL_MIN_MAX_CLAMP_(suffix, type)                                                                                \
    static inline type tl_min_##suffix(type a, type b)                                                                 \
    {                                                                                                                  \
        return b < a ? b : a;                                                                                          \
    }                                                                                                                  \
    static inline type tl_max_##suffix(type a, type b)                                                                 \
    {                                                                                                                  \
        return b > a ? b : a;                                                                                          \
    }                                                                                                                  \
    /* `low` <= `high`; a NaN stays one. */                                                                            \
    static inline type tl_clamp_##suffix(type value, type low, type high)                                              \
    {                                                                                                                  \
        return value < low ? low : value > high ? high : value;                                                        \
    }

TL_MIN_MAX_CLAMP_(i32, int32_t)
TL_MIN_MAX_CLAMP_(u32, uint32_t)
TL_MIN_MAX_CLAMP_(i64, int64_t)
TL_MIN_MAX_CLAMP_(u64, uint64_t)
TL_MIN_MAX_CLAMP_(f32, float)
TL_MIN_MAX_CLAMP_(f64, double)

#undef TL_MIN_MAX_CLAMP_

#endif
