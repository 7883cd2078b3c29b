// SPDX-License-Identifier: MIT
//
// Points that a hull leaves out, for its vertices are limited, a tolerance lets them or its faces are merged: how far
// they lie outside.
//
// The nearest point of a convex body lies on a face that the point is in front of. So the faces that it sees, flooded
// as for a step of quickhull, are all that must be tested. For nearly every point that is not needed: its distance from
// the one face that it is filed under bounds the true distance from above, and is less than the largest distance so
// far.

#include "hull/bake/quickhull.h"

#include "base/assert.h"
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

tl_result tl_quickhull_measure_left_out(tl_quickhull *hull, double allowed, uint32_t *beyond, uint32_t *beyond_count,
                                        double *max_outside)
{
    double farthest_sq = 0.0;
    *beyond_count = 0;
    for (uint32_t face = 0; face < hull->face_count; face++) {
        uint32_t point = hull->conflicts[face].live ? hull->conflicts[face].first : TL_NONE;
        for (; point != TL_NONE; point = hull->local[point].next) {
            const tl_vec3 position = hull->local[point].position;
            if (distance_sq_to_face(hull, face, tl_vec3d_from(position)) <= farthest_sq) {
                continue;
            }
            const double distance_sq = distance_sq_to_hull(hull, face, position);
            TL_TRY(tl_quickhull_count_work(hull, hull->visible_count));
            if (sqrt(distance_sq) > allowed) {
                beyond[(*beyond_count)++] = point;
            } else {
                farthest_sq = tl_max_f64(farthest_sq, distance_sq);
            }
        }
    }
    *max_outside = sqrt(farthest_sq);
    return TL_OK;
}

tl_result tl_quickhull_enqueue_beyond(tl_quickhull *hull, double allowed, bool *found)
{
    *found = false;
    hull->heap_count = 0;
    for (uint32_t face = 0; face < hull->face_count; face++) {
        tl_quickhull_conflicts *conflicts = &hull->conflicts[face];
        uint32_t farthest = TL_NONE;
        double farthest_sq = allowed * allowed;
        for (uint32_t point = conflicts->live ? conflicts->first : TL_NONE; point != TL_NONE;
             point = hull->local[point].next) {
            const tl_vec3 position = hull->local[point].position;
            if (distance_sq_to_face(hull, face, tl_vec3d_from(position)) <= farthest_sq) {
                continue;
            }
            const double distance_sq = distance_sq_to_hull(hull, face, position);
            TL_TRY(tl_quickhull_count_work(hull, hull->visible_count));
            if (!(distance_sq <= farthest_sq)) { // not a number where faces are too small for double
                farthest_sq = isnan(distance_sq) ? (double)INFINITY : distance_sq;
                farthest = point;
            }
        }
        if (farthest != TL_NONE) {
            *found = true;
            conflicts->farthest = farthest;
            conflicts->farthest_value = sqrt(farthest_sq) * tl_side_plane_length(&hull->faces[face].plane);
            TL_TRY(tl_quickhull_enqueue(hull, face));
        }
    }
    return TL_OK;
}
