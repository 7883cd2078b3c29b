// SPDX-License-Identifier: MIT
//
// Whether the polytope that was kept (polytope_keep.c) proves the depth as it is: the bounds meet without a step of
// EPA. No edges are needed then, and of the planes only which is the nearest. Bounds and witnesses are those that EPA
// (epa.c) would end with.

#include "convex/depth/polytope.h"

#include "convex/depth/epa.h"

// The foot of the origin may be outside of a triangle by so much of its area: the witnesses, which are taken from it as
// it is, leave the triangle by that share of its size at most, 1/256 of the gap between bounds that count as equal.
#define FOOT_SHARE (TL_EPA_DEPTH_GAP / 256.0)

typedef struct kept_body {
    const tl_polytope_cache *cache;
    tl_minkowski_point points[TL_KEPT_POINTS];
    double nearness[TL_KEPT_FACES]; // the square of the least distance of a face's plane, with its sign
} kept_body;

static inline tl_polytope_plane kept_plane(const kept_body *body, uint32_t face)
{
    const uint8_t *corners = body->cache->corners[face];
    const tl_vec3d last = body->points[corners[2]].w;
    return tl_polytope_plane_make(last, tl_vec3d_sub(body->points[corners[0]].w, last),
                                  tl_vec3d_sub(body->points[corners[1]].w, last));
}

// The nearest; TL_KEPT_FACES when the origin is outside of one.
static uint32_t nearest_face(kept_body *body, double turned)
{
    double least = (double)INFINITY;
    uint32_t nearest = TL_KEPT_FACES;
    for (uint32_t f = 0; f < body->cache->face_count; f++) {
        const tl_polytope_plane plane = kept_plane(body, f);
        const double offset = plane.offset - turned, nearness = offset * fabs(offset) / plane.normal_sq;
        body->nearness[f] = nearness;
        nearest = nearness < least ? f : nearest;
        least = nearness < least ? nearness : least;
    }
    return least > 0.0 ? nearest : TL_KEPT_FACES;
}

// The size of A - B.
static double size_of(const kept_body *body)
{
    double most = 0.0;
    for (uint32_t i = 0; i < body->cache->point_count; i++) {
        const double size = tl_vec3d_size(body->points[i].w);
        most = size > most ? size : most;
    }
    return most;
}

// Witnesses on a face, along whose normal the depth is known; false when the foot of the origin lies beside it.
static bool witness_on_face(const kept_body *body, uint32_t face, tl_core_depth *depth)
{
    const uint8_t *corners = body->cache->corners[face];
    const tl_minkowski_point *p = &body->points[corners[0]], *q = &body->points[corners[1]],
                             *r = &body->points[corners[2]];
    const tl_vec3d n = depth->normal;
    const double at_p = tl_vec3d_dot(n, tl_vec3d_cross(q->w, r->w)), at_q = tl_vec3d_dot(n, tl_vec3d_cross(r->w, p->w)),
                 at_r = tl_vec3d_dot(n, tl_vec3d_cross(p->w, q->w)), sum = at_p + at_q + at_r,
                 least = -FOOT_SHARE * sum;
    if (!(at_p >= least && at_q >= least && at_r >= least && sum > 0.0)) {
        return false;
    }
    const double scale = 1.0 / sum;
    depth->on_a =
        tl_vec3d_mul_add(tl_vec3d_mul_add(tl_vec3d_scale(p->a, at_p * scale), q->a, at_q * scale), r->a, at_r * scale);
    // The foot is the difference of the two witnesses.
    depth->on_b = tl_vec3d_mul_add(depth->on_a, n, -depth->upper);
    return true;
}

bool tl_polytope_holds(tl_minkowski *pair, const tl_polytope_cache *cache, tl_core_depth *depth)
{
    kept_body body;
    body.cache = cache;
    if (!tl_minkowski_vertices(pair, cache->vertices, cache->point_count, body.points)) {
        return false;
    }
    const double error = TL_POLYTOPE_ERROR * pair->scale;
    const uint32_t nearest = nearest_face(&body, 4.0 * error * pair->scale * pair->scale);
    if (nearest == TL_KEPT_FACES) {
        return false;
    }
    const tl_polytope_plane plane = kept_plane(&body, nearest);
    const uint16_t *hints = cache->vertices[cache->corners[nearest][0]];
    pair->last_a = hints[0];
    pair->last_b = hints[1];
    depth->normal = tl_vec3d_scale(plane.normal, 1.0 / sqrt(plane.normal_sq));
    depth->upper = tl_minkowski_reach(pair, depth->normal);
    depth->lower = sqrt(body.nearness[nearest]) - error;
    const double gap = TL_EPA_DEPTH_GAP * size_of(&body);
    if (!(depth->lower > 0.0 && depth->upper - depth->lower <= gap + 4.0 * pair->direction_error)) {
        return false;
    }
    depth->status = TL_CONVEX_CONVERGED;
    depth->iterations = 0;
    if (witness_on_face(&body, nearest, depth)) {
        return true;
    }
    // A face of A - B is often several triangles, which are equally near.
    const double near_enough = (depth->upper + gap) * (depth->upper + gap);
    for (uint32_t f = 0; f < cache->face_count; f++) {
        if (body.nearness[f] <= near_enough && witness_on_face(&body, f, depth)) {
            return true;
        }
    }
    return false;
}
