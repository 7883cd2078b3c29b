// SPDX-License-Identifier: MIT
//
// The vocabulary of simd.h, eight floats wide: one register with AVX2, two of four elsewhere.

#ifndef TALUS_SRC_MATH_SIMD8_H
#define TALUS_SRC_MATH_SIMD8_H

#include "math/simd.h"

#if TL_SIMD_LEVEL >= 2
#include "math/simd_x8_avx2.h"
#elif TL_SIMD_LEVEL == 1
#include "math/simd_x8_pair.h"
#else
#include "math/simd_x8_plain.h"
#endif

#endif
