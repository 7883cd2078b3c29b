// SPDX-License-Identifier: MIT
//
// The support query for AVX2: a block of neighbours in one register a coordinate.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#define TL_SUPPORT_QUERY tl_hull_support_avx2
#define TL_SUPPORT_CLIMB tl_hull_climb_avx2
#define TL_SUPPORT_MARCH tl_hull_march_avx2
#include "hull/support/support_query.inl"

#include "math/simd_target_end.h"
#endif
