// SPDX-License-Identifier: MIT
//
// The closest hit by the decision for every lane of every leaf, without the tree and the float filters.

#ifndef TALUS_TEST_RAY_WITHOUT_TREE_H
#define TALUS_TEST_RAY_WITHOUT_TREE_H

#include "soup/ray/ray_job.h"
#include "talus_test.h"

static inline bool test_decide_all_lanes(const tl_soup *soup, tl_ray_job *job)
{
    bool hit = false;
    for (uint64_t offset = 0; offset < soup->leaf_bytes;) {
        const tl_soup_leaf *packed = tl_soup_leaf_at(soup, offset);
        tl_leaf_view leaf = tl_view_leaf(packed);
        for (uint32_t lane = 0; lane < 2 * leaf.pair_count; lane++) {
            hit |= leaf.ids[lane] != TL_ID_NONE && tl_ray_decide(job, packed, lane);
        }
        offset += tl_leaf_size(leaf.pair_count);
    }
    return hit;
}

#endif
