// SPDX-License-Identifier: MIT
//
// Points against faces, for AVX2.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#define TL_FILE_POINTS tl_file_points_avx2
#include "hull/bake/file_points.inl"

#include "math/simd_target_end.h"
#endif
