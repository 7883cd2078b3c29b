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

#include "convex/contact/contact_axis.h"

#include "math/tolerance.h"

// A pose kept in floats, and support points: roundings of their size.
#define KEPT_POSE_ERROR (4.0 * (double)TL_FLOAT_ROUNDING)

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

static double row_difference_sq(tl_vec3d row, const float *kept)
{
    double x = row.x - (double)kept[0], y = row.y - (double)kept[1], z = row.z - (double)kept[2];
    return x * x + y * y + z * z;
}

// How far a point of B has moved at most, seen from A.
static double motion_since(const tl_minkowski *pair, const tl_contact_cache *cache, tl_vec3d middle, double reach)
{
    const float *k = cache->b_to_a;
    double turn_sq = row_difference_sq(pair->b_to_a.rows[0], k) + row_difference_sq(pair->b_to_a.rows[1], k + 3) +
                     row_difference_sq(pair->b_to_a.rows[2], k + 6);
    tl_vec3d was = { (double)k[0] * middle.x + (double)k[1] * middle.y + (double)k[2] * middle.z + (double)k[9],
                     (double)k[3] * middle.x + (double)k[4] * middle.y + (double)k[5] * middle.z + (double)k[10],
                     (double)k[6] * middle.x + (double)k[7] * middle.y + (double)k[8] * middle.z + (double)k[11] };
    tl_vec3d is = tl_frame_point(&pair->b_to_a, middle);
    double rounding = KEPT_POSE_ERROR * (tl_vec3d_size(middle) + reach + tl_vec3d_size(is));
    return tl_vec3d_length(tl_vec3d_sub(is, was)) + sqrt(turn_sq) * reach + rounding;
}

// Of a unit vector that was rounded to floats: its length squared is 1 + e, and 3/8 e^2 is less than double rounding.
static tl_vec3d unit(tl_vec3 v)
{
    tl_vec3d d = tl_vec3d_from(v);
    return tl_vec3d_scale(d, 1.5 - 0.5 * tl_vec3d_dot(d, d));
}

bool tl_axis_holds(tl_minkowski *pair, const tl_contact_cache *cache, double slack, tl_deepest *out)
{
    tl_vec3d middle;
    double reach;
    if (cache->has_axis == 0 || !ball_of(pair->b, &middle, &reach)) {
        return false;
    }
    const double motion = motion_since(pair, cache, middle, reach), least = (double)cache->proven_depth - motion;
    // Once the pair has moved, a polytope or the axes of boxes take less than a trial, which would be mostly in vain.
    const bool shorter_way = cache->polytope.point_count > 0 || cache->has_axis == TL_AXIS_OF_BOXES;
    if (!(least > 0.0) || (motion > slack && shorter_way)) {
        return false;
    }
    // As A carries it, and as B does.
    const tl_vec3d normals[2] = { unit(cache->axis_a), tl_frame_rotate(&pair->b_to_a, unit(cache->axis_b)) };
    double depths[2];
    tl_minkowski_reach_of_two(pair, normals, depths);
    const int best = depths[0] <= depths[1] ? 0 : 1;
    if (!(depths[best] - least <= slack)) {
        return false;
    }
    out->normal = normals[best];
    out->separation = -depths[best];
    out->lower_depth = least;
    out->has_points = false;
    out->features[0] = out->features[1] = 0;
    return true;
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
