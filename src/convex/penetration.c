// SPDX-License-Identifier: MIT
//
// Depth of rounded shapes: the radii less the distance of the cores while these are apart, the cores' depth and the
// radii beyond.

#include "convex/depth.h"

#include "convex/polytope.h"
#include "math/tolerance.h"

#include <string.h>

static_assert(TL_MAX_EPA_ITERATIONS == TL_POLYTOPE_VERTICES - 4, "each iteration adds a vertex to the first four");

// What both ways end with: bounds of the cores' depth, negative when they are apart, and witnesses on the cores.
static void fill(const tl_pair *pair, double depth, double lower, double upper, tl_vec3d normal, tl_vec3d on_a,
                 tl_vec3d on_b, tl_penetration *out)
{
    double radius_a = (double)pair->a->radius, radius_b = (double)pair->b->radius;
    double radii = radius_a + radius_b;
    out->overlap = true;
    out->depth = (float)(radii + depth);
    out->lower_bound = radii + lower > 0.0 ? (float)((radii + lower) * (1.0 - TL_FLOAT_OUTWARD)) : 0.0f; // rounded down
    out->upper_bound = (float)((radii + upper) * (1.0 + TL_FLOAT_OUTWARD));                              // and up
    out->normal = tl_vec3d_to_float(tl_frame_rotate(&pair->a_to_world, normal));
    out->point_a = tl_pair_to_world(pair, tl_vec3d_mul_add(on_a, normal, radius_a));
    out->point_b = tl_pair_to_world(pair, tl_vec3d_mul_add(on_b, normal, -radius_b));
}

bool tl_convex_penetration(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                           tl_simplex_cache *cache, tl_penetration *penetration_out)
{
    tl_pair pair;
    tl_pair_init(&pair, a, pose_a, b, pose_b);
    double radii = (double)a->radius + (double)b->radius;
    tl_gjk gjk;
    memset(penetration_out, 0, sizeof *penetration_out);
    tl_gjk_run(&pair, cache, -1.0, &gjk);
    penetration_out->status = gjk.status;
    penetration_out->iterations = gjk.iterations;
    if (gjk.overlap) {
        tl_depth depth;
        tl_depth_find(&pair, &gjk, &depth);
        penetration_out->status = depth.status;
        penetration_out->iterations += depth.iterations;
        fill(&pair, depth.upper, depth.lower, depth.upper + pair.direction_error, depth.normal, depth.on_a, depth.on_b,
             penetration_out);
    } else if (gjk.upper <= radii) {
        tl_vec3d on_a, on_b;
        tl_simplex_witness(&gjk.simplex, &on_a, &on_b);
        fill(&pair, -gjk.upper, -gjk.upper, -gjk.lower, gjk.normal, on_a, on_b, penetration_out);
    }
    return penetration_out->overlap;
}
