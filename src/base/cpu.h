// SPDX-License-Identifier: MIT
//
// Which levels of kernels this build has, and which of them the processor can run.
//
// Levels, ascending: 0 is plain C, the twin that every other level is compared with. 1 has registers of 128 bits: NEON
// on AArch64, simd128 in WebAssembly, SSE4.2 on x86-64. 2 is AVX2 with FMA and BMI1, 3 AVX-512 (F, VL, DQ, BW) besides.
//
// On x86-64 kernels of all levels are compiled, and the first question asks the processor (cpu.c); later ones are one
// load and a branch. MSVC itself is given plain C, for which nobody has compiled the kernels; clang in its dialect all
// levels. Elsewhere the compiler's target decides. 32-bit ARM stays at 0, for its NEON takes denormals as zero; AArch64
// with big-endian words too, for its lanes lie the other way round. A build with TALUS_NO_SIMD has level 0 alone, to
// compare with.

#ifndef TALUS_SRC_BASE_CPU_H
#define TALUS_SRC_BASE_CPU_H

#include <stdbool.h>
#include <stdint.h>

// TL_CPU_LEVELS: the highest level of kernels in this build. TL_CPU_BASE_LEVEL: what every processor of it can run.
#if defined(TALUS_NO_SIMD)
#define TL_CPU_LEVELS     0
#define TL_CPU_BASE_LEVEL 0
#elif defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#define TL_CPU_LEVELS     3
#define TL_CPU_BASE_LEVEL 0
#elif (defined(__aarch64__) && defined(__ARM_NEON) && !defined(__AARCH64EB__)) || defined(__wasm_simd128__)
#define TL_CPU_LEVELS     1
#define TL_CPU_BASE_LEVEL 1
#else
#define TL_CPU_LEVELS     0
#define TL_CPU_BASE_LEVEL 0
#endif

#if TL_CPU_LEVELS == 3

// What cpu.c found; the bits are never changed once they are there, and every thread would find the same.
#define TL_CPU_LOOKED 1u
#define TL_CPU_VEC128 2u
#define TL_CPU_AVX2   4u
#define TL_CPU_AVX512 8u
#define TL_CPU_AMD    16u

extern uint32_t tl_cpu_found;
uint32_t tl_cpu_look(void);

static inline uint32_t tl_cpu_features(void)
{
    const uint32_t found = __atomic_load_n(&tl_cpu_found, __ATOMIC_RELAXED);
    return found != 0 ? found : tl_cpu_look();
}

static inline bool tl_cpu_has(uint32_t bit)
{
    return (tl_cpu_features() & bit) != 0;
}

// Whether an earlier question has found it. Never asks: a function whose last calls are all it does needs no frame
// then.
static inline bool tl_cpu_was_found(uint32_t bit)
{
    return (__atomic_load_n(&tl_cpu_found, __ATOMIC_RELAXED) & bit) != 0;
}

static inline bool tl_cpu_has_vec128(void)
{
    return tl_cpu_has(TL_CPU_VEC128);
}

static inline bool tl_cpu_has_avx2(void)
{
    return tl_cpu_has(TL_CPU_AVX2);
}

static inline bool tl_cpu_has_avx512(void)
{
    return tl_cpu_has(TL_CPU_AVX512);
}

static inline bool tl_cpu_is_amd(void)
{
    return tl_cpu_has(TL_CPU_AMD);
}

/// Whether kernels of this level are in this build, and run on this machine.
static inline bool tl_cpu_has_level(int level)
{
    switch (level) {
    case 0:
        return true;
    case 1:
        return tl_cpu_has_vec128();
    case 2:
        return tl_cpu_has_avx2();
    case 3:
        return tl_cpu_has_avx512();
    default:
        return false;
    }
}

#else

static inline bool tl_cpu_has_level(int level)
{
    return level >= 0 && level <= TL_CPU_LEVELS;
}

#endif

/// What a level is called on this target, for reports.
static inline const char *tl_cpu_level_name(int level)
{
    switch (level) {
    case 0:
        return "plain C";
    case 1:
#if defined(__aarch64__)
        return "NEON";
#elif defined(__wasm__)
        return "simd128";
#else
        return "SSE4.2";
#endif
    case 2:
        return "AVX2";
    default:
        return "AVX-512";
    }
}

/// The highest level of kernels, up to `most`, that runs on this machine.
static inline int tl_cpu_level_up_to(int most)
{
    while (!tl_cpu_has_level(most)) {
        most--;
    }
    return most;
}

#endif
