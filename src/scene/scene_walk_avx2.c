// SPDX-License-Identifier: MIT
//
// The walk for AVX2 with FMA: sixteen boxes in two registers.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#define TL_SCENE_WALK tl_scene_walk_avx2
#include "scene/scene_walk.inl"

#include "math/simd_target_end.h"
#endif
