// SPDX-License-Identifier: MIT
//
// The cheapest way known to each vertex where an exact search has turned: a hash table with linear probing. Entries of
// earlier searches are told by their generation, so nothing is ever cleared. An eighth of the table stays empty: there
// every probe ends.

#ifndef TALUS_SRC_NAV_QUERY_ROOT_TABLE_H
#define TALUS_SRC_NAV_QUERY_ROOT_TABLE_H

#include "base/hash.h"
#include "math/tolerance.h"
#include "nav_query/search/query.h"

#include <math.h>

struct tl_nav_root {
    uint64_t number;
    uint32_t generation; ///< of the search that wrote the entry
    union {
        float cost;    ///< metres from the start
        uint32_t stop; ///< of a corner vertex
    };
    // Of a corner that is turned at: what `cost` lost when it was rounded, and the root from which that way came.
    float cost_rest, from_x, from_z;
};

/// Forgets all entries. Those of a table whose generations have run out would look like new ones: they are cleared.
static inline void tl_nav_next_generation(tl_nav_query *query)
{
    query->repeat_count = 0;
    query->root_count = 0;
    if (++query->generation == 0) {
        for (uint32_t i = 0; i <= query->root_mask; i++) {
            query->roots[i].generation = 0;
        }
        query->generation = 1;
    }
}

/// The entry of a number, or the empty one where it belongs; `*found_out` says which.
static inline tl_nav_root *tl_nav_probe_roots(const tl_nav_query *query, uint64_t number, bool *found_out)
{
    // Numbers of one tile follow one another, and so do their places. Those of corners have high bits.
    uint64_t place = number < (uint64_t)1 << 32 ? number : tl_hash_mix(number);
    for (;; place++) {
        tl_nav_root *root = &query->roots[place & query->root_mask];
        *found_out = root->generation == query->generation;
        if (!*found_out || root->number == number) {
            return root;
        }
    }
}

/// The entry of a number; `*found_out` says whether it is there already. NULL: it is not, and the table is full.
static inline tl_nav_root *tl_nav_find_root(tl_nav_query *query, uint64_t number, bool *found_out)
{
    tl_nav_root *root = tl_nav_probe_roots(query, number, found_out);
    if (!*found_out) {
        if (query->root_count >= query->root_mask - query->root_mask / 8) {
            return NULL;
        }
        query->root_count++;
        root->number = number;
        root->generation = query->generation;
    }
    return root;
}

typedef enum tl_nav_root_rank {
    TL_NAV_ROOT_NO_ENTRY, ///< the table is full
    TL_NAV_ROOT_WORSE,
    TL_NAV_ROOT_AS_CHEAP, ///< as another way, within the rounding of the float in which costs are kept
    TL_NAV_ROOT_CHEAPER,  ///< than all ways before
    TL_NAV_ROOT_FIRST
} tl_nav_root_rank;

/// How a way to the vertex of this number compares with those that are known; it is then one of them.
static inline tl_nav_root_rank tl_nav_root_rank_of(tl_nav_query *query, uint64_t number, double cost)
{
    bool found = false;
    tl_nav_root *root = tl_nav_find_root(query, number, &found);
    const double slack = 2.0 * (double)TL_FLOAT_ROUNDING;
    if (root == NULL) {
        return TL_NAV_ROOT_NO_ENTRY;
    }
    if (found && cost > (double)root->cost * (1.0 + slack)) {
        return TL_NAV_ROOT_WORSE;
    }
    bool is_as_cheap = found && cost >= (double)root->cost * (1.0 - slack);
    root->cost = found && root->cost < (float)cost ? root->cost : (float)cost;
    return is_as_cheap ? TL_NAV_ROOT_AS_CHEAP : found ? TL_NAV_ROOT_CHEAPER : TL_NAV_ROOT_FIRST;
}

/// What the cheapest way known costs that has turned at the vertex of this number, rounded up. INFINITY: none has.
static inline double tl_nav_known_root_cost(const tl_nav_query *query, uint64_t number)
{
    bool found = false;
    const tl_nav_root *root = tl_nav_probe_roots(query, number, &found);
    return found ? (double)root->cost * (1.0 + 2.0 * (double)TL_FLOAT_ROUNDING) : (double)INFINITY;
}

/// Whether no way as cheap, within that rounding, has come to this number yet. False, and `*full_out` is set, when the
/// table is full.
static inline bool tl_nav_root_is_first(tl_nav_query *query, uint64_t number, double cost, bool *full_out)
{
    bool found = false;
    tl_nav_root *root = tl_nav_find_root(query, number, &found);
    *full_out = root == NULL;
    if (root == NULL || (found && cost >= (double)root->cost * (1.0 - 2.0 * (double)TL_FLOAT_ROUNDING))) {
        return false;
    }
    root->cost = (float)cost;
    return true;
}

#endif
