// SPDX-License-Identifier: MIT
//
// Cosine by Taylor's series in double. The core does without libm's cos: its last bit differs between systems, and a
// slope limit that differs in the last bit makes another navmesh.
//
// Angles above 45 degrees are taken as the sine of their complement, which is exact in degrees. On [0, pi / 4] the
// first term left out is below (pi / 4)^17 / 17! = 5e-17, so what remains are the roundings of nine additions in
// double: far below half an ulp of float, to which the result is rounded once.

#include "math/cos_degrees.h"

#include "base/assert.h"

static const double RADIANS_PER_DEGREE = 0.017453292519943295;

// Horner's form of 1 - x^2/2! + x^4/4! - ... with `first` the first factorial's lower factor: 1 for cosine (1 * 2),
// 2 for sine divided by x (2 * 3).
static double alternating_series(double x_sq, int first)
{
    double sum = 1.0;
    for (int k = first + 14; k >= first; k -= 2) {
        sum = 1.0 - sum * x_sq / (double)(k * (k + 1));
    }
    return sum;
}

float tl_cos_degrees(float degrees)
{
    TL_ASSERT(degrees >= 0.0f && degrees <= 90.0f);
    if (degrees <= 45.0f) {
        double x = (double)degrees * RADIANS_PER_DEGREE;
        return (float)alternating_series(x * x, 1);
    }
    double x = (90.0 - (double)degrees) * RADIANS_PER_DEGREE;
    return (float)(x * alternating_series(x * x, 2));
}
