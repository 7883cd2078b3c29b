// SPDX-License-Identifier: MIT
//
// Points against faces, for registers of 128 bits (base/cpu.h).

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 1
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_FILE_POINTS tl_file_points_vec128
#include "hull/bake/file_points.inl"

#include "math/simd_target_end.h"
#endif
