// SPDX-License-Identifier: MIT
//
// Distance and overlap of rounded shapes: GJK on the cores, then the radii.

#include "convex/core/gjk.h"

#include "base/assert.h"
#include "math/tolerance.h"

#include <string.h>

void tl_convex_distance(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                        tl_simplex_cache *cache, tl_separation *separation_out)
{
    TL_ASSERT(a != NULL && b != NULL && separation_out != NULL);
    tl_minkowski pair;
    memset(separation_out, 0, sizeof *separation_out);
    if (!tl_minkowski_init(&pair, a, &pose_a, b, &pose_b)) {
        separation_out->status = TL_CONVEX_NOT_FINITE;
        return;
    }
    tl_gjk gjk;
    tl_gjk_run(&pair, cache, -1.0, &gjk);
    separation_out->status = gjk.status;
    separation_out->iterations = gjk.iterations;
    tl_vec3d on_a, on_b;
    tl_simplex_witness(&gjk.simplex, &on_a, &on_b);
    if (gjk.overlap) {
        separation_out->overlap = true;
        separation_out->point_a = separation_out->point_b = tl_minkowski_to_world(&pair, on_a);
        return;
    }
    const tl_vec3d normal = tl_vec3d_load_apart(&gjk.normal);
    double radii = (double)a->radius + (double)b->radius;
    separation_out->overlap = gjk.upper <= radii;
    separation_out->distance = gjk.upper > radii ? (float)(gjk.upper - radii) : 0.0f;
    separation_out->lower_bound = gjk.lower > radii ? (float)((gjk.lower - radii) * (1.0 - TL_FLOAT_OUTWARD)) : 0.0f;
    separation_out->point_a = tl_minkowski_to_world(&pair, tl_vec3d_mul_add(on_a, normal, (double)a->radius));
    separation_out->point_b = tl_minkowski_to_world(&pair, tl_vec3d_mul_add(on_b, normal, -(double)b->radius));
    separation_out->normal = tl_vec3d_to_float(tl_frame_rotate(&pair.a_to_world, normal));
}

bool tl_convex_overlap(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                       tl_simplex_cache *cache)
{
    TL_ASSERT(a != NULL && b != NULL);
    tl_minkowski pair;
    if (!tl_minkowski_init(&pair, a, &pose_a, b, &pose_b)) {
        return false;
    }
    double radii = (double)a->radius + (double)b->radius;
    tl_gjk gjk;
    tl_gjk_run(&pair, cache, radii, &gjk);
    return gjk.overlap || gjk.upper <= radii;
}
