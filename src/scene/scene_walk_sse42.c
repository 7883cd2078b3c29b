// SPDX-License-Identifier: MIT
//
// The walk for SSE4.2: boxes by four.

#if defined(__x86_64__)
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_SCENE_WALK tl_scene_walk_sse42
#include "scene/scene_walk.inl"

#include "math/simd_target_end.h"
#endif
