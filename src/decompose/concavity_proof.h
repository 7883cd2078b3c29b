// SPDX-License-Identifier: MIT
//
// How far a hull reaches beyond the body: a proven bound.

#ifndef TALUS_SRC_DECOMPOSE_CONCAVITY_PROOF_H
#define TALUS_SRC_DECOMPOSE_CONCAVITY_PROOF_H

#include "decompose/distance_grid.h"

/// What is asked of a proof. It ends when the bound is at most `enough`, when a point is found that lies `too_much` or
/// farther away, when the bound is within `precision` of a point's distance, or after `budget` distances.
typedef struct tl_concavity_goal {
    double enough, too_much, precision;
    uint32_t budget;
} tl_concavity_goal;

/// No point of the hull is farther from the body than `bound`; some point is as far as `reached`, but for noise.
typedef struct tl_concavity {
    double bound, reached;
} tl_concavity;

/// TL_ERR_MEMORY.
tl_result tl_concavity_prove(const tl_hull *hull, const tl_distance_grid *grid, const tl_concavity_goal *goal,
                             const tl_allocator *allocator, tl_concavity *concavity_out);

#endif
