// SPDX-License-Identifier: MIT
//
// The support query for registers of 128 bits (base/cpu.h): eight lanes in two of them.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 1
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_SUPPORT_QUERY tl_hull_support_vec128
#define TL_SUPPORT_CLIMB tl_hull_climb_vec128
#define TL_SUPPORT_MARCH tl_hull_march_vec128
#include "hull/support/support_query.inl"

#include "math/simd_target_end.h"
#endif
