// SPDX-License-Identifier: MIT
//
// The distance between a segment and a triangle. Unless the segment crosses the face, a nearest point lies at an end of
// the segment or on an edge of the triangle.
//
// The crossing is decided in double. Where rounding decides it wrongly, the segment passes an edge, or an end lies in
// the plane, to within the same rounding, and the other terms are as small.
//
// Source: Christer Ericson, Real-Time Collision Detection, 2005, sections 5.1.9 and 5.1.10.

#include "soup/triangle/segment_triangle.h"

#include "soup/triangle/triangle_point.h"

static double clamp_share(double share)
{
    return share > 0.0 ? share < 1.0 ? share : 1.0 : 0.0;
}

static void keep_nearer(tl_segment_triangle *best, tl_vec3d on_segment, tl_vec3d on_triangle)
{
    tl_vec3d away = tl_vec3d_sub(on_segment, on_triangle);
    double distance_sq = tl_vec3d_dot(away, away);
    if (distance_sq < best->distance_sq) {
        best->distance_sq = distance_sq;
        best->on_segment = on_segment;
        best->on_triangle = on_triangle;
    }
}

// Nearest points of the segments p + s d and q + t e.
static void try_edge(tl_segment_triangle *best, tl_vec3d p, tl_vec3d d, tl_vec3d q, tl_vec3d e)
{
    tl_vec3d r = tl_vec3d_sub(p, q);
    double dd = tl_vec3d_dot(d, d), ee = tl_vec3d_dot(e, e), de = tl_vec3d_dot(d, e);
    double dr = tl_vec3d_dot(d, r), er = tl_vec3d_dot(e, r);
    double determinant = dd * ee - de * de;
    // Nearly parallel: any s will do, since the ends are tried as well.
    double s = determinant > 0.0 ? clamp_share((de * er - dr * ee) / determinant) : 0.0;
    double t = ee > 0.0 ? clamp_share((de * s + er) / ee) : 0.0;
    s = dd > 0.0 ? clamp_share((de * t - dr) / dd) : 0.0;
    keep_nearer(best, tl_vec3d_mul_add(p, d, s), tl_vec3d_mul_add(q, e, t));
}

static bool crosses(const tl_vec3d ends[2], const tl_vec3d v[3])
{
    tl_vec3d direction = tl_vec3d_sub(ends[1], ends[0]);
    tl_vec3d normal = tl_vec3d_cross(tl_vec3d_sub(v[1], v[0]), tl_vec3d_sub(v[2], v[0]));
    double first = tl_vec3d_dot(normal, tl_vec3d_sub(ends[0], v[0]));
    double second = tl_vec3d_dot(normal, tl_vec3d_sub(ends[1], v[0]));
    if (first * second >= 0.0) {
        return false;
    }
    bool left = false, right = false;
    for (int k = 0; k < 3; k++) {
        tl_vec3d a = tl_vec3d_sub(v[k], ends[0]), b = tl_vec3d_sub(v[(k + 1) % 3], ends[0]);
        double side = tl_vec3d_dot(direction, tl_vec3d_cross(a, b));
        left |= side > 0.0;
        right |= side < 0.0;
    }
    return left != right;
}

void tl_segment_triangle_nearest(const tl_vec3d ends[2], const tl_vec3 corners[3], tl_segment_triangle *nearest_out)
{
    tl_vec3d v[3] = { tl_vec3d_from(corners[0]), tl_vec3d_from(corners[1]), tl_vec3d_from(corners[2]) };
    if (crosses(ends, v)) {
        nearest_out->distance_sq = 0.0;
        return;
    }
    nearest_out->distance_sq = (double)INFINITY;
    for (int i = 0; i < 2; i++) {
        tl_triangle_point nearest;
        tl_triangle_nearest(corners, ends[i], &nearest);
        keep_nearer(nearest_out, ends[i], nearest.point);
    }
    tl_vec3d direction = tl_vec3d_sub(ends[1], ends[0]);
    for (int k = 0; k < 3; k++) {
        try_edge(nearest_out, ends[0], direction, v[k], tl_vec3d_sub(v[(k + 1) % 3], v[k]));
    }
}
