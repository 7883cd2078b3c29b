// SPDX-License-Identifier: MIT
//
// The walk for AVX2 with FMA: eight boxes in one register.

#if defined(__x86_64__)
#define TL_SCENE_WALK tl_scene_walk_avx2
#include "scene/scene_walk.inl"
#endif
