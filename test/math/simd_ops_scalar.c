// SPDX-License-Identifier: MIT
//
// The vocabulary in plain C: what every other level is compared with.

#define TL_SIMD_LEVEL 0
#define SIMD_OPS      simd_ops_scalar
#include "simd_ops.inl"
