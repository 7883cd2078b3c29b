// SPDX-License-Identifier: MIT
//
// The support query for SSE4.2: eight lanes in two registers.

#if defined(__x86_64__)
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_SUPPORT_QUERY tl_hull_support_sse42
#define TL_SUPPORT_CLIMB tl_hull_climb_sse42
#define TL_SUPPORT_MARCH tl_hull_march_sse42
#include "hull/support/support_query.inl"

#include "math/simd_target_end.h"
#endif
