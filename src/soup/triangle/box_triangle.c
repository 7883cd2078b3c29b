// SPDX-License-Identifier: MIT
//
// Box against triangle: they are apart when one of thirteen axes parts them: the box's three, the triangle's normal,
// and the nine crosses of their edges. Source: Tomas Akenine-Moller, Fast 3D Triangle-Box Overlap Testing, 2001.
//
// Any axis along which there is a gap proves that they are apart, the cross of two parallel edges too, which is nothing
// but rounding. So only the projections' own rounding counts: a gap below it is none.

#include "soup/triangle/box_triangle.h"

#include "base/min_max.h"
#include "math/tolerance.h"

// Share of the terms' sum by which a gap may be wrong: the corners come rotated into the box's frame with some ten
// roundings each, a dot product adds five, the reach five more.
#define GAP_ERROR TL_DOUBLE_GAMMA(32)

// Whether an axis parts the box from the points, `size` being the largest coordinate of all of them.
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
