// SPDX-License-Identifier: MIT
//
// The questions about triangles for what every processor of the target has.

#define TL_BLOCK_QUESTIONS tl_block_questions_scalar
#include "nav_bake/voxels/triangle_block.inl"
#undef TL_BLOCK_QUESTIONS
