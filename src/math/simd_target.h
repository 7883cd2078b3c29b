// SPDX-License-Identifier: MIT
//
// Begins the part of a kernel's file that is compiled for a level (base/cpu.h): the file's own first lines say for
// which, so that it compiles by hand and in any build system without flags of its own. simd_target_end.h ends it.
//
//   #include "base/cpu.h"
//
//   #if TL_CPU_LEVELS >= 2
//   #define TL_SIMD_LEVEL 2
//   #include "math/simd_target.h"
//   #include "soup/ray/ray_walk.inl"
//   #include "math/simd_target_end.h"
//   #endif
//
// Only x86-64 has levels beyond what its compilers assume. They want the words in pragmas of their own, and GCC its one
// before the intrinsics' header.
#if TL_CPU_LEVELS > TL_CPU_BASE_LEVEL
#if defined(__clang__)
#if TL_SIMD_LEVEL == 1
#pragma clang attribute push(__attribute__((target("sse4.2"))), apply_to = function)
#elif TL_SIMD_LEVEL == 2
#pragma clang attribute push(__attribute__((target("avx2,fma,bmi"))), apply_to = function)
#elif TL_SIMD_LEVEL == 3 && __clang_major__ == 18 // alone it wants to be told that registers are of 512 bits
#pragma clang attribute push(                                                                                          \
    __attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,evex512,avx2,fma,bmi,popcnt"))), apply_to = function)
#elif TL_SIMD_LEVEL == 3
#pragma clang attribute push(__attribute__((target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi,popcnt"))),        \
                             apply_to = function)
#endif
#else
#pragma GCC push_options
#if TL_SIMD_LEVEL == 1
#pragma GCC target("sse4.2")
#elif TL_SIMD_LEVEL == 2
#pragma GCC target("avx2,fma,bmi")
#elif TL_SIMD_LEVEL == 3
#pragma GCC target("avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi,prefer-vector-width=512")
#endif
#endif
#endif
