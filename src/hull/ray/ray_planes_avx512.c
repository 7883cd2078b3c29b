// SPDX-License-Identifier: MIT
//
// A ray against a hull's planes, for AVX-512.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 3
#define TL_SIMD_LEVEL 3
#include "math/simd_target.h"

#define TL_RAY_PLANES tl_ray_planes_avx512
#include "hull/ray/ray_planes.inl"

#include "math/simd_target_end.h"
#endif
