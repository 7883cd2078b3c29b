// SPDX-License-Identifier: MIT
//
// A ray against a hull's planes, for registers of 128 bits (base/cpu.h).

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 1
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_RAY_PLANES tl_ray_planes_vec128
#include "hull/ray/ray_planes.inl"

#include "math/simd_target_end.h"
#endif
