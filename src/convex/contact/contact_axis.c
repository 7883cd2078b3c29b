// SPDX-License-Identifier: MIT
//
// The cached path: the normal that was proven to be that of least depth serves again while the pair has hardly moved.
//
// The depth is the least value of A - B's support function over all directions. When no point of B moves by more than m
// seen from A, no support value falls by more than m, so the depth is at least the proven one less m. The support
// along the old normal bounds it from above. When both meet within the slack, no other normal is shallower by more: two
// support queries instead of a search. Motion is counted from the proof, not from the last call, so it does not add up
// unseen. The normal is tried as A carries it, and as B does, since either may own the face. What has moved by more
// than the slack is left to the polytope that was kept (polytope_keep.c), where there is one, and to the axes of boxes.
// So is the bound from below where the shapes have moved by less, but deeper into one another.

#include "convex/contact/contact_axis.h"

#include "convex/core/farthest.h"
#include "math/tolerance.h"

// A pose kept in floats, and support points: roundings of their size.
#define KEPT_POSE_ERROR (4.0 * (double)TL_FLOAT_ROUNDING)

// Of a hull of so many vertices each one's motion is looked at. A ball around them all takes less time, but tells of
// half as much again.
#define MOVED_VERTICES 32u

// A ball around the points of a shape. False for shapes whose extent is not known.
static bool ball_of(const tl_convex *shape, tl_vec3d *middle, double *reach)
{
    tl_vec3d p = tl_vec3d_from(shape->corners[0]), q = tl_vec3d_from(shape->corners[1]);
    switch (shape->kind) {
    case TL_CONVEX_HULL:
        p = tl_vec3d_from(shape->hull->bounds.min);
        q = tl_vec3d_from(shape->hull->bounds.max);
        *middle = tl_vec3d_scale(tl_vec3d_add(p, q), 0.5);
        *reach = 0.5 * tl_vec3d_length(tl_vec3d_sub(q, p));
        return true;
    case TL_CONVEX_BOX:
        *middle = p;
        *reach = tl_vec3d_length(q);
        return true;
    case TL_CONVEX_CYLINDER:
    case TL_CONVEX_CONE:
        *middle = tl_vec3d_scale(tl_vec3d_add(p, q), 0.5);
        *reach = 0.5 * tl_vec3d_length(tl_vec3d_sub(q, p)) + (double)shape->corners[2].x;
        return true;
    default:
        return false;
    }
}

// What has changed between the kept pose of B and the one now, seen from A: the rotation, which is no rotation, and the
// shift.
static tl_frame pose_change(const tl_minkowski *pair, const tl_contact_cache *cache)
{
    const float *k = cache->b_to_a;
    tl_frame change;
    for (int i = 0; i < 3; i++) {
        const tl_vec3d kept = { (double)k[3 * i], (double)k[3 * i + 1], (double)k[3 * i + 2] };
        change.rows[i] = tl_vec3d_sub(pair->b_to_a.rows[i], kept);
    }
    change.origin = tl_vec3d_sub(pair->b_to_a.origin, tl_vec3d_make((double)k[9], (double)k[10], (double)k[11]));
    return change;
}

// How far a point of B has moved at most, seen from A; infinite when more than `limit`.
static double motion_since(const tl_minkowski *pair, const tl_contact_cache *cache, double limit)
{
    const tl_convex *b = pair->b;
    const tl_frame change = pose_change(pair, cache);
    if (b->kind == TL_CONVEX_HULL && b->hull->vertex_count >= 4 && b->hull->vertex_count <= MOVED_VERTICES) {
        const double rounding = KEPT_POSE_ERROR * (tl_hull_size(b->hull) + pair->origin_size);
        const tl_vec3 *vertices = tl_hull_vertices(b->hull);
        if (tl_vec3d_length(tl_frame_point(&change, tl_vec3d_from(vertices[0]))) + rounding > limit) {
            return (double)INFINITY;
        }
        return sqrt(tl_farthest_image_sq(vertices, b->hull->vertex_count, &change)) + rounding;
    }
    tl_vec3d middle;
    double reach;
    if (!ball_of(b, &middle, &reach)) {
        return (double)INFINITY;
    }
    // A difference of rotations has two singular values that are equal, and one that is zero.
    const double turn_sq =
        0.5 * (tl_vec3d_dot(change.rows[0], change.rows[0]) + tl_vec3d_dot(change.rows[1], change.rows[1]) +
               tl_vec3d_dot(change.rows[2], change.rows[2]));
    const double rounding = KEPT_POSE_ERROR * (tl_vec3d_size(middle) + reach + pair->origin_size);
    return tl_vec3d_length(tl_frame_point(&change, middle)) + sqrt(turn_sq) * reach + rounding;
}

// Of a unit vector that was rounded to floats: its length squared is 1 + e, and 3/8 e^2 is less than double rounding.
static tl_vec3d unit(tl_vec3 v)
{
    tl_vec3d d = tl_vec3d_from(v);
    return tl_vec3d_scale(d, 1.5 - 0.5 * tl_vec3d_dot(d, d));
}

tl_axis_trial tl_axis_try(tl_minkowski *pair, const tl_contact_cache *cache, double slack, tl_deepest *out)
{
    if (cache->has_axis == 0) {
        return TL_AXIS_GONE;
    }
    const double motion = motion_since(pair, cache, slack), least = (double)cache->proven_depth - motion;
    if (motion > slack) {
        return TL_AXIS_GONE;
    }
    // As A carries it, and as B does.
    const tl_vec3d normals[2] = { unit(cache->axis_a), tl_frame_rotate(&pair->b_to_a, unit(cache->axis_b)) };
    double depths[2];
    tl_minkowski_reach_of_two(pair, normals, depths);
    const int best = depths[0] <= depths[1] ? 0 : 1;
    out->normal = normals[best];
    out->separation = -depths[best];
    out->lower_depth = least;
    out->has_points = false;
    out->features[0] = out->features[1] = 0;
    return least > 0.0 && depths[best] - least <= slack ? TL_AXIS_HOLDS : TL_AXIS_NEAR;
}

void tl_axis_store(const tl_minkowski *pair, const tl_deepest *deepest, tl_contact_cache *cache)
{
    cache->has_axis = deepest->lower_depth > 0.0 ? 1 : 0;
    cache->axis_a = tl_vec3d_to_float(deepest->normal);
    cache->axis_b = tl_vec3d_to_float(tl_frame_rotate_back(&pair->b_to_a, deepest->normal));
    cache->proven_depth = (float)(deepest->lower_depth * (1.0 - (double)TL_FLOAT_OUTWARD));
    const tl_vec3d *rows = pair->b_to_a.rows, origin = pair->b_to_a.origin;
    const double pose[12] = { rows[0].x, rows[0].y, rows[0].z, rows[1].x, rows[1].y, rows[1].z,
                              rows[2].x, rows[2].y, rows[2].z, origin.x,  origin.y,  origin.z };
    for (int i = 0; i < 12; i++) {
        cache->b_to_a[i] = (float)pose[i];
    }
}
