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

#define TL_FLOAT_ROUNDING  5.9604645e-8f          ///< u of float: 2^-24
#define TL_DOUBLE_ROUNDING 1.1102230246251565e-16 ///< u of double: 2^-53
#define TL_FLOAT_SMALLEST  1.1754944e-38f         ///< smallest normal float, 2^-126: below it errors are absolute
#define TL_FLOAT_UNDERFLOW 1.4012985e-45f         ///< smallest float, 2^-149: bound of one underflow's absolute error

/// gamma(n) of float arithmetic. The denominator is replaced by a factor that covers all n <= 1000.
#define TL_FLOAT_GAMMA(n) ((float)(n)*TL_FLOAT_ROUNDING * 1.0001f)
/// gamma(n) of double arithmetic, for n <= 1000.
#define TL_DOUBLE_GAMMA(n) ((double)(n)*TL_DOUBLE_ROUNDING * 1.0001)

/// Error of a float dot product of 3-vectors, as a share of the sum of the absolute products: a product and at most two
/// sums on each term.
#define TL_FLOAT_DOT_ERROR TL_FLOAT_GAMMA(3)

/// Error of `dot(normal, point) - offset` in double for float points, as a share of |n.x p.x| + |n.y p.y| + |n.z p.z| +
/// |offset|: one product, three sums.
#define TL_PLANE_SIDE_ERROR TL_DOUBLE_GAMMA(4)

/// Error of each component of a cross product of two differences of floats in double, as a share of the sum of its two
/// absolute products: two differences, a product, a sum.
#define TL_CROSS_ERROR TL_DOUBLE_GAMMA(4)

/// Deviation from 1 of a squared quaternion length that still counts as a rotation: four components, each rounded to
/// float once by the caller's own normalization, with a margin for one that came through ten products of rotations.
#define TL_ROTATION_ERROR TL_FLOAT_GAMMA(100)

#endif
