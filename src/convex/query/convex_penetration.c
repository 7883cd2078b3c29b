// SPDX-License-Identifier: MIT
//
// Penetration of rounded shapes: while the cores are apart, the radii less their distance (GJK); when the cores
// overlap, the radii plus the cores' depth (EPA).

#include "convex/depth/core_depth.h"

#include "base/assert.h"
#include "convex/depth/polytope.h"
#include "math/tolerance.h"

#include <string.h>

static_assert(TL_MAX_EPA_ITERATIONS == TL_POLYTOPE_VERTICES - 4, "each iteration adds a vertex to the first four");

// What both ways end with: the cores' depth and its bounds, negative when the cores are apart, and witnesses on them.
typedef struct core_penetration {
    double depth, lower, upper;
    tl_vec3d normal, on_a, on_b;
} core_penetration;

static void add_radii(const tl_minkowski *pair, const core_penetration *cores, tl_penetration *out)
{
    double radius_a = (double)pair->a->radius, radius_b = (double)pair->b->radius;
    double radii = radius_a + radius_b;
    out->overlap = true;
    out->depth = (float)(radii + cores->depth);
    out->lower_bound =
        radii + cores->lower > 0.0 ? (float)((radii + cores->lower) * (1.0 - TL_FLOAT_OUTWARD)) : 0.0f; // rounded down
    out->upper_bound = (float)((radii + cores->upper) * (1.0 + TL_FLOAT_OUTWARD));                      // and up
    out->normal = tl_vec3d_to_float(tl_frame_rotate(&pair->a_to_world, cores->normal));
    out->point_a = tl_minkowski_to_world(pair, tl_vec3d_mul_add(cores->on_a, cores->normal, radius_a));
    out->point_b = tl_minkowski_to_world(pair, tl_vec3d_mul_add(cores->on_b, cores->normal, -radius_b));
}

bool tl_convex_penetration(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                           tl_simplex_cache *cache, tl_penetration *penetration_out)
{
    return tl_convex_penetration_within(a, pose_a, b, pose_b, cache, 0, penetration_out);
}

bool tl_convex_penetration_within(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                                  tl_simplex_cache *cache, uint32_t max_steps, tl_penetration *penetration_out)
{
    TL_ASSERT(a != NULL && b != NULL && penetration_out != NULL);
    tl_minkowski pair;
    memset(penetration_out, 0, sizeof *penetration_out);
    if (!tl_minkowski_init(&pair, a, &pose_a, b, &pose_b)) {
        penetration_out->status = TL_CONVEX_NOT_FINITE;
        return false;
    }
    pair.depth_steps = max_steps > 0 ? max_steps : UINT32_MAX;
    double radii = (double)a->radius + (double)b->radius;
    tl_gjk gjk;
    tl_gjk_run(&pair, cache, -1.0, &gjk);
    penetration_out->status = gjk.status;
    penetration_out->iterations = gjk.iterations;
    if (gjk.overlap) {
        tl_core_depth depth;
        tl_core_depth_find(&pair, &gjk, NULL, &depth);
        penetration_out->status = depth.status;
        penetration_out->iterations += depth.iterations;
        core_penetration cores = { depth.upper,  depth.lower, depth.upper + pair.direction_error,
                                   depth.normal, depth.on_a,  depth.on_b };
        add_radii(&pair, &cores, penetration_out);
    } else if (gjk.upper <= radii) {
        core_penetration cores = {
            .depth = -gjk.upper, .lower = -gjk.upper, .upper = -gjk.lower, .normal = gjk.normal
        };
        tl_simplex_witness(&gjk.simplex, &cores.on_a, &cores.on_b);
        add_radii(&pair, &cores, penetration_out);
    }
    return penetration_out->overlap;
}
