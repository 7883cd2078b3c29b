// SPDX-License-Identifier: MIT
//
// GJK: the distance of two convex shapes is that of the origin from their Minkowski difference A - B. Walk with a
// simplex of support points toward the origin; the nearest point of the simplex bounds the distance from above, the
// support along it from below. Source: Gilbert, Johnson, Keerthi, A Fast Procedure for Computing the Distance Between
// Complex Objects in Three-Dimensional Space, 1988; the ends by van den Bergen, A Fast and Robust GJK Implementation,
// 1999.
//
// There is no tolerance that decides anything but "equal": the walk ends when the bounds meet to float precision, when
// the support brings nothing new, or when rounding allows no progress; and the bounds hold in each case.

#include "convex/core/gjk.h"

#include "math/tolerance.h"

// The result is a float: bounds closer than a rounding of one are equal.
#define BOUND_GAP ((double)TL_FLOAT_ROUNDING)

// A point of A - B is a difference of two rotated points: less than 16 roundings of their size.
#define GJK_POINT_ERROR TL_DOUBLE_GAMMA(16)

static bool start_from_cache(tl_minkowski *pair, const tl_simplex_cache *cache, tl_simplex *simplex)
{
    simplex->count = cache->count < 4 ? cache->count : 4;
    return tl_minkowski_simplex(pair, cache, simplex->points);
}

static void store_cache(const tl_simplex *simplex, tl_simplex_cache *cache)
{
    cache->count = simplex->count;
    for (uint32_t i = 0; i < simplex->count; i++) {
        cache->vertex_a[i] = simplex->points[i].vertex_a;
        cache->vertex_b[i] = simplex->points[i].vertex_b;
    }
}

static void start_walk(tl_minkowski *pair, const tl_simplex_cache *cache, tl_gjk *gjk)
{
    gjk->lower = -(double)INFINITY;
    gjk->normal = tl_vec3d_make(0.0, 0.0, 0.0);
    gjk->overlap = false;
    gjk->iterations = 0;
    if (cache == NULL || !start_from_cache(pair, cache, &gjk->simplex)) {
        tl_minkowski_place_hulls(pair);
        tl_minkowski_support(pair, tl_vec3d_neg(tl_minkowski_offset(pair)), &gjk->simplex.points[0]);
        gjk->simplex.count = 1;
        gjk->simplex.weights[0] = 1.0;
        gjk->nearest = gjk->simplex.points[0].w;
    } else {
        tl_minkowski_set_hints(pair, gjk->simplex.points[0].vertex_a, gjk->simplex.points[0].vertex_b);
        gjk->nearest = tl_simplex_nearest(&gjk->simplex);
    }
    gjk->upper = tl_vec3d_length(gjk->nearest);
}

// One step: false when the walk is over.
static bool gjk_step(tl_minkowski *pair, double decide_at, tl_gjk *gjk)
{
    gjk->status = TL_CONVEX_CONVERGED;
    double noise = GJK_POINT_ERROR * pair->scale; // distances below this cannot be told from zero
    if (gjk->simplex.count == 4 || gjk->upper <= noise) {
        gjk->overlap = true;
        gjk->upper = gjk->lower = 0.0;
        gjk->nearest = tl_vec3d_make(0.0, 0.0, 0.0);
        return false;
    }
    if (gjk->upper <= decide_at) {
        return false;
    }
    tl_minkowski_point *point = &gjk->simplex.points[gjk->simplex.count];
    tl_minkowski_support(pair, tl_vec3d_neg(gjk->nearest), point);
    double lower = tl_vec3d_dot(gjk->nearest, point->w) / gjk->upper - pair->direction_error - noise;
    if (lower > gjk->lower) {
        // The nearest point of a curved shape settles before its direction does: the best one is kept.
        gjk->lower = lower;
        gjk->normal = tl_vec3d_scale(gjk->nearest, -1.0 / gjk->upper);
    }
    if (decide_at >= 0.0 && gjk->lower > decide_at) {
        return false;
    }
    if (gjk->upper - gjk->lower <= BOUND_GAP * gjk->upper || tl_simplex_holds(&gjk->simplex, point)) {
        return false;
    }
    gjk->simplex.count++;
    tl_simplex_point nearest;
    tl_simplex_solve_last(&gjk->simplex, &nearest);
    double upper = sqrt(nearest.distance_sq);
    if (!(upper < gjk->upper) || upper < gjk->lower) {
        gjk->simplex.count--; // the old points and weights are still there
        // No progress; or less than is proven, as by a tetrahedron so thin that rounding finds the origin inside, of
        // shapes that a support has shown to be apart: the bounds hold, the simplex does not. Bounds closer than a
        // float rounding of the coordinates are the end, else it is a bad simplex.
        double gap = BOUND_GAP * (gjk->upper + pair->scale) + 4.0 * pair->direction_error;
        gjk->status = gjk->upper - gjk->lower <= gap ? TL_CONVEX_CONVERGED : TL_CONVEX_DEGENERATE;
        return false;
    }
    tl_simplex_keep(&gjk->simplex, &nearest);
    gjk->nearest = nearest.point;
    gjk->upper = upper;
    return true;
}

void tl_gjk_run(tl_minkowski *pair, tl_simplex_cache *cache, double decide_at, tl_gjk *gjk)
{
    start_walk(pair, cache, gjk);
    while (gjk_step(pair, decide_at, gjk)) {
        tl_minkowski_place_hulls(pair);
        if (++gjk->iterations == TL_MAX_GJK_ITERATIONS) {
            gjk->status = TL_CONVEX_ITERATIONS;
            break;
        }
    }
    gjk->lower = gjk->lower > 0.0 ? gjk->lower : 0.0;
    if (cache != NULL) {
        store_cache(&gjk->simplex, cache);
    }
}
