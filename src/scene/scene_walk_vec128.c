// SPDX-License-Identifier: MIT
//
// The walk for registers of 128 bits (base/cpu.h): boxes by four.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 1
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_SCENE_WALK tl_scene_walk_vec128
#include "scene/scene_walk.inl"

#include "math/simd_target_end.h"
#endif
