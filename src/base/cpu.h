// SPDX-License-Identifier: MIT
//
// What the processor can do, by the levels that kernels are compiled for (src/CMakeLists.txt).
//
// The C runtime finds the features at program start (__builtin_cpu_supports): a question is one load and a branch, and
// there is no state of our own. Elsewhere the answer is no, and the plain C kernels serve.

#ifndef TALUS_SRC_BASE_CPU_H
#define TALUS_SRC_BASE_CPU_H

#include <stdbool.h>

#if defined(__x86_64__) && defined(__GNUC__)

static inline bool tl_cpu_has_sse42(void)
{
    return __builtin_cpu_supports("sse4.2");
}

static inline bool tl_cpu_has_avx2(void)
{
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi");
}

static inline bool tl_cpu_has_avx512(void)
{
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") && tl_cpu_has_avx2();
}

#else

static inline bool tl_cpu_has_sse42(void)
{
    return false;
}

static inline bool tl_cpu_has_avx2(void)
{
    return false;
}

static inline bool tl_cpu_has_avx512(void)
{
    return false;
}

#endif

#endif
