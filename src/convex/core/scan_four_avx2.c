// SPDX-License-Identifier: MIT
//
// The scans of farthest.h for AVX2.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#define TL_SCAN_FARTHEST tl_scan_farthest_avx2
#define TL_SCAN_REACH    tl_scan_reach_avx2
#define TL_SCAN_IMAGE_SQ tl_scan_image_sq_avx2
#define TL_SCAN_FACES    tl_scan_planes_avx2
#define TL_SCAN_PLACE    tl_scan_place_avx2
#define TL_SCAN_NEAREST  tl_scan_nearest_avx2
#include "convex/core/scan_four.inl"

#include "math/simd_target_end.h"
#endif
