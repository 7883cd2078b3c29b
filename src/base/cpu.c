// SPDX-License-Identifier: MIT
//
// What the processor can do, by its own word: CPUID, and XGETBV for the registers that the system saves.
//
// The compilers' __builtin_cpu_supports asks a runtime library that not every one of them links: none for Windows in
// the dialect of MSVC, none when a Mac is compiled for from elsewhere.
// Source: Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2, CPUID, and volume 1, chapter 13.

#include "base/cpu.h"
#include "base/exact_floats.h"

#if TL_CPU_LEVELS == 3

#include <cpuid.h>
#include <stdint.h>

// Bits of the registers that CPUID returns.
#define LEAF1_ECX_FMA      (1u << 12)
#define LEAF1_ECX_SSE4_2   (1u << 20)
#define LEAF1_ECX_OSXSAVE  (1u << 27)
#define LEAF1_ECX_AVX      (1u << 28)
#define LEAF7_EBX_BMI1     (1u << 3)
#define LEAF7_EBX_AVX2     (1u << 5)
#define LEAF7_EBX_AVX512F  (1u << 16)
#define LEAF7_EBX_AVX512DQ (1u << 17)
#define LEAF7_EBX_AVX512BW (1u << 30)
#define LEAF7_EBX_AVX512VL (1u << 31)
#define LEAF7_EBX_AVX512   (LEAF7_EBX_AVX512F | LEAF7_EBX_AVX512DQ | LEAF7_EBX_AVX512BW | LEAF7_EBX_AVX512VL)

// Bits of XCR0: registers that the system saves.
#define XCR0_AVX       0x06u
#define XCR0_AVX_512   0xe6u

#define VENDOR_AMD_EBX 0x68747541u // "Auth", of AuthenticAMD

static uint32_t saved_registers(void)
{
    uint32_t low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

static uint32_t look_at_processor(void)
{
    uint32_t a, b, c, d, found = TL_CPU_LOOKED;
    if (__get_cpuid(0, &a, &b, &c, &d) == 0) {
        return found;
    }
    found |= b == VENDOR_AMD_EBX ? TL_CPU_AMD : 0;
    if (__get_cpuid(1, &a, &b, &c, &d) == 0) {
        return found;
    }
    const uint32_t first = c;
    found |= (first & LEAF1_ECX_SSE4_2) != 0 ? TL_CPU_VEC128 : 0;
    const uint32_t saved = (first & LEAF1_ECX_OSXSAVE) != 0 ? saved_registers() : 0;
    if (__get_cpuid_count(7, 0, &a, &b, &c, &d) == 0 || (saved & XCR0_AVX) != XCR0_AVX ||
        (first & LEAF1_ECX_AVX) == 0 || (first & LEAF1_ECX_FMA) == 0 || (b & LEAF7_EBX_AVX2) == 0 ||
        (b & LEAF7_EBX_BMI1) == 0) {
        return found;
    }
    found |= TL_CPU_AVX2;
    const bool has_avx512 = (saved & XCR0_AVX_512) == XCR0_AVX_512 && (b & LEAF7_EBX_AVX512) == LEAF7_EBX_AVX512;
    return found | (has_avx512 ? TL_CPU_AVX512 : 0);
}

uint32_t tl_cpu_found;

uint32_t tl_cpu_look(void)
{
    const uint32_t found = look_at_processor();
    __atomic_store_n(&tl_cpu_found, found, __ATOMIC_RELAXED);
    return found;
}

#else

typedef int tl_cpu_has_one_level; // a file must not be empty

#endif
