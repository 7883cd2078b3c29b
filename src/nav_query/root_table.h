// SPDX-License-Identifier: MIT
//
// The cheapest way known to each vertex where an exact search has turned: a hash table with linear probing. Entries of
// earlier searches are told by their generation, so nothing is ever cleared.

#ifndef TALUS_SRC_NAV_QUERY_ROOT_TABLE_H
#define TALUS_SRC_NAV_QUERY_ROOT_TABLE_H

#include "base/hash.h"
#include "math/tolerance.h"
#include "nav_query/node_pool.h"

/// Whether `cost` is no worse than any known way to the vertex of this number, within the rounding of the float in
/// which it is kept; it is then the cheapest known.
static inline bool tl_nav_root_improves(tl_nav_query *query, uint64_t number, double cost)
{
    // Numbers of one tile follow one another, and so do their places. Those of a filtered search have high bits.
    uint64_t place = number < (uint64_t)1 << 32 ? number : tl_hash_mix(number);
    for (;; place++) {
        tl_nav_root *root = &query->roots[place & query->root_mask];
        if (root->generation != query->generation) {
            root->number = number;
            root->generation = query->generation;
            root->cost = (float)cost;
            return true;
        }
        if (root->number == number) {
            if (cost > (double)root->cost * (1.0 + 2.0 * (double)TL_FLOAT_ROUNDING)) {
                return false;
            }
            root->cost = (float)cost < root->cost ? (float)cost : root->cost;
            return true;
        }
    }
}

#endif
