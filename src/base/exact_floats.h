// SPDX-License-Identifier: MIT
//
// What every source of the library needs of its compiler: floats and doubles that are computed as IEEE 754 says, each
// operation by itself. Exact predicates, equal bytes on every machine, and NaN as a value that is looked for all rest
// on it; with other arithmetic hulls and rays would break in silence, so the compiler stops here instead. tools/lint
// sees that every source reaches this header.
//
// Fused multiply-adds have no macro to look at: -ffp-contract=off is the build's part (docs/design.md).

#ifndef TALUS_SRC_BASE_EXACT_FLOATS_H
#define TALUS_SRC_BASE_EXACT_FLOATS_H

#include <float.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0) ||                          \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(_M_FP_FAST)
#error "compile talus without -ffast-math, -Ofast, -ffinite-math-only or /fp:fast: it needs IEEE arithmetic"
#endif

#if FLT_EVAL_METHOD != 0
#error "compile talus with -msse2 -mfpmath=sse, or -fexcess-precision=fast: the x87 rounds twice, to other bits"
#endif

#endif
