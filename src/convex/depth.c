// SPDX-License-Identifier: MIT
//
// Depth: EPA, which is done after ten or twenty steps with nearly every pair, and what is left by it to a search that
// is slower and has no limit of size.

#include "convex/depth.h"

#include "convex/direction_search.h"
#include "convex/epa.h"

void tl_depth_find(tl_pair *pair, const tl_gjk *gjk, tl_depth *depth)
{
    tl_epa_run(pair, gjk, depth);
    if (depth->status != TL_CONVEX_CONVERGED) {
        tl_direction_search(pair, depth);
    }
    depth->upper = depth->upper > 0.0 ? depth->upper : 0.0;
}
