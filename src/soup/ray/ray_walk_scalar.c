// SPDX-License-Identifier: MIT
//
// The walk in plain C: the twin that the others are compared with, and the one for machines without them.

#define TL_SIMD_LEVEL    0
#define TL_RAY_WALK      tl_ray_walk_scalar
#define TL_RAY_WALK_MANY tl_ray_walk_many_scalar
#define TL_RAY_PACKETS   tl_ray_packets_scalar
#include "soup/ray/ray_walk.inl"
#include "soup/ray/ray_walk_interleaved.inl"
#include "soup/ray/ray_walk_packet.inl"
