// SPDX-License-Identifier: MIT
//
// Dijkstra over the visibility graph, with a binary heap in which a vertex stands once for each time that its distance
// fell. Ties go to the lower vertex, so that the same paths are found everywhere.
// Source: Dijkstra, A Note on Two Problems in Connexion with Graphs, 1959.

#include "nav_query/prepared/dijkstra.h"

#include "base/arena.h"
#include "base/assert.h"

#include <math.h>
#include <string.h>

// Vertices between two calls of progress: with some dozen edges each they take a few milliseconds.
enum { SETTLED_PER_CALL = 4096 };

static void measure_edges(tl_nav_dijkstra *lengths)
{
    const tl_nav_visibility_graph *graph = lengths->graph;
    uint32_t count = 0;
    for (uint32_t v = 0; v < graph->vertex_room; v++) {
        const tl_nav_corner_vertex *vertex = &graph->vertices[v];
        lengths->first_edge[v] = count;
        for (uint32_t k = 0; k < vertex->edge_count; k++) {
            const tl_nav_dijkstra_edge edge = { tl_nav_visibility_edge_length(vertex, &vertex->edges[k]),
                                                vertex->edges[k].to, 0 };
            lengths->edges[count++] = edge;
        }
    }
    TL_ASSERT(count == lengths->edge_count);
    lengths->first_edge[graph->vertex_room] = count;
}

tl_result tl_nav_dijkstra_init(const tl_allocator *allocator, const tl_nav_visibility_graph *graph, tl_stage *stage,
                               tl_nav_dijkstra *lengths_out)
{
    memset(lengths_out, 0, sizeof *lengths_out);
    lengths_out->graph = graph;
    lengths_out->stage = stage;
    lengths_out->edge_count = graph->edge_count;
    lengths_out->first_edge =
        tl_allocate_array(allocator, (uint64_t)graph->vertex_room + 1, sizeof *lengths_out->first_edge);
    lengths_out->edges = tl_allocate_array(allocator, graph->edge_count, sizeof *lengths_out->edges);
    lengths_out->length = tl_allocate_array(allocator, graph->vertex_room, sizeof *lengths_out->length);
    lengths_out->before = tl_allocate_array(allocator, graph->vertex_room, sizeof *lengths_out->before);
    lengths_out->heap =
        tl_allocate_array(allocator, (uint64_t)graph->vertex_room + graph->edge_count, sizeof *lengths_out->heap);
    if (lengths_out->length == NULL || lengths_out->before == NULL || lengths_out->heap == NULL ||
        lengths_out->first_edge == NULL || lengths_out->edges == NULL) {
        tl_nav_dijkstra_free(allocator, lengths_out);
        return TL_ERR_MEMORY;
    }
    measure_edges(lengths_out);
    return TL_OK;
}

void tl_nav_dijkstra_free(const tl_allocator *allocator, tl_nav_dijkstra *lengths)
{
    const tl_nav_visibility_graph *graph = lengths->graph;
    tl_release_array(allocator, lengths->first_edge, (uint64_t)graph->vertex_room + 1, sizeof *lengths->first_edge);
    tl_release_array(allocator, lengths->edges, lengths->edge_count, sizeof *lengths->edges);
    tl_release_array(allocator, lengths->length, graph->vertex_room, sizeof *lengths->length);
    tl_release_array(allocator, lengths->before, graph->vertex_room, sizeof *lengths->before);
    tl_release_array(allocator, lengths->heap, (uint64_t)graph->vertex_room + lengths->edge_count,
                     sizeof *lengths->heap);
}

static void open_vertex(tl_nav_dijkstra *lengths, uint32_t vertex)
{
    const tl_nav_open_vertex item = { lengths->length[vertex], vertex };
    tl_nav_open_vertex_push(lengths->heap, &lengths->heap_count, item, NULL);
}

static tl_result spread_lengths(tl_nav_dijkstra *lengths)
{
    uint32_t settled = 0;
    while (lengths->heap_count > 0) {
        const tl_nav_open_vertex next = tl_nav_open_vertex_pop(lengths->heap, &lengths->heap_count, NULL);
        if (next.length > lengths->length[next.vertex]) {
            continue;
        }
        if (settled++ % SETTLED_PER_CALL == 0) {
            TL_TRY(tl_stage_add(lengths->stage, 0));
        }
        for (uint32_t k = lengths->first_edge[next.vertex]; k < lengths->first_edge[next.vertex + 1]; k++) {
            const tl_nav_dijkstra_edge *edge = &lengths->edges[k];
            const double length = next.length + edge->length;
            if (length < lengths->length[edge->to]) {
                lengths->length[edge->to] = length;
                lengths->before[edge->to] = next.vertex;
                open_vertex(lengths, edge->to);
            }
        }
    }
    return TL_OK;
}

tl_result tl_nav_dijkstra_run(tl_nav_dijkstra *lengths, const uint32_t *sources, uint32_t source_count)
{
    for (uint32_t i = 0; i < lengths->graph->vertex_room; i++) {
        lengths->length[i] = (double)INFINITY;
    }
    for (uint32_t i = 0; i < source_count; i++) {
        lengths->length[sources[i]] = 0.0;
        lengths->before[sources[i]] = sources[i];
        open_vertex(lengths, sources[i]);
    }
    return spread_lengths(lengths);
}
