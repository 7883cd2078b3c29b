// SPDX-License-Identifier: MIT
//
// The walk for SSE4.2: lanes by four.

#if defined(__x86_64__)
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_RAY_WALK      tl_ray_walk_sse42
#define TL_RAY_WALK_MANY tl_ray_walk_many_sse42
#include "soup/ray/ray_walk.inl"
#include "soup/ray/ray_walk_interleaved.inl"

#include "math/simd_target_end.h"
#endif
