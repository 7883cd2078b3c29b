// SPDX-License-Identifier: MIT
//
// The nearest point of a triangle: on its face, or on one of its edges.
//
// The point projects onto the face when it lies on the inner side of the three planes through the edges along the
// triangle's normal. Ericson's regions (Real-Time Collision Detection, 2005, section 5.1.5) need fewer products, but
// the areas of a needle are mostly rounding, and then choose a corner that is not nearest. Here a needle has no face at
// all: the nearest points of its edges are well conditioned, and as near as the face to within the needle's own height.

#include "soup/triangle/triangle_point.h"

#include "math/tolerance.h"

// A triangle whose sine at corner 0 is below half an ulp of float has no face: its height is below the precision of its
// coordinates. Above that, its normal in double is right to 2^-24.
#define NEEDLE_SINE ((double)TL_FLOAT_ROUNDING)

static double nearest_of_edge(tl_vec3d a, tl_vec3d b, tl_vec3d p, tl_vec3d *point_out, int *end_out)
{
    tl_vec3d along = tl_vec3d_sub(b, a);
    double length_sq = tl_vec3d_dot(along, along);
    double share = tl_vec3d_dot(along, tl_vec3d_sub(p, a));
    bool at_start = !(share > 0.0), at_end = share >= length_sq;
    *end_out = at_start ? 0 : at_end ? 1 : -1;
    *point_out = at_start ? a : at_end ? b : tl_vec3d_mul_add(a, along, share / length_sq);
    tl_vec3d away = tl_vec3d_sub(p, *point_out);
    return tl_vec3d_dot(away, away);
}

void tl_triangle_nearest(const tl_vec3 corners[3], tl_vec3d p, tl_triangle_point *nearest_out)
{
    tl_vec3d v[3], edge[3];
    for (int k = 0; k < 3; k++) {
        v[k] = tl_vec3d_from(corners[k]);
    }
    for (int k = 0; k < 3; k++) {
        edge[k] = tl_vec3d_sub(v[(k + 1) % 3], v[k]);
    }
    tl_vec3d normal = tl_vec3d_cross(edge[2], edge[0]);
    double normal_sq = tl_vec3d_dot(normal, normal);
    double needle_sq = NEEDLE_SINE * NEEDLE_SINE * tl_vec3d_dot(edge[0], edge[0]) * tl_vec3d_dot(edge[2], edge[2]);
    bool outside[3];
    for (int k = 0; k < 3; k++) {
        outside[k] = !(tl_vec3d_dot(tl_vec3d_cross(normal, edge[k]), tl_vec3d_sub(p, v[k])) > 0.0);
    }
    if (normal_sq > needle_sq && !outside[0] && !outside[1] && !outside[2]) {
        double height = tl_vec3d_dot(normal, tl_vec3d_sub(p, v[0]));
        nearest_out->point = tl_vec3d_mul_add(p, normal, -height / normal_sq);
        nearest_out->distance_sq = height * height / normal_sq;
        nearest_out->feature = TL_TRIANGLE_FACE;
        return;
    }
    nearest_out->distance_sq = (double)INFINITY;
    for (int k = 0; k < 3; k++) {
        tl_vec3d point;
        int end;
        double distance_sq = nearest_of_edge(v[k], v[(k + 1) % 3], p, &point, &end);
        if (distance_sq < nearest_out->distance_sq) {
            nearest_out->distance_sq = distance_sq;
            nearest_out->point = point;
            nearest_out->feature =
                (tl_triangle_feature)(end < 0 ? TL_TRIANGLE_EDGE_0 + k : TL_TRIANGLE_CORNER_0 + (k + end) % 3);
        }
    }
}

tl_vec3 tl_triangle_normal(const tl_vec3 corners[3])
{
    tl_vec3d a = tl_vec3d_from(corners[0]);
    tl_vec3d normal =
        tl_vec3d_cross(tl_vec3d_sub(tl_vec3d_from(corners[1]), a), tl_vec3d_sub(tl_vec3d_from(corners[2]), a));
    return tl_vec3d_unit_or_zero(normal);
}
