// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_CONVEX_EPA_H
#define TALUS_SRC_CONVEX_EPA_H

#include "convex/depth/core_depth.h"
#include "math/tolerance.h"

// The result is a float in a world whose coordinates are: bounds closer than four roundings of the size are equal.
#define TL_EPA_DEPTH_GAP (4.0 * (double)TL_FLOAT_ROUNDING)

// The depth of two cores that overlap, from the simplex that GJK ended with. The status says ITERATIONS when the
// polytope is full, and DEGENERATE when rounding stopped it. `cache` may be NULL; it gets the polytope.
void tl_epa_run(tl_minkowski *pair, const tl_gjk *gjk, tl_polytope_cache *cache, tl_core_depth *depth);

// The same from the polytope of the last time. False when that did not lead to a proven depth.
bool tl_epa_resume(tl_minkowski *pair, tl_polytope_cache *cache, tl_core_depth *depth);

// polytope_hold.c
// Whether that polytope, which is one, proves the depth without a step, whose fields are set then.
bool tl_polytope_holds(tl_minkowski *pair, const tl_polytope_cache *cache, tl_core_depth *depth);

#endif
