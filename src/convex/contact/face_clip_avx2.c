// SPDX-License-Identifier: MIT
//
// The intersection of two faces (face_clip.c) for AVX2.

#include "base/cpu.h"

#if TL_CPU_LEVELS >= 2
#define TL_SIMD_LEVEL 2
#include "math/simd_target.h"

#include "convex/contact/face_patch.h"

#define TL_FACE_CLIP tl_face_clip_avx2
#include "convex/contact/face_clip.inl"

#include "math/simd_target_end.h"
#endif
