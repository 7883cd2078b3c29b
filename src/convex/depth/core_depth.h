// SPDX-License-Identifier: MIT
//
// The penetration depth of two cores, the shapes without their radii.

#ifndef TALUS_SRC_CONVEX_CORE_DEPTH_H
#define TALUS_SRC_CONVEX_CORE_DEPTH_H

#include "convex/core/gjk.h"

typedef struct tl_core_depth {
    tl_vec3d normal; // unit, of A - B: moving B along it separates the shapes
    double upper, lower;
    tl_vec3d on_a, on_b; // witnesses, A's frame
    tl_convex_status status;
    uint32_t iterations;
} tl_core_depth;

// From the simplex that GJK ended with when it found that the cores overlap. `depth_out->upper` bounds what supports
// say, whose directions are rounded: the pair's direction_error comes on top of it.
void tl_core_depth_find(tl_minkowski *pair, const tl_gjk *gjk, tl_polytope_cache *cache, tl_core_depth *depth_out);

#endif
