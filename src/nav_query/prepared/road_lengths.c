// SPDX-License-Identifier: MIT
//
// Lengths along roads to all bends: Dijkstra with a binary heap, in which a bend stands once for each time its length
// fell. Equal lengths go to the lower bend, so that the same ways are found everywhere.
// Source: Dijkstra, A note on two problems in connexion with graphs, 1959.

#include "nav_query/prepared/road_lengths.h"

#include "base/arena.h"

#include <math.h>
#include <string.h>

tl_result tl_nav_road_lengths_make(const tl_allocator *allocator, const tl_nav_roads *roads,
                                   tl_nav_road_lengths *lengths_out)
{
    memset(lengths_out, 0, sizeof *lengths_out);
    lengths_out->roads = roads;
    lengths_out->length = tl_allocate_array(allocator, roads->bend_count, sizeof *lengths_out->length);
    lengths_out->before = tl_allocate_array(allocator, roads->bend_count, sizeof *lengths_out->before);
    lengths_out->heap =
        tl_allocate_array(allocator, (uint64_t)roads->bend_count + roads->road_count, sizeof *lengths_out->heap);
    lengths_out->settled = tl_allocate_array(allocator, roads->bend_count, sizeof *lengths_out->settled);
    if (lengths_out->length == NULL || lengths_out->before == NULL || lengths_out->settled == NULL ||
        lengths_out->heap == NULL) {
        tl_nav_road_lengths_free(allocator, lengths_out);
        return TL_ERR_MEMORY;
    }
    return TL_OK;
}

void tl_nav_road_lengths_free(const tl_allocator *allocator, tl_nav_road_lengths *lengths)
{
    const tl_nav_roads *roads = lengths->roads;
    tl_release_array(allocator, lengths->length, roads->bend_count, sizeof *lengths->length);
    tl_release_array(allocator, lengths->before, roads->bend_count, sizeof *lengths->before);
    tl_release_array(allocator, lengths->settled, roads->bend_count, sizeof *lengths->settled);
    tl_release_array(allocator, lengths->heap, (uint64_t)roads->bend_count + roads->road_count, sizeof *lengths->heap);
}

void tl_nav_measure_roads(tl_nav_road_lengths *lengths, const uint32_t *sources, uint32_t source_count)
{
    const tl_nav_roads *roads = lengths->roads;
    for (uint32_t i = 0; i < roads->bend_count; i++) {
        lengths->length[i] = (double)INFINITY;
    }
    for (uint32_t i = 0; i < source_count; i++) {
        lengths->length[sources[i]] = 0.0;
        lengths->before[sources[i]] = sources[i];
        tl_nav_push_bend(lengths, 0.0, sources[i]);
    }
    lengths->settled_count = 0;
    while (lengths->heap_count > 0) {
        tl_nav_open_bend next = tl_nav_pop_bend(lengths);
        if (next.length > lengths->length[next.bend]) {
            continue;
        }
        lengths->settled[lengths->settled_count++] = next.bend;
        const tl_nav_bend *bend = &roads->bends[next.bend];
        for (uint32_t k = bend[0].first_road; k < bend[1].first_road; k++) {
            const tl_nav_road *road = &roads->roads[k];
            double length = next.length + tl_nav_road_length(bend, road);
            if (length < lengths->length[road->to]) {
                lengths->length[road->to] = length;
                lengths->before[road->to] = next.bend;
                tl_nav_push_bend(lengths, length, road->to);
            }
        }
    }
}
