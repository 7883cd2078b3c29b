// SPDX-License-Identifier: MIT
//
// Lengths along roads from any bends to all others (road_lengths.c).

#ifndef TALUS_SRC_NAV_QUERY_ROAD_LENGTHS_H
#define TALUS_SRC_NAV_QUERY_ROAD_LENGTHS_H

#include "nav_query/roads.h"

typedef struct tl_nav_open_bend {
    double length;
    uint32_t bend;
} tl_nav_open_bend;

typedef struct tl_nav_road_lengths {
    const tl_nav_roads *roads;
    double *length;         ///< by bend: metres; INFINITY: no way
    uint32_t *before;       ///< by bend: the one before it on the way there; itself for a source
    tl_nav_open_bend *heap; ///< [road_count + bend_count]: an entry each time a length falls
    uint32_t heap_count;
} tl_nav_road_lengths;

/// TL_ERR_MEMORY: nothing is left to free.
tl_result tl_nav_road_lengths_make(const tl_allocator *allocator, const tl_nav_roads *roads,
                                   tl_nav_road_lengths *lengths_out);
void tl_nav_road_lengths_free(const tl_allocator *allocator, tl_nav_road_lengths *lengths);

/// Measures from `source_count` bends, from the nearest of them to each.
void tl_nav_measure_roads(tl_nav_road_lengths *lengths, const uint32_t *sources, uint32_t source_count);

#endif
