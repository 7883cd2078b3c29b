// SPDX-License-Identifier: MIT
//
// Cosine of an angle in degrees, the same on every machine.

#ifndef TALUS_SRC_MATH_COS_DEGREES_H
#define TALUS_SRC_MATH_COS_DEGREES_H

/// The cosine of `degrees` in [0, 90], within one ulp of float. Exact at 0 and 90; at 60 it is exactly 0.5.
float tl_cos_degrees(float degrees);

#endif
