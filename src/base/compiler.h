// SPDX-License-Identifier: MIT
//
// Hints to the compiler; nothing where it has none.

#ifndef TALUS_SRC_BASE_COMPILER_H
#define TALUS_SRC_BASE_COMPILER_H

#include "base/exact_floats.h"

/// TL_ALWAYS_INLINE: a kernel's values must stay in registers over its parts. TL_NOINLINE: its stack is its own.
/// TL_KEEP_BRANCH behind an assignment to `value`: the branch that leads there stays one. Compilers like to make a
/// conditional move of it, which waits for the condition where a branch is predicted.
/// TL_KEEP_VECTOR: `value`, of an SSE type or a double, is in a register here, as it was loaded.
#if defined(__GNUC__) || defined(__clang__)
#define TL_ALWAYS_INLINE      inline __attribute__((always_inline))
#define TL_NOINLINE           __attribute__((noinline))
#define TL_KEEP_BRANCH(value) __asm__ volatile("" : "+r"(value))
#define TL_KEEP_VECTOR(value) __asm__("" : "+x"(value))
#else
#define TL_ALWAYS_INLINE inline
#define TL_NOINLINE
#define TL_KEEP_BRANCH(value) ((void)(value))
#define TL_KEEP_VECTOR(value) ((void)(value))
#endif

/// A line of memory is needed soon. gcc takes a function that does nothing but fetch for one without effects and leaves
/// its calls out, unless it is TL_ALWAYS_INLINE.
static inline void tl_prefetch(const void *at)
{
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(at);
#else
    (void)at;
#endif
}

#endif
