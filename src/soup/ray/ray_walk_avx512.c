// SPDX-License-Identifier: MIT
//
// The walk for AVX-512 (F, VL, BW, DQ): a node's sixteen boxes in one register.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 3
#define TL_SIMD_LEVEL 3
#include "math/simd_target.h"

#define TL_RAY_WALK      tl_ray_walk_avx512
#define TL_RAY_WALK_MANY tl_ray_walk_many_avx512
#define TL_RAY_PACKETS   tl_ray_packets_avx512
#include "soup/ray/ray_walk.inl"
#include "soup/ray/ray_walk_interleaved.inl"
#include "soup/ray/ray_walk_packet.inl"

#include "math/simd_target_end.h"
#endif
