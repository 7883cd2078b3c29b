// SPDX-License-Identifier: MIT
//
// A ray against a hull's planes, for AVX2.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#define TL_RAY_PLANES tl_ray_planes_avx2
#include "hull/ray/ray_planes.inl"

#include "math/simd_target_end.h"
#endif
