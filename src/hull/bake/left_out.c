// SPDX-License-Identifier: MIT
//
// Points that a hull leaves out, for its vertices are limited or its faces merged: how far they lie outside.
//
// The nearest point of a convex body lies on a face that the point is in front of. So the faces that it sees, flooded
// as for a step of quickhull, are all that must be tested. For nearly every point that is not needed: its distance from
// the one face that it is filed under bounds the true distance from above, and is less than the largest distance so
// far.

#include "hull/bake/quickhull.h"

#include "base/min_max.h"
#include "math/vec3d.h"

static double distance_sq_to_segment(tl_vec3d a, tl_vec3d b, tl_vec3d p)
{
    tl_vec3d along = tl_vec3d_sub(b, a), to_p = tl_vec3d_sub(p, a);
    double t = tl_clamp_f64(tl_vec3d_dot(along, to_p) / tl_vec3d_dot(along, along), 0.0, 1.0);
    tl_vec3d off = tl_vec3d_mul_add(to_p, along, -t);
    return tl_vec3d_dot(off, off);
}

static double distance_sq_to_face(const tl_quickhull *hull, uint32_t face, tl_vec3d p)
{
    const tl_quickhull_face *f = &hull->faces[face];
    tl_vec3d normal = tl_vec3d_make(f->plane.normal[0], f->plane.normal[1], f->plane.normal[2]);
    double nearest = (double)INFINITY;
    bool above = true;
    for (uint32_t k = 0; k < 3; k++) {
        tl_vec3d a = tl_vec3d_from(hull->local[f->vertex[k]].position),
                 b = tl_vec3d_from(hull->local[f->vertex[k == 2 ? 0 : k + 1]].position);
        nearest = tl_min_f64(nearest, distance_sq_to_segment(a, b, p));
        above = above && tl_vec3d_dot(normal, tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(p, a))) >= 0.0;
    }
    double height = tl_vec3d_dot(normal, p) - f->plane.offset;
    return above ? tl_min_f64(nearest, height * height / tl_vec3d_dot(normal, normal)) : nearest;
}

static double distance_sq_to_hull(tl_quickhull *hull, uint32_t face, tl_vec3 point)
{
    double nearest = (double)INFINITY;
    tl_quickhull_flood_visible(hull, face, point);
    for (uint32_t i = 0; i < hull->visible_count; i++) {
        double distance_sq = distance_sq_to_face(hull, hull->visible[i], tl_vec3d_from(point));
        nearest = tl_min_f64(nearest, distance_sq);
    }
    return nearest;
}

void tl_quickhull_report_left_out(tl_quickhull *hull, tl_hull_report *report)
{
    double farthest_sq = 0.0;
    for (uint32_t face = 0; face < hull->face_count; face++) {
        uint32_t point = hull->conflicts[face].live ? hull->conflicts[face].first : TL_NONE;
        for (; point != TL_NONE; point = hull->local[point].next) {
            double bound_sq = distance_sq_to_face(hull, face, tl_vec3d_from(hull->local[point].position));
            if (bound_sq > farthest_sq) {
                farthest_sq = tl_max_f64(farthest_sq, distance_sq_to_hull(hull, face, hull->local[point].position));
            }
        }
    }
    report->points_left_out = hull->waiting;
    report->max_outside = sqrt(farthest_sq);
}

// How far out of a face's plane a point lies, in units of the middle's depth below it. Over the planes of a hull,
// points of the polar body, this is linear, so a face that no neighbour exceeds is the best of all.
static double relative_height(const tl_quickhull *hull, uint32_t face, tl_vec3 point, tl_vec3d middle)
{
    const tl_side_plane *plane = &hull->faces[face].plane;
    const tl_vec3d normal = tl_vec3d_make(plane->normal[0], plane->normal[1], plane->normal[2]);
    return tl_side_plane_height(plane, point) / (plane->offset - tl_vec3d_dot(normal, middle));
}

static bool sees(const tl_quickhull *hull, uint32_t face, tl_vec3 point)
{
    double height;
    return tl_quickhull_side(hull, &hull->faces[face], point, &height) > 0;
}

double tl_quickhull_distance_outside(tl_quickhull *hull, tl_vec3 point, tl_vec3d middle, uint32_t *face)
{
    uint32_t at = *face, best = at;
    double height = relative_height(hull, at, point, middle);
    while (!sees(hull, at, point)) {
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t other = tl_half_edge_face(hull->faces[at].across[k]);
            const double higher = relative_height(hull, other, point, middle);
            if (higher > height) {
                height = higher;
                best = other;
            }
        }
        if (best == at) {
            break;
        }
        at = best;
    }
    // Among triangles of one plane, or by rounding, the walk may end too early.
    for (uint32_t f = 0; f < hull->face_count && !sees(hull, at, point); f++) {
        at = hull->conflicts[f].live ? f : at;
    }
    *face = at;
    return sees(hull, at, point) ? sqrt(distance_sq_to_hull(hull, at, point)) : 0.0;
}
