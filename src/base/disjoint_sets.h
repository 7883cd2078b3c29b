// SPDX-License-Identifier: MIT
//
// Disjoint sets (union-find): which of n items belong together, as pairs are joined one by one.
//
// Each item points towards its set's root, and finding halves the way that it walks. The lower root always stays the
// root, so that the root is the lowest item of its set, whatever the order of the unions; that bounds nothing by
// itself, but with path halving a find is O(log n) amortized. Source: Tarjan, van Leeuwen 1984.

#ifndef TALUS_SRC_BASE_DISJOINT_SETS_H
#define TALUS_SRC_BASE_DISJOINT_SETS_H

#include <stdbool.h>
#include <stdint.h>

/// Every item is a set of its own. `parents` holds `count` items.
static inline void tl_disjoint_sets_init(uint32_t *parents, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        parents[i] = i;
    }
}

/// The lowest item of the set.
static inline uint32_t tl_disjoint_sets_find(uint32_t *parents, uint32_t item)
{
    while (parents[item] != item) {
        parents[item] = parents[parents[item]];
        item = parents[item];
    }
    return item;
}

/// Makes the sets of two items one. False: they were one already.
static inline bool tl_disjoint_sets_unite(uint32_t *parents, uint32_t a, uint32_t b)
{
    a = tl_disjoint_sets_find(parents, a);
    b = tl_disjoint_sets_find(parents, b);
    if (a < b) {
        parents[b] = a;
    } else {
        parents[a] = b;
    }
    return a != b;
}

#endif
