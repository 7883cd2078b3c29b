// SPDX-License-Identifier: MIT
//
// What the stages of a decomposition share.

#ifndef TALUS_SRC_DECOMPOSE_DECOMPOSER_H
#define TALUS_SRC_DECOMPOSE_DECOMPOSER_H

#include "decompose/concavity_proof.h"
#include "decompose/distance_grid.h"
#include "decompose/part.h"

typedef struct tl_decomposer {
    const tl_decompose_def *def; ///< its allocator is metered
    const tl_allocator *allocator;
    tl_distance_grid grid;
    double tolerance;
    float thickness; ///< of hulls of flat parts
    tl_part *parts;  ///< [part_count], an array of the allocator
    uint32_t part_count;
    uint64_t part_capacity;
    tl_decompose_report *report;
} tl_decomposer;

/// The hull of points; flat ones get the decomposer's thickness. Errors as in tl_hull_bake.
tl_result tl_decomposer_bake_hull(const tl_decomposer *d, const tl_vec3 *points, uint32_t count, tl_hull **hull_out);

/// Whether a hull keeps the tolerance; `concavity_out` is then the bound, else what some point reaches.
tl_result tl_decomposer_judge(const tl_decomposer *d, const tl_hull *hull, bool *holds_out, double *concavity_out);

/// Adds a part, which the decomposer then owns. TL_ERR_MEMORY, TL_ERR_LIMIT: the part was not taken.
tl_result tl_decomposer_add(tl_decomposer *d, const tl_part *part);

/// Cuts the parts until every part keeps the tolerance, or cannot be cut.
tl_result tl_decomposer_cut(tl_decomposer *d);

/// Merges parts whose common hull keeps the tolerance, then others until there are no more than the def's max_parts.
tl_result tl_decomposer_merge(tl_decomposer *d);

#endif
