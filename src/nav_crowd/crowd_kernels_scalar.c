// SPDX-License-Identifier: MIT
//
// The crowd's kernels in plain C: the twin that the others are compared with, and those for machines without them.

#include "nav_crowd/crowd_kernels.h"

#define TL_SIMD_LEVEL    0
#define TL_CROWD_KERNELS tl_crowd_kernels_scalar
#include "nav_crowd/crowd_kernels.inl"
