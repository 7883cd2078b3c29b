// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_CONVEX_DIRECTION_SEARCH_H
#define TALUS_SRC_CONVEX_DIRECTION_SEARCH_H

#include "convex/depth/core_depth.h"

// Brings the bounds of a depth together, with the normal and the witnesses, from what EPA had to leave. The status says
// CONVERGED, or ITERATIONS when TL_MAX_DIRECTION_STEPS, or what is left of the pair's depth_steps, were not enough.
void tl_direction_search(tl_minkowski *pair, tl_core_depth *depth);

#endif
