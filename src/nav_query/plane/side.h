// SPDX-License-Identifier: MIT
//
// Left or right in the plane: exact signs at the price of a few double operations.

#ifndef TALUS_SRC_NAV_QUERY_SIDE_H
#define TALUS_SRC_NAV_QUERY_SIDE_H

#include "math/predicates.h"
#include "math/tolerance.h"

#include <talus/vec.h>

/// Twice the signed area of abc in xz, rounded: < 0 when c lies left of the ray from a through b, seen from above.
static inline double tl_nav_turn(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    return ((double)b.x - (double)a.x) * ((double)c.z - (double)a.z) -
           ((double)b.z - (double)a.z) * ((double)c.x - (double)a.x);
}

/// The exact sign of it: -1 left, 0 on the line, 1 right.
static inline int tl_nav_side_of(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    double left = ((double)b.x - (double)a.x) * ((double)c.z - (double)a.z);
    double right = ((double)b.z - (double)a.z) * ((double)c.x - (double)a.x);
    double turn = left - right;
    double bound = TL_CROSS_ERROR * (fabs(left) + fabs(right));
    if (turn > bound || -turn > bound) {
        return turn > 0.0 ? 1 : -1;
    }
    // Two in one place are the usual case: portals that follow one another share an end.
    if ((c.x == b.x && c.z == b.z) || (c.x == a.x && c.z == a.z)) {
        return 0;
    }
    return tl_orient2d(a.x, a.z, b.x, b.z, c.x, c.z);
}

#endif
