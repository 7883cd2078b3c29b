// SPDX-License-Identifier: MIT
//
// The contact manifold of two shapes: the normal and depth of the distance or penetration query, and where faces rest
// on each other the corners of their common patch.
//
// No angle decides whether faces touch. The two most opposed faces are clipped to their common patch, and of its
// corners those count that are not much farther apart than the deepest point. That is one length, it gives a tilted box
// one edge and a flat one four corners, and it has no angle at which the number of contacts would jump for large faces
// but not for small ones.
//
// Where two edges cross in front of the faces, as corners of bodies do, no corner of the patch is as deep as their
// crossing. The deepest point is always a contact: the query's witness joins the corners then.

#include "convex/core_depth.h"

#include "base/assert.h"
#include "convex/face_patch.h"
#include "math/tolerance.h"

#include <string.h>

static void add_contact(const tl_minkowski *pair, tl_vec3d on_a, tl_vec3d on_b, tl_vec3d normal,
                        tl_contact_manifold *out)
{
    double radius_a = (double)pair->a->radius, radius_b = (double)pair->b->radius;
    tl_contact *contact = &out->contacts[out->count++];
    contact->point_a = tl_minkowski_to_world(pair, tl_vec3d_mul_add(on_a, normal, radius_a));
    contact->point_b = tl_minkowski_to_world(pair, tl_vec3d_mul_add(on_b, normal, -radius_b));
    contact->separation = (float)(tl_vec3d_dot(normal, tl_vec3d_sub(on_b, on_a)) - radius_a - radius_b);
}

// A corner of the patch within so many float roundings of the coordinates is the deepest point: sides are plane to
// eight roundings, and so are their planes.
#define DEEPEST_GAP (16.0 * (double)TL_FLOAT_ROUNDING)

// The deepest points of both cores.
typedef struct deepest_points {
    tl_vec3d on_a, on_b, normal;
    double separation;
} deepest_points;

static bool has_deepest(const tl_patch *patch, double separation, double gap)
{
    for (uint32_t i = 0; i < patch->count; i++) {
        if (patch->points[i].on_b - patch->points[i].on_a <= separation + gap) {
            return true;
        }
    }
    return false;
}

static void add_patch(const tl_minkowski *pair, const deepest_points *deepest, double limit, tl_contact_manifold *out)
{
    const tl_vec3d normal = deepest->normal;
    tl_face face_a, face_b;
    tl_patch patch;
    if (!tl_face_along(pair->a, NULL, normal, &face_a) ||
        !tl_face_along(pair->b, &pair->b_to_a, tl_vec3d_neg(normal), &face_b)) {
        return;
    }
    tl_patch_find(&face_a, &face_b, normal, limit, &patch);
    // One end of an edge is the deepest point itself.
    if (patch.count < 2 && (face_a.count == 2 || face_b.count == 2)) {
        return;
    }
    if (patch.count > 0 && !has_deepest(&patch, deepest->separation, DEEPEST_GAP * pair->scale)) {
        tl_patch_add_deepest(&patch, deepest->on_a, deepest->on_b);
    }
    for (uint32_t i = 0; i < patch.count; i++) {
        const tl_patch_point *p = &patch.points[i];
        tl_vec3d flat = tl_vec3d_mul_add(tl_vec3d_scale(patch.u, p->x), patch.v, p->y);
        add_contact(pair, tl_vec3d_mul_add(flat, normal, p->on_a), tl_vec3d_mul_add(flat, normal, p->on_b), normal,
                    out);
    }
}

uint32_t tl_convex_contacts(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                            const tl_contact_limits *limits, tl_simplex_cache *cache, tl_contact_manifold *manifold_out)
{
    TL_ASSERT(a != NULL && b != NULL && manifold_out != NULL);
    const double margin = limits != NULL ? (double)limits->margin : 0.0;
    const double tolerance = limits != NULL ? (double)limits->tolerance : 0.0;
    tl_minkowski pair;
    memset(manifold_out, 0, sizeof *manifold_out);
    if (!tl_minkowski_init(&pair, a, pose_a, b, pose_b) || isnan(margin) || isnan(tolerance)) {
        manifold_out->status = TL_CONVEX_NOT_FINITE;
        return 0;
    }
    double radii = (double)a->radius + (double)b->radius;
    tl_gjk gjk;
    tl_gjk_run(&pair, cache, -1.0, &gjk);
    manifold_out->status = gjk.status;
    deepest_points deepest;
    if (gjk.overlap) {
        tl_core_depth depth;
        tl_core_depth_find(&pair, &gjk, &depth);
        manifold_out->status = depth.status;
        deepest.normal = depth.normal;
        deepest.on_a = depth.on_a;
        deepest.on_b = depth.on_b;
        deepest.separation = -depth.upper;
    } else {
        if (gjk.upper - radii > margin) {
            return 0;
        }
        deepest.normal = gjk.normal;
        tl_simplex_witness(&gjk.simplex, &deepest.on_a, &deepest.on_b);
        deepest.separation = gjk.upper;
    }
    double limit = fmin(deepest.separation + tolerance, margin + radii);
    manifold_out->normal = tl_vec3d_to_float(tl_frame_rotate(&pair.a_to_world, deepest.normal));
    add_patch(&pair, &deepest, limit, manifold_out);
    if (manifold_out->count == 0) {
        add_contact(&pair, deepest.on_a, deepest.on_b, deepest.normal, manifold_out);
    }
    return manifold_out->count;
}
