// SPDX-License-Identifier: MIT
//
// The vocabulary at level 2 (base/cpu.h).

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#define SIMD_OPS simd_ops_avx2
#include "simd_ops.inl"

#include "math/simd_target_end.h"
#endif
