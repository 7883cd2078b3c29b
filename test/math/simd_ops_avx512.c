// SPDX-License-Identifier: MIT
//
// The vocabulary at level 3 (base/cpu.h).

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 3
#define TL_SIMD_LEVEL 3
#include "math/simd_target.h"

#define SIMD_OPS simd_ops_avx512
#include "simd_ops.inl"

#include "math/simd_target_end.h"
#endif
