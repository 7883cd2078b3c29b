// SPDX-License-Identifier: MIT
//
// Lengths along roads from any bends to all others (road_lengths.c).

#ifndef TALUS_SRC_NAV_QUERY_ROAD_LENGTHS_H
#define TALUS_SRC_NAV_QUERY_ROAD_LENGTHS_H

#include "nav_query/prepared/roads.h"

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
    uint32_t *settled; ///< bends that were reached, the nearest first
    uint32_t settled_count;
} tl_nav_road_lengths;

static inline double tl_nav_road_length(const tl_nav_bend *from, const tl_nav_road *road)
{
    double x = (double)road->x - (double)from->x;
    double z = (double)road->z - (double)from->z;
    return sqrt(x * x + z * z);
}

static inline bool tl_nav_open_before(tl_nav_open_bend a, tl_nav_open_bend b)
{
    return a.length < b.length || (a.length == b.length && a.bend < b.bend);
}

static inline void tl_nav_push_bend(tl_nav_road_lengths *s, double length, uint32_t bend)
{
    tl_nav_open_bend entry = { length, bend };
    uint32_t at = s->heap_count++;
    for (; at > 0 && tl_nav_open_before(entry, s->heap[(at - 1) / 2]); at = (at - 1) / 2) {
        s->heap[at] = s->heap[(at - 1) / 2];
    }
    s->heap[at] = entry;
}

/// The heap must not be empty.
static inline tl_nav_open_bend tl_nav_pop_bend(tl_nav_road_lengths *s)
{
    tl_nav_open_bend top = s->heap[0];
    tl_nav_open_bend last = s->heap[--s->heap_count];
    uint32_t at = 0;
    for (;;) {
        uint32_t child = 2 * at + 1;
        if (child >= s->heap_count) {
            break;
        }
        child += child + 1 < s->heap_count && tl_nav_open_before(s->heap[child + 1], s->heap[child]) ? 1 : 0;
        if (!tl_nav_open_before(s->heap[child], last)) {
            break;
        }
        s->heap[at] = s->heap[child];
        at = child;
    }
    s->heap[at] = last;
    return top;
}

/// TL_ERR_MEMORY: nothing is left to free.
tl_result tl_nav_road_lengths_make(const tl_allocator *allocator, const tl_nav_roads *roads,
                                   tl_nav_road_lengths *lengths_out);
void tl_nav_road_lengths_free(const tl_allocator *allocator, tl_nav_road_lengths *lengths);

/// Measures from `source_count` bends, from the nearest of them to each.
void tl_nav_measure_roads(tl_nav_road_lengths *lengths, const uint32_t *sources, uint32_t source_count);

#endif
