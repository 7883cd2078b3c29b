// SPDX-License-Identifier: MIT
//
// The vocabulary at level 1 (base/cpu.h).

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 1
#define TL_SIMD_LEVEL 1
#include "math/simd_target.h"

#define SIMD_OPS simd_ops_vec128
#include "simd_ops.inl"

#include "math/simd_target_end.h"
#endif
