// SPDX-License-Identifier: MIT
//
// Whether spatial splits pay: the tree is built with and without them, and the one that rays are expected to cost less
// is kept. Expected by the surface area heuristic: a line that meets the root meets a box in it in proportion to its
// surface. On 18 levels that expectation tells those where rays gain 4 to 25 per cent (arena maps, two-sided walls,
// large floors beside small props) from those where they gain nothing or lose 7, by splits that put pieces of a large
// floor into the leaves of small things that stand on it.
//
// Source: MacDonald, Booth, Heuristics for Ray Tracing Using Space Subdivision, 1990.

#include "base/assert.h"
#include "soup/bake/bvh_split.h"
#include "soup/bake/soup_bake.h"

// Splits take memory, so they must gain something: this share of the expected cost.
#define LEAST_GAIN 0.03

static double expected_cost(const tl_bvh *tree)
{
    return (double)TL_BVH_TRAVERSAL_COST * tree->inner_surface + tree->leaf_surface;
}

tl_result tl_bvh_build_better(const tl_bvh_input *input, tl_stage *stage, tl_arena arenas[2], tl_bvh *tree_out)
{
    TL_TRY(tl_bvh_build(input, stage, &arenas[0], tree_out));
    // Nothing was split: the other tree is the same.
    if (tree_out->ref_count == input->pair_count) {
        return TL_OK;
    }
    tl_bvh_input whole = *input;
    whole.split_budget = 0.0f;
    tl_bvh other;
    TL_TRY(tl_bvh_build(&whole, stage, &arenas[1], &other));
    bool pays = expected_cost(tree_out) <= (1.0 - LEAST_GAIN) * expected_cost(&other);
    tl_arena_free(&arenas[pays ? 1 : 0]);
    if (!pays) {
        *tree_out = other;
    }
    return TL_OK;
}
