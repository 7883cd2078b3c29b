// SPDX-License-Identifier: MIT
//
// Scales along three axes, mirrored where a factor is negative. All zero stands for 1.

#ifndef TALUS_SRC_MATH_SCALE_H
#define TALUS_SRC_MATH_SCALE_H

#include <talus/base.h>
#include <talus/vec.h>

/// Whether a scale changes nothing: all zero, or all 1.
static inline bool tl_scale_is_one(tl_vec3 scale)
{
    return ((scale.x == 0.0f) & (scale.y == 0.0f) & (scale.z == 0.0f)) ||
           ((scale.x == 1.0f) & (scale.y == 1.0f) & (scale.z == 1.0f));
}

/// Its factors: all zero being 1.
static inline tl_vec3 tl_scale_factors(tl_vec3 scale)
{
    return tl_scale_is_one(scale) ? tl_vec3_make(1.0f, 1.0f, 1.0f) : scale;
}

/// Whether fronts of triangles become backs.
static inline bool tl_scale_is_mirrored(tl_vec3 scale)
{
    return ((scale.x < 0.0f) != (scale.y < 0.0f)) != (scale.z < 0.0f);
}

/// Whether it is the same along all axes, but for mirroring.
static inline bool tl_scale_is_uniform(tl_vec3 scale)
{
    return fabsf(scale.x) == fabsf(scale.y) && fabsf(scale.y) == fabsf(scale.z);
}

/// TL_ERR_NOT_FINITE, or TL_ERR_RANGE where the size of a factor is above `most` or below its inverse.
static inline tl_result tl_scale_check(tl_vec3 scale, float most)
{
    if (!tl_is_finite(scale)) {
        return TL_ERR_NOT_FINITE;
    }
    tl_vec3 size = tl_abs(scale);
    float low = tl_minf(size.x, tl_minf(size.y, size.z)), high = tl_maxf(size.x, tl_maxf(size.y, size.z));
    return tl_scale_is_one(scale) || (low >= 1.0f / most && high <= most) ? TL_OK : TL_ERR_RANGE;
}

#endif
