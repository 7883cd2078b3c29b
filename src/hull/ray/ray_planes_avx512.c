// SPDX-License-Identifier: MIT
//
// A ray against a hull's planes, for AVX-512.

#if defined(__x86_64__) && defined(__GNUC__)
#define TL_SIMD_LEVEL 3
#include "math/simd_target.h"

#define TL_RAY_PLANES tl_ray_planes_avx512
#include "hull/ray/ray_planes.inl"

#include "math/simd_target_end.h"
#endif
