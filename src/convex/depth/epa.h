// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_CONVEX_EPA_H
#define TALUS_SRC_CONVEX_EPA_H

#include "convex/depth/core_depth.h"

// The depth of two cores that overlap, from the simplex that GJK ended with. The status says ITERATIONS when the
// polytope is full, and DEGENERATE when rounding stopped it.
void tl_epa_run(tl_minkowski *pair, const tl_gjk *gjk, tl_core_depth *depth);

#endif
