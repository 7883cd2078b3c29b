// SPDX-License-Identifier: MIT
//
// The questions about triangles for AVX2: four doubles at a time.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#define TL_BLOCK_QUESTIONS tl_block_questions_avx2
#include "nav_bake/voxels/triangle_block.inl"
#undef TL_BLOCK_QUESTIONS

#include "math/simd_target_end.h"
#endif
