// SPDX-License-Identifier: MIT
//
// The walk in plain C: the twin that the others are compared with, and the one for machines without them.

#define TL_SIMD_LEVEL 0
#define TL_SCENE_WALK tl_scene_walk_scalar
#include "scene/scene_walk.inl"
