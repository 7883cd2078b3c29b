// SPDX-License-Identifier: MIT
//
// The plane of a triangle, prepared for many exact questions on which side of it a point lies.
//
// The normal is computed once, in the order of operations of tl_orient3d, so that Shewchuk's bound on that
// determinant's error holds; the bound is taken once too, for the largest point that can be asked. What lies within it
// is decided by tl_orient3d itself.

#ifndef TALUS_SRC_HULL_SIDE_PLANE_H
#define TALUS_SRC_HULL_SIDE_PLANE_H

#include "math/predicates.h"
#include "math/tolerance.h"

#include <talus/vec.h>

// Shewchuk's bound of orient3d is (7 + 56 u) u times the permanent; the eighth u covers the rounding of the bound's own
// few operations.
#define TL_SIDE_ERROR (8.0 * TL_DOUBLE_ROUNDING)

typedef struct tl_side_plane {
    double normal[3]; // (b - a) x (c - a), not normalized
    double error;     // of normal . (p - a)
    tl_vec3 a, b, c;
} tl_side_plane;

// `extent` bounds |p - q| on each axis for all points p that will be asked and q of the triangle.
static inline tl_side_plane tl_side_plane_make(tl_vec3 a, tl_vec3 b, tl_vec3 c, const double extent[3])
{
    double ux = (double)b.x - (double)a.x, uy = (double)b.y - (double)a.y, uz = (double)b.z - (double)a.z;
    double vx = (double)c.x - (double)a.x, vy = (double)c.y - (double)a.y, vz = (double)c.z - (double)a.z;
    double uyvz = uy * vz, uzvy = uz * vy;
    double uzvx = uz * vx, uxvz = ux * vz;
    double uxvy = ux * vy, uyvx = uy * vx;
    tl_side_plane plane;
    plane.normal[0] = uyvz - uzvy;
    plane.normal[1] = uzvx - uxvz;
    plane.normal[2] = uxvy - uyvx;
    plane.error = TL_SIDE_ERROR * ((fabs(uyvz) + fabs(uzvy)) * extent[0] + (fabs(uzvx) + fabs(uxvz)) * extent[1] +
                                   (fabs(uxvy) + fabs(uyvx)) * extent[2]);
    plane.a = a;
    plane.b = b;
    plane.c = c;
    return plane;
}

// 1 when p is in front, 0 in the plane, -1 behind; exact. `value_out` gets the approximate height of p times the
// normal's length.
static inline int tl_side_plane_test(const tl_side_plane *plane, tl_vec3 p, double *value_out)
{
    double value = plane->normal[0] * ((double)p.x - (double)plane->a.x) +
                   plane->normal[1] * ((double)p.y - (double)plane->a.y) +
                   plane->normal[2] * ((double)p.z - (double)plane->a.z);
    *value_out = value;
    if (value > plane->error) {
        return 1;
    }
    return value < -plane->error ? -1 : tl_orient3d(plane->a, plane->b, plane->c, p);
}

static inline double tl_side_plane_length(const tl_side_plane *plane)
{
    return sqrt(plane->normal[0] * plane->normal[0] + plane->normal[1] * plane->normal[1] +
                plane->normal[2] * plane->normal[2]);
}

#endif
