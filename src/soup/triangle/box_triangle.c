// SPDX-License-Identifier: MIT
//
// Box against triangle by separating axes: they are disjoint when one of thirteen axes separates them: the box's three,
// the triangle's normal, and the nine crosses of their edges.
//
// A gap along any axis proves that they are disjoint, even along the cross of two parallel edges, which is nothing but
// rounding. So only the rounding of the projections counts: a gap smaller than it is none.
//
// Source: Akenine-Moller, Fast 3D Triangle-Box Overlap Testing, 2001.

#include "soup/triangle/box_triangle.h"

#include "base/min_max.h"
#include "math/tolerance.h"

// Error of a gap, as a share of the sum of its terms: rotating a corner into the box's frame takes about ten roundings,
// a dot product five, the reach five more.
#define GAP_ERROR TL_DOUBLE_GAMMA(32)

// Whether an axis separates the box from the points; `size` is the largest coordinate of all of them.
static bool separates(tl_vec3d axis, const double half[3], const tl_vec3d v[3], double size)
{
    double reach = half[0] * fabs(axis.x) + half[1] * fabs(axis.y) + half[2] * fabs(axis.z);
    double a = tl_vec3d_dot(axis, v[0]), b = tl_vec3d_dot(axis, v[1]), c = tl_vec3d_dot(axis, v[2]);
    double low = tl_min_f64(tl_min_f64(a, b), c), high = tl_max_f64(tl_max_f64(a, b), c);
    double noise = GAP_ERROR * size * (fabs(axis.x) + fabs(axis.y) + fabs(axis.z));
    return low > reach + noise || high < -(reach + noise);
}

bool tl_box_touches_triangle(const double half[3], const tl_vec3d corners[3])
{
    double size = 0.0;
    for (int k = 0; k < 3; k++) {
        size = tl_max_f64(size, tl_max_f64(tl_max_f64(fabs(corners[k].x), fabs(corners[k].y)), fabs(corners[k].z)));
        size = tl_max_f64(size, half[k]);
    }
    const tl_vec3d axes[3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    for (int i = 0; i < 3; i++) {
        if (separates(axes[i], half, corners, size)) {
            return false;
        }
    }
    tl_vec3d edge[3] = { tl_vec3d_sub(corners[1], corners[0]), tl_vec3d_sub(corners[2], corners[1]),
                         tl_vec3d_sub(corners[0], corners[2]) };
    if (separates(tl_vec3d_cross(edge[0], edge[1]), half, corners, size)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            if (separates(tl_vec3d_cross(axes[i], edge[k]), half, corners, size)) {
                return false;
            }
        }
    }
    return true;
}
