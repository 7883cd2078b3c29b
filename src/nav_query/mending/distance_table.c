// SPDX-License-Identifier: MIT
//
// Filling the table of all-pairs shortest distances (corner_distances.c): a Dijkstra search from each corner vertex.

#include "nav_query/mending/distance_table.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/prepared/dijkstra.h"

tl_result tl_nav_bake_corner_distances(const tl_allocator *allocator, const tl_host *host,
                                       tl_nav_visibility_graph *graph)
{
    uint32_t n = graph->vertex_room;
    uint64_t pairs = (uint64_t)n * n;
    tl_nav_dijkstra lengths;
    tl_stage stage;
    TL_TRY(tl_stage_begin(&stage, host, "distances", n));
    TL_TRY(tl_nav_dijkstra_init(allocator, graph, &stage, &lengths));
    graph->table = tl_allocate_array(allocator, pairs, sizeof *graph->table);
    graph->table_next = tl_allocate_array(allocator, pairs, sizeof *graph->table_next);
    tl_result result = graph->table != NULL && graph->table_next != NULL ? TL_OK : TL_ERR_MEMORY;
    for (uint32_t i = 0; i < n && result == TL_OK; i++) {
        result = tl_nav_dijkstra_run(&lengths, &i, 1);
        for (uint32_t k = 0; k < n; k++) {
            graph->table[(uint64_t)i * n + k] = (float)lengths.length[k];
            graph->table_next[(uint64_t)i * n + k] = (uint16_t)lengths.before[k];
        }
        result = result == TL_OK ? tl_stage_add(&stage, 1) : result;
    }
    tl_nav_dijkstra_free(allocator, &lengths);
    return result == TL_OK ? tl_stage_end(&stage) : result;
}
