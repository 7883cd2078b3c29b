// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_CONVEX_GJK_H
#define TALUS_SRC_CONVEX_GJK_H

#include "convex/core/simplex.h"

typedef struct tl_gjk {
    tl_simplex simplex;
    tl_vec3d nearest;    // of the simplex; zero when the cores overlap
    double upper, lower; // bounds of the distance of the cores
    tl_vec3d normal;     // from A to B, unit: the cores are `lower` apart along it; no use when they overlap
    uint32_t iterations;
    bool overlap; // of the cores
    tl_convex_status status;
} tl_gjk;

// Runs until the bounds meet, or, with decide_at >= 0, until it is known on which side of decide_at the distance lies.
void tl_gjk_run(tl_minkowski *pair, tl_simplex_cache *cache, double decide_at, tl_gjk *gjk);

#endif
