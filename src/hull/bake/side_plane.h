// SPDX-License-Identifier: MIT
//
// The plane of a triangle, prepared for many exact questions on which side of it a point lies.
//
// The normal, the offset and a bound of the error are computed once, in double, for all points that can be tested; what
// lies within the bound is decided by tl_orient3d. The bound is a share of the points' reach, the largest absolute
// coordinate on each axis, so a cloud is first moved near the origin: see tl_side_origin.

#ifndef TALUS_SRC_HULL_SIDE_PLANE_H
#define TALUS_SRC_HULL_SIDE_PLANE_H

#include "math/predicates.h"
#include "math/tolerance.h"

#include <talus/vec.h>

// With P the sum of the two absolute products of a component of the normal: that component is wrong by at most
// gamma(4) P, and it is multiplied by a difference of at most 2 reach. Each of the two dot products adds gamma(3) of
// its terms, at most P reach, and their difference one rounding more. In all 2 gamma(4) + 2 gamma(4) = gamma(16); the
// last unit covers the rounding of the bound itself.
#define TL_SIDE_ERROR TL_DOUBLE_GAMMA(17)

typedef struct tl_side_plane {
    double normal[3]; // (b - a) x (c - a), not normalized
    double offset;    // normal . a
    double error;     // of normal . p - offset
} tl_side_plane;

// What all coordinates between `low` and `high` of an axis can be moved by without rounding, or 0: when no two of them
// differ by more than a factor of 2, every difference is a float (Sterbenz). Otherwise they reach to the origin as it
// is, to within twice their extent.
static inline float tl_side_origin(float low, float high)
{
    bool near = low > 0.0f ? low >= 0.5f * high : high < 0.0f && high <= 0.5f * low;
    return near ? 0.5f * low + 0.5f * high : 0.0f;
}

// The plane through a, b, c, which runs counter-clockwise seen from in front. No coordinate of a point that will be
// tested, or of a, exceeds `reach`.
static inline tl_side_plane tl_side_plane_make(tl_vec3 a, tl_vec3 b, tl_vec3 c, const double reach[3])
{
    double ax = (double)a.x, ay = (double)a.y, az = (double)a.z;
    double ux = (double)b.x - ax, uy = (double)b.y - ay, uz = (double)b.z - az;
    double vx = (double)c.x - ax, vy = (double)c.y - ay, vz = (double)c.z - az;
    double uyvz = uy * vz, uzvy = uz * vy;
    double uzvx = uz * vx, uxvz = ux * vz;
    double uxvy = ux * vy, uyvx = uy * vx;
    tl_side_plane plane;
    plane.normal[0] = uyvz - uzvy;
    plane.normal[1] = uzvx - uxvz;
    plane.normal[2] = uxvy - uyvx;
    plane.offset = plane.normal[0] * ax + plane.normal[1] * ay + plane.normal[2] * az;
    plane.error = TL_SIDE_ERROR * ((fabs(uyvz) + fabs(uzvy)) * reach[0] + (fabs(uzvx) + fabs(uxvz)) * reach[1] +
                                   (fabs(uxvy) + fabs(uyvx)) * reach[2]);
    return plane;
}

// The approximate height of p above the plane, times the normal's length.
static inline double tl_side_plane_height(const tl_side_plane *plane, tl_vec3 p)
{
    return plane->normal[0] * (double)p.x + plane->normal[1] * (double)p.y + plane->normal[2] * (double)p.z -
           plane->offset;
}

// 1 when a point of that height is certainly in front, -1 certainly behind, 0 when the height does not tell.
static inline int tl_side_plane_sign(const tl_side_plane *plane, double height)
{
    return height > plane->error ? 1 : height < -plane->error ? -1 : 0;
}

static inline double tl_side_plane_length(const tl_side_plane *plane)
{
    return sqrt(plane->normal[0] * plane->normal[0] + plane->normal[1] * plane->normal[1] +
                plane->normal[2] * plane->normal[2]);
}

#endif
