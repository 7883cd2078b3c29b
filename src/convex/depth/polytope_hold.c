// SPDX-License-Identifier: MIT
//
// Whether the polytope that was kept (polytope_keep.c) proves the depth as it is: the bounds meet without a step of
// EPA. No edges are needed then, and of the planes only which is the nearest. Bounds and witnesses are those that EPA
// (epa.c) would end with.

#include "convex/depth/polytope.h"

#include "convex/depth/epa.h"
#include "math/simd2d.h"

// The foot of the origin may be outside of a triangle by so much of its area: the witnesses, which are taken from it as
// it is, leave the triangle by that share of its size at most, 1/256 of the gap between bounds that count as equal.
#define FOOT_SHARE (TL_EPA_DEPTH_GAP / 256.0)

typedef struct kept_body {
    const tl_polytope_cache *cache;
    tl_placed_points points;        // of A - B
    double nearness[TL_KEPT_FACES]; // the square of the least distance of a face's plane, with its sign
} kept_body;

static inline tl_vec3d kept_w(const kept_body *body, uint32_t point)
{
    const tl_placed_points *p = &body->points;
    return tl_vec3d_make(p->x[point], p->y[point], p->z[point]);
}

static inline tl_polytope_plane kept_plane(const kept_body *body, uint32_t face)
{
    const uint8_t *corners = body->cache->corners[face];
    const tl_vec3d last = kept_w(body, corners[2]);
    return tl_polytope_plane_make(last, tl_vec3d_sub(kept_w(body, corners[0]), last),
                                  tl_vec3d_sub(kept_w(body, corners[1]), last));
}

#if TL_HAS_F64X2

typedef struct two_points {
    tl_f64x2 x, y, z;
} two_points;

static inline two_points two_corners(const kept_body *body, uint32_t face, uint32_t next, int corner)
{
    const tl_vec3d p = kept_w(body, body->cache->corners[face][corner]),
                   q = kept_w(body, body->cache->corners[next][corner]);
    const double x[2] = { p.x, q.x }, y[2] = { p.y, q.y }, z[2] = { p.z, q.z };
    const two_points two = { tl_f64x2_load(x), tl_f64x2_load(y), tl_f64x2_load(z) };
    return two;
}

static inline two_points two_sub(two_points a, two_points b)
{
    const two_points two = { tl_f64x2_sub(a.x, b.x), tl_f64x2_sub(a.y, b.y), tl_f64x2_sub(a.z, b.z) };
    return two;
}

static inline tl_f64x2 two_dot(two_points a, two_points b)
{
    return tl_f64x2_add(tl_f64x2_add(tl_f64x2_mul(a.x, b.x), tl_f64x2_mul(a.y, b.y)), tl_f64x2_mul(a.z, b.z));
}

static inline tl_f64x2 two_minor(tl_f64x2 a, tl_f64x2 b, tl_f64x2 c, tl_f64x2 d)
{
    return tl_f64x2_sub(tl_f64x2_mul(a, b), tl_f64x2_mul(c, d));
}

// The nearness of two faces, as kept_plane tells it.
static inline tl_f64x2 two_nearnesses(const kept_body *body, uint32_t face, uint32_t next, tl_f64x2 turned)
{
    const two_points last = two_corners(body, face, next, 2);
    const two_points p = two_sub(two_corners(body, face, next, 0), last),
                     q = two_sub(two_corners(body, face, next, 1), last);
    const two_points normal = { two_minor(p.y, q.z, p.z, q.y), two_minor(p.z, q.x, p.x, q.z),
                                two_minor(p.x, q.y, p.y, q.x) };
    const tl_f64x2 offset = tl_f64x2_sub(two_dot(normal, last), turned);
    const tl_f64x2 size = tl_f64x2_max(offset, tl_f64x2_sub(tl_f64x2_all(0.0), offset));
    return tl_f64x2_div(tl_f64x2_mul(offset, size), two_dot(normal, normal));
}

// Returns the least.
static double find_nearness(kept_body *body, double turned)
{
    const uint32_t count = body->cache->face_count;
    const tl_f64x2 turned_two = tl_f64x2_all(turned);
    tl_f64x2 least = tl_f64x2_all((double)INFINITY);
    for (uint32_t f = 0; f < count; f += 2) {
        const uint32_t face = f + 2 <= count ? f : count - 2; // of the last two one may be computed again
        const tl_f64x2 nearness = two_nearnesses(body, face, face + 1, turned_two);
        tl_f64x2_store(&body->nearness[face], nearness);
        least = tl_f64x2_min(nearness, least);
    }
    return tl_f64x2_get_x(tl_f64x2_min(least, tl_f64x2_swap(least)));
}

#else

static double find_nearness(kept_body *body, double turned)
{
    double least = (double)INFINITY;
    for (uint32_t f = 0; f < body->cache->face_count; f++) {
        const tl_polytope_plane plane = kept_plane(body, f);
        const double offset = plane.offset - turned;
        body->nearness[f] = offset * fabs(offset) / plane.normal_sq;
        least = body->nearness[f] < least ? body->nearness[f] : least;
    }
    return least;
}

#endif

// The nearest; the number of faces when the origin is outside of one.
static uint32_t nearest_face(kept_body *body, double turned)
{
    const uint32_t count = body->cache->face_count;
#if TL_CPU_LEVELS >= 2
    if (tl_cpu_has_avx2()) {
        return tl_scan_nearest_avx2(&body->points, body->cache->corners, count, turned, body->nearness);
    }
#endif
    const double least = find_nearness(body, turned);
    for (uint32_t f = 0; least > 0.0 && f < count; f++) {
        if (body->nearness[f] == least) {
            return f;
        }
    }
    return count;
}

// The size of A - B.
static double size_of(const kept_body *body)
{
    double most = 0.0;
    for (uint32_t i = 0; i < body->cache->point_count; i++) {
        const double size = tl_vec3d_size(kept_w(body, i));
        most = size > most ? size : most;
    }
    return most;
}

static tl_vec3d point_of_a(const tl_minkowski *pair, const kept_body *body, uint32_t point)
{
    return tl_minkowski_vertex_of_a(pair, body->cache->vertices[point][0]);
}

// Witnesses on a face, along whose normal the depth is known; false when the foot of the origin lies beside it.
static bool witness_on_face(const tl_minkowski *pair, const kept_body *body, uint32_t face, tl_core_depth *depth)
{
    const uint8_t *corners = body->cache->corners[face];
    const tl_vec3d p = kept_w(body, corners[0]), q = kept_w(body, corners[1]), r = kept_w(body, corners[2]),
                   n = depth->normal;
    const double at_p = tl_vec3d_dot(n, tl_vec3d_cross(q, r)), at_q = tl_vec3d_dot(n, tl_vec3d_cross(r, p)),
                 at_r = tl_vec3d_dot(n, tl_vec3d_cross(p, q)), sum = at_p + at_q + at_r, least = -FOOT_SHARE * sum;
    if (!(at_p >= least && at_q >= least && at_r >= least && sum > 0.0)) {
        return false;
    }
    const double scale = 1.0 / sum;
    const tl_vec3d a_p = point_of_a(pair, body, corners[0]), a_q = point_of_a(pair, body, corners[1]),
                   a_r = point_of_a(pair, body, corners[2]);
    depth->on_a =
        tl_vec3d_mul_add(tl_vec3d_mul_add(tl_vec3d_scale(a_p, at_p * scale), a_q, at_q * scale), a_r, at_r * scale);
    // The foot is the difference of the two witnesses.
    depth->on_b = tl_vec3d_mul_add(depth->on_a, n, -depth->upper);
    return true;
}

bool tl_polytope_holds(tl_minkowski *pair, const tl_polytope_cache *cache, tl_core_depth *depth)
{
    kept_body body;
    body.cache = cache;
    if (!tl_minkowski_place(pair, cache->vertices, cache->point_count, &body.points)) {
        return false;
    }
    const double error = TL_POLYTOPE_ERROR * pair->scale;
    const uint32_t nearest = nearest_face(&body, 4.0 * error * pair->scale * pair->scale);
    if (nearest == cache->face_count) {
        return false;
    }
    const tl_polytope_plane plane = kept_plane(&body, nearest);
    const uint16_t *hints = cache->vertices[cache->corners[nearest][0]];
    pair->last_a = hints[0];
    pair->last_b = hints[1];
    depth->normal = tl_vec3d_scale(plane.normal, 1.0 / sqrt(plane.normal_sq));
    depth->upper = tl_minkowski_reach(pair, depth->normal);
    depth->lower = sqrt(body.nearness[nearest]) - error;
    // Any of the points tells mostly enough of the size.
    const double apart = depth->upper - depth->lower - 4.0 * pair->direction_error;
    if (!(depth->lower > 0.0) || (apart > TL_EPA_DEPTH_GAP * tl_vec3d_size(kept_w(&body, cache->corners[nearest][0])) &&
                                  apart > TL_EPA_DEPTH_GAP * size_of(&body))) {
        return false;
    }
    depth->status = TL_CONVEX_CONVERGED;
    depth->iterations = 0;
    if (witness_on_face(pair, &body, nearest, depth)) {
        return true;
    }
    // A face of A - B is often several triangles, which are equally near.
    const double gap = TL_EPA_DEPTH_GAP * size_of(&body);
    const double near_enough = (depth->upper + gap) * (depth->upper + gap);
    for (uint32_t f = 0; f < cache->face_count; f++) {
        if (body.nearness[f] <= near_enough && witness_on_face(pair, &body, f, depth)) {
            return true;
        }
    }
    return false;
}
