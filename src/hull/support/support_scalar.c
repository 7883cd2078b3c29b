// SPDX-License-Identifier: MIT
//
// The support query in plain C: for any processor, and the twin that the others are compared with.

#define TL_SIMD_LEVEL    0
#define TL_SUPPORT_QUERY tl_hull_support_scalar
#define TL_SUPPORT_CLIMB tl_hull_climb_scalar
#define TL_SUPPORT_MARCH tl_hull_march_scalar
#include "hull/support/support_query.inl"
