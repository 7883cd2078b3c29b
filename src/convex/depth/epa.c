// SPDX-License-Identifier: MIT
//
// EPA, the expanding polytope algorithm: the penetration depth of two shapes is the distance of the origin from the
// surface of their Minkowski difference A - B. Grow a polytope inside A - B by the support point along the normal of
// its face nearest to the origin: that face bounds the depth from below, each support point from above. Source: van den
// Bergen, Proximity Queries and Penetration Depth Computation on 3D Game Objects, 2001.
//
// Both bounds hold at any time, so the loop may end anywhere and the answer says how good it is. A flat difference,
// which has no tetrahedron to start from, is no failure: its depth is 0 and its normal that of the plane.

#include "convex/depth/epa.h"

#include "base/compiler.h"
#include "convex/depth/polytope.h"
#include "math/tolerance.h"

#include <string.h>

typedef struct epa_search {
    tl_minkowski *pair;
    double reach; // largest |w| of the points seen; the origin is inside, so this is the size of A - B
    tl_core_depth *depth;
    tl_polytope_cache *cache; // may be NULL
} epa_search;

// Metres that rounding may be off.
static double epa_noise(const epa_search *s)
{
    return TL_POLYTOPE_ERROR * s->pair->scale;
}

static void grow_reach(epa_search *s, const tl_minkowski_point *point)
{
    double reach = tl_vec3d_size(point->w);
    s->reach = reach > s->reach ? reach : s->reach;
}

// The support along a direction, whose length is one over `scale`. It bounds the depth from above: true when this is
// the best bound so far. The face that is nearest is seldom near the one before, so no hint would help.
static bool probe(epa_search *s, tl_vec3d direction, double scale, tl_minkowski_point *point_out)
{
    s->pair->last_a = s->pair->last_b = TL_NO_VERTEX;
    tl_minkowski_support(s->pair, direction, point_out);
    grow_reach(s, point_out);
    double upper = tl_vec3d_dot(direction, point_out->w) * scale;
    if (upper < s->depth->upper) {
        s->depth->upper = upper;
        s->depth->normal = tl_vec3d_scale(direction, scale);
        return true;
    }
    return false;
}

// Takes the support along six directions and keeps the point that is farthest from the first point or line.
static bool widen_simplex(epa_search *s, tl_minkowski_point *points, uint32_t count, const tl_vec3d directions[6])
{
    double best = 0.0;
    tl_vec3d line = count > 1 ? tl_vec3d_sub(points[1].w, points[0].w) : tl_vec3d_make(0.0, 0.0, 0.0);
    double length = tl_vec3d_length(line);
    for (int i = 0; i < 6; i++) {
        tl_minkowski_point point;
        probe(s, directions[i], 1.0, &point);
        tl_vec3d away = tl_vec3d_sub(point.w, points[0].w);
        double spread = count > 1 ? tl_vec3d_length(tl_vec3d_cross(line, away)) / length : tl_vec3d_length(away);
        if (spread > best) {
            best = spread;
            points[count] = point;
        }
    }
    return best > 4.0 * epa_noise(s);
}

static bool widen_point(epa_search *s, tl_minkowski_point *points)
{
    static const tl_vec3d axes[6] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
    return widen_simplex(s, points, 1, axes);
}

static bool widen_line(epa_search *s, tl_minkowski_point *points)
{
    tl_vec3d line = tl_vec3d_sub(points[1].w, points[0].w);
    line = tl_vec3d_scale(line, 1.0 / tl_vec3d_length(line));
    tl_vec3d u = tl_vec3d_perpendicular(line), v = tl_vec3d_cross(line, u);
    tl_vec3d directions[6];
    for (int i = 0; i < 6; i++) {
        // A hexagon: cos and sin of multiples of 60 degrees.
        static const double turn[6][2] = { { 1, 0 },  { 0.5, 0.8660254037844386 },   { -0.5, 0.8660254037844386 },
                                           { -1, 0 }, { -0.5, -0.8660254037844386 }, { 0.5, -0.8660254037844386 } };
        directions[i] = tl_vec3d_mul_add(tl_vec3d_scale(u, turn[i][0]), v, turn[i][1]);
    }
    return widen_simplex(s, points, 2, directions);
}

static bool widen_plane(epa_search *s, tl_minkowski_point *points)
{
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(points[1].w, points[0].w), tl_vec3d_sub(points[2].w, points[0].w));
    double length = tl_vec3d_length(n);
    if (!(length > 0.0)) {
        return false;
    }
    n = tl_vec3d_scale(n, 1.0 / length);
    tl_minkowski_point up, down;
    probe(s, n, 1.0, &up);
    probe(s, tl_vec3d_neg(n), 1.0, &down);
    double height = tl_vec3d_dot(n, tl_vec3d_sub(up.w, points[0].w)),
           depth = -tl_vec3d_dot(n, tl_vec3d_sub(down.w, points[0].w));
    points[3] = height > depth ? up : down;
    return (height > depth ? height : depth) > 4.0 * epa_noise(s);
}

// Points of A and B whose difference is a triangle's point nearest to the origin. Returns how far that is from where
// the depth and the normal say.
static double witness_on(const epa_search *s, const tl_polytope *p, const uint8_t vertices[3], tl_vec3d *on_a,
                         tl_vec3d *on_b)
{
    tl_simplex triangle;
    triangle.count = 3;
    for (int i = 0; i < 3; i++) {
        const tl_polytope_vertex *v = &p->vertices[vertices[i]];
        tl_minkowski_point point = { v->w, v->a, TL_NO_VERTEX, TL_NO_VERTEX };
        triangle.points[i] = point;
    }
    tl_vec3d nearest = tl_simplex_nearest(&triangle);
    tl_simplex_witness(&triangle, on_a, on_b);
    return tl_vec3d_length(tl_vec3d_mul_add(nearest, s->depth->normal, -s->depth->upper));
}

// A face of A - B is often several triangles, and the last one need not hold the origin's foot: of all
// that are as near, take the one that does.
static void find_epa_witness(epa_search *s, const tl_polytope *p, const uint8_t best_vertices[3])
{
    double gap = TL_EPA_DEPTH_GAP * s->reach;
    double reach = fmax(s->depth->upper, 0.0) + gap;
    double best = witness_on(s, p, best_vertices, &s->depth->on_a, &s->depth->on_b);
    for (uint32_t f = 0; f < p->face_count && best > gap; f++) {
        if (p->keys[f] <= reach) {
            tl_vec3d on_a, on_b;
            double off = witness_on(s, p, &p->origins[4 * f], &on_a, &on_b);
            if (off < best) {
                best = off;
                s->depth->on_a = on_a;
                s->depth->on_b = on_b;
            }
        }
    }
    // On curved surfaces a depth that is right to a gap has a normal that is right to the root of it only: witnesses
    // may be off sideways, in the surfaces, by so much. Halve that between them, so that they lie along the normal.
    tl_vec3d apart = tl_vec3d_sub(s->depth->on_a, s->depth->on_b);
    tl_vec3d off = tl_vec3d_mul_add(apart, s->depth->normal, -s->depth->upper);
    s->depth->on_a = tl_vec3d_mul_add(s->depth->on_a, off, -0.5);
    s->depth->on_b = tl_vec3d_mul_add(s->depth->on_b, off, 0.5);
}

static void keep_polytope(const epa_search *s, tl_polytope *p, uint32_t nearest)
{
    if (s->depth->status == TL_CONVEX_CONVERGED) {
        tl_polytope_keep(p, nearest, s->depth->lower, s->cache);
    } else {
        s->cache->point_count = 0;
    }
}

static void expand_polytope(epa_search *s, tl_polytope *p)
{
    uint8_t best_vertices[3] = { 0, 1, 2 };
    tl_core_depth *depth = s->depth;
    depth->upper = (double)INFINITY; // what the start found is found again where it matters, with its triangle
    uint32_t f;
    for (;;) {
        f = tl_polytope_nearest_face(p);
        tl_polytope_plane plane = tl_polytope_plane_of(p, f);
        const tl_vec3d normal = plane.normal;
        double scale = 1.0 / sqrt(plane.normal_sq), distance = plane.offset * scale;
        tl_minkowski_point point;
        if (probe(s, normal, scale, &point)) {
            for (int i = 0; i < 3; i++) {
                best_vertices[i] = p->origins[4 * f + (uint32_t)i];
            }
        }
        double gap = TL_EPA_DEPTH_GAP * s->reach, beyond = tl_vec3d_dot(normal, point.w) * scale - distance;
        depth->lower = fmax(depth->lower, p->keys[f]);
        if (depth->upper - depth->lower <= gap || beyond <= 2.0 * epa_noise(s)) {
            depth->status = depth->upper - depth->lower <= gap + 4.0 * s->pair->direction_error ? TL_CONVEX_CONVERGED
                                                                                                : TL_CONVEX_DEGENERATE;
            break;
        }
        if (depth->iterations >= s->pair->depth_steps) {
            depth->status = TL_CONVEX_ITERATIONS;
            break;
        }
        if (!tl_polytope_add(p, f, &point, s->pair->scale)) {
            depth->status = p->vertex_count == TL_POLYTOPE_VERTICES ? TL_CONVEX_ITERATIONS : TL_CONVEX_DEGENERATE;
            break;
        }
        depth->iterations++;
    }
    find_epa_witness(s, p, best_vertices);
    if (s->cache != NULL) {
        keep_polytope(s, p, f);
    }
}

static bool grow_kept(tl_minkowski *pair, tl_polytope_cache *cache, tl_core_depth *depth)
{
    uint16_t ids[TL_POLYTOPE_VERTICES][2];
    tl_polytope polytope;
    polytope.ids = ids;
    if (!tl_polytope_resume(pair, cache, &polytope)) {
        return false;
    }
    epa_search s = { pair, 0.0, depth, cache };
    memset(depth, 0, sizeof *depth);
    for (uint32_t i = 0; i < polytope.vertex_count; i++) {
        const double reach = tl_vec3d_size(polytope.vertices[i].w);
        s.reach = reach > s.reach ? reach : s.reach;
    }
    expand_polytope(&s, &polytope);
    return depth->status == TL_CONVEX_CONVERGED;
}

// The largest of the corners' indices, those of free slots too: a loop of one length, which compilers make a few
// instructions of.
static uint8_t largest_corner(const tl_polytope_cache *cache)
{
    const uint8_t *bytes = &cache->corners[0][0];
    uint8_t most = 0;
    for (uint32_t i = 0; i < 3 * TL_KEPT_FACES; i++) {
        most = bytes[i] > most ? bytes[i] : most;
    }
    return most;
}

// Whether a cache holds triangles between its points: a caller's may hold anything.
static bool is_polytope(const tl_polytope_cache *cache)
{
    return cache->point_count >= 4 && cache->point_count <= TL_KEPT_POINTS && cache->face_count >= 4 &&
           cache->face_count <= TL_KEPT_FACES && largest_corner(cache) < cache->point_count;
}

bool tl_epa_resume(tl_minkowski *pair, tl_polytope_cache *cache, tl_core_depth *depth)
{
    return is_polytope(cache) && (tl_polytope_holds(pair, cache, depth) || grow_kept(pair, cache, depth));
}

// `ids` is NULL where `cache` is.
static TL_NOINLINE void run_epa(tl_minkowski *pair, const tl_gjk *gjk, tl_polytope_cache *cache, uint16_t (*ids)[2],
                                tl_core_depth *depth)
{
    tl_minkowski_point points[4];
    epa_search s = { pair, 0.0, depth, cache };
    memset(depth, 0, sizeof *depth);
    depth->upper = (double)INFINITY;
    tl_minkowski_set_hints(pair, TL_NO_VERTEX, TL_NO_VERTEX);
    for (uint32_t i = 0; i < gjk->simplex.count; i++) {
        points[i] = gjk->simplex.points[i];
        grow_reach(&s, &points[i]);
    }
    tl_simplex_witness(&gjk->simplex, &depth->on_a, &depth->on_b); // stays when A - B is flat
    uint32_t count = gjk->simplex.count;
    bool solid = count > 1 || widen_point(&s, points);
    solid = solid && (count > 2 || widen_line(&s, points));
    solid = solid && (count > 3 || widen_plane(&s, points));
    if (cache != NULL) {
        cache->point_count = 0;
    }
    if (solid) {
        tl_polytope polytope;
        polytope.ids = ids;
        tl_polytope_init(&polytope, points, pair->scale);
        expand_polytope(&s, &polytope);
    }
}

// Deep in a cast there is no stack for what only a cache asks for.
static TL_NOINLINE void run_and_keep(tl_minkowski *pair, const tl_gjk *gjk, tl_polytope_cache *cache,
                                     tl_core_depth *depth)
{
    uint16_t ids[TL_POLYTOPE_VERTICES][2];
    run_epa(pair, gjk, cache, ids, depth);
}

void tl_epa_run(tl_minkowski *pair, const tl_gjk *gjk, tl_polytope_cache *cache, tl_core_depth *depth)
{
    if (cache != NULL) {
        run_and_keep(pair, gjk, cache, depth);
    } else {
        run_epa(pair, gjk, NULL, NULL, depth);
    }
}
