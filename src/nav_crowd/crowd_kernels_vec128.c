// SPDX-License-Identifier: MIT
//
// The crowd's kernels for registers of 128 bits (base/cpu.h).

#include "nav_crowd/crowd_kernels.h"

#if TL_CPU_LEVELS >= 1
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define TL_CROWD_KERNELS tl_crowd_kernels_vec128
#include "nav_crowd/crowd_kernels.inl"

#include "math/simd_target_end.h"
#endif
