// SPDX-License-Identifier: MIT
//
// The walk for registers of 128 bits (base/cpu.h): lanes by four.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 1
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_RAY_WALK      tl_ray_walk_vec128
#define TL_RAY_WALK_MANY tl_ray_walk_many_vec128
#define TL_RAY_PACKETS   tl_ray_packets_vec128
#include "soup/ray/ray_walk.inl"
#include "soup/ray/ray_walk_interleaved.inl"
#include "soup/ray/ray_walk_packet.inl"

#include "math/simd_target_end.h"
#endif
