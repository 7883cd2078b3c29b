// SPDX-License-Identifier: MIT
//
// A small vocabulary of vectors. A kernel is written once over it and compiled once per instruction set; simd_target.h
// chooses the branch below. Names say element and lanes: tl_f32x4 is four floats.
//
// The plain C branch (simd_x4_plain.h) says what each operation means; the others give its bits, NaN and -0 included
// (test_simd). Two things are left open. `tl_*_mul_add` and `tl_*_mul_sub_from` are fused where the instruction set has
// it and rounded twice where it has not, so they are only for values whose error bound covers both. And which NaN
// arithmetic makes of NaN differs from machine to machine, in plain C too; that it is one does not.
//
// A file that chooses nothing gets what every processor of its target has: NEON on AArch64 and simd128 in WebAssembly,
// and plain C on x86, where SSE4.2 has to be asked for.

#ifndef TALUS_SRC_MATH_SIMD_H
#define TALUS_SRC_MATH_SIMD_H

#include "base/compiler.h"
#include "base/cpu.h"
#include "base/exact_floats.h"

#include <stdint.h>
#include <string.h>

#ifndef TL_SIMD_LEVEL
#define TL_SIMD_LEVEL TL_CPU_BASE_LEVEL
#endif

#if TL_SIMD_LEVEL == 0
#include "math/simd_x4_plain.h"
#elif defined(__aarch64__)
#include "math/simd_x4_neon.h"
#elif defined(__wasm_simd128__)
#include "math/simd_x4_wasm.h"
#else
#include "math/simd_x4_sse.h"
#endif

#endif
