// SPDX-License-Identifier: MIT
//
// Every tolerance of the library in one place, or derived from what stands here. None is absolute: each is a count of
// roundings times the size of the data, so that it holds at every scale.
//
// The rule of derivation (Higham, Accuracy and Stability of Numerical Algorithms, lemma 3.1): a result that n rounded
// operations in a row went into has a relative error of at most gamma(n) = n u / (1 - n u), relative to the sum of the
// absolute values of its terms; u is half an ulp of 1.

#ifndef TALUS_SRC_MATH_TOLERANCE_H
#define TALUS_SRC_MATH_TOLERANCE_H

#include "base/exact_floats.h"

#define TL_FLOAT_ROUNDING  5.9604645e-8f          ///< u of float: 2^-24
#define TL_DOUBLE_ROUNDING 1.1102230246251565e-16 ///< u of double: 2^-53

/// gamma(n) of float arithmetic. The denominator is replaced by a factor that covers all n <= 1000.
#define TL_FLOAT_GAMMA(n) ((float)(n)*TL_FLOAT_ROUNDING * 1.0001f)
/// gamma(n) of double arithmetic, for n <= 1000.
#define TL_DOUBLE_GAMMA(n) ((double)(n)*TL_DOUBLE_ROUNDING * 1.0001)

/// Share by which a bound in double is moved before it is rounded to float, so that the float does not end up on the
/// wrong side: one rounding, and some more.
#define TL_FLOAT_OUTWARD (2.0 * (double)TL_FLOAT_ROUNDING)

/// Share of the data's size by which a shape that only says what need not be looked at is drawn larger: 160 roundings
/// of floats, where what must stay within it goes through some ten. It costs time at most, never an answer.
#define TL_CULLING_MARGIN 1e-5

/// Share of a length by which a bound that only guides a search is kept short of it, so that roundings of sums along
/// many kilometres do not break it: along ten metres that is a millimetre. It costs time at most, never an answer.
#define TL_BOUND_SLACK 1e-4

/// Error of each component of a cross product of two differences of floats in double, as a share of the sum of its two
/// absolute products: two differences, a product, a sum.
#define TL_CROSS_ERROR TL_DOUBLE_GAMMA(4)

#endif
