// SPDX-License-Identifier: MIT
//
// Filling the table of all-pairs shortest distances (corner_distances.c): a Dijkstra search from each corner vertex.

#include "nav_query/mending/distance_table.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/mending/dijkstra.h"

// Rows between two calls of progress.
enum { ROWS_A_CALL = 8 };

typedef struct table_job {
    tl_nav_visibility_graph *graph;
    tl_nav_dijkstra_team team;
} table_job;

static void fill_row(uint32_t vertex, uint32_t worker, void *user)
{
    table_job *job = user;
    const tl_nav_visibility_graph *graph = job->graph;
    const uint32_t room = graph->vertex_room;
    const tl_nav_dijkstra *search = tl_nav_dijkstra_run(&job->team, worker, &vertex, 1);
    for (uint32_t k = 0; search != NULL && k < room; k++) {
        graph->table[(uint64_t)vertex * room + k] = (float)search->length[k];
        graph->table_next[(uint64_t)vertex * room + k] = (uint16_t)search->before[k];
    }
}

tl_result tl_nav_bake_corner_distances(const tl_allocator *allocator, const tl_host *host,
                                       tl_nav_visibility_graph *graph)
{
    const uint32_t room = graph->vertex_room;
    const uint64_t pairs = (uint64_t)room * room;
    tl_stage stage;
    table_job job = { .graph = graph };
    TL_TRY(tl_stage_begin(&stage, host, "distances", room));
    TL_TRY(tl_nav_dijkstra_begin(allocator, graph, &stage, &job.team));
    graph->table = tl_allocate_array(allocator, pairs, sizeof *graph->table);
    graph->table_next = tl_allocate_array(allocator, pairs, sizeof *graph->table_next);
    tl_result result = TL_ERR_MEMORY;
    if (graph->table != NULL && graph->table_next != NULL) {
        result = tl_stage_run(&stage, fill_row, room, &job, ROWS_A_CALL, room);
        result = result == TL_OK ? tl_nav_dijkstra_result(&job.team) : result;
    }
    tl_nav_dijkstra_end(&job.team);
    return result == TL_OK ? tl_stage_end(&stage) : result;
}
