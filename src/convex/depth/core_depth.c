// SPDX-License-Identifier: MIT
//
// Penetration depth of two cores: EPA, which converges in ten or twenty steps for nearly every pair; for the others a
// search over directions, which is slower and has no limit of size.

#include "convex/depth/core_depth.h"

#include "convex/depth/direction_search.h"
#include "convex/depth/epa.h"

void tl_core_depth_find(tl_minkowski *pair, const tl_gjk *gjk, tl_polytope_cache *cache, tl_core_depth *depth)
{
    tl_epa_run(pair, gjk, cache, depth);
    if (depth->status != TL_CONVEX_CONVERGED && depth->iterations < pair->depth_steps) {
        tl_direction_search(pair, depth);
    }
    depth->upper = depth->upper > 0.0 ? depth->upper : 0.0;
}
