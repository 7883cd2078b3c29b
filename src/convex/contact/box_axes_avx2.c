// SPDX-License-Identifier: MIT
//
// The axes of two boxes (box_depth.c) for AVX2.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#include "convex/contact/box_axes.h"

#define TL_FIND_BOX_AXES tl_box_axes_avx2
#include "convex/contact/box_axes.inl"

#include "math/simd_target_end.h"
#endif
