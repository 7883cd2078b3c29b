// SPDX-License-Identifier: MIT
//
// The walk in plain C: the twin that the others are compared with, and the one for machines without them.

#define TL_SIMD_SCALAR
#define TL_RAY_WALK tl_ray_walk_scalar
#include "soup/ray_walk.h"
