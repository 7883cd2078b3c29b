// SPDX-License-Identifier: MIT
//
// The walk for AVX2 with FMA: a leaf's eight lanes in one register.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#define TL_RAY_WALK      tl_ray_walk_avx2
#define TL_RAY_WALK_MANY tl_ray_walk_many_avx2
#define TL_RAY_PACKETS   tl_ray_packets_avx2
#include "soup/ray/ray_walk.inl"
#include "soup/ray/ray_walk_interleaved.inl"
#include "soup/ray/ray_walk_packet.inl"

#include "math/simd_target_end.h"
#endif
