// SPDX-License-Identifier: MIT
//
// What corner vertices see, tile by tile: edges and reaches (corner_sights.c).

#ifndef TALUS_SRC_NAV_QUERY_CORNER_SIGHTS_H
#define TALUS_SRC_NAV_QUERY_CORNER_SIGHTS_H

#include "base/radix_sort.h"
#include "nav_query/mending/graph_changes.h"

/// Pairs of numbers, each as a key << 32 | value.
typedef struct tl_nav_pair_list {
    tl_sort_item *items;
    uint64_t count, capacity;
} tl_nav_pair_list;

/// TL_ERR_MEMORY.
tl_result tl_nav_add_pair(const tl_allocator *allocator, tl_nav_pair_list *list, uint32_t first, uint32_t second);
void tl_nav_free_pairs(const tl_allocator *allocator, tl_nav_pair_list *list);

/// What was seen in a mend.
typedef struct tl_nav_seen {
    tl_nav_pair_list edges;   ///< corner vertex, and one that it sees; both ways
    tl_nav_pair_list reaches; ///< corner vertex that has looked, and slot in which it has cones now
} tl_nav_seen;

/// Makes the edges and reaches of all tiles anew in which some changed: a corner vertex keeps its edges to those that
/// have not looked around, and has those that were seen besides. Sorts what was seen. TL_ERR_MEMORY, TL_ERR_LIMIT,
/// TL_ERR_CANCELLED: the graph can only be freed.
tl_result tl_nav_remake_sights(tl_nav_graph_changes *changes, tl_nav_seen *seen, tl_stage *stage);

#endif
