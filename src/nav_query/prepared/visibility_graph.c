// SPDX-License-Identifier: MIT
//
// The memory of a visibility graph, laid out so that an edit changes no more of it than what it changed.
//
// Corner vertices have numbers that outlive edits: they stand in one array, as search and cones look for them by
// number, and a number that became free goes to the next new one. All that is larger hangs on the tiles: the edges of a
// corner vertex on that where its fan begins, the cones of a polygon on its own. A mend makes new blocks for the tiles
// it changes and lets the old ones go, which older versions of the navmesh may still read.
// Source: Lozano-Perez and Wesley, An Algorithm for Planning Collision-Free Paths Among Polyhedral Obstacles, 1979 (the
// visibility graph); de Berg et al., Computational Geometry, 3rd edition, 2008, chapter 15 (why only lines that touch
// both obstacles count).

#include "nav_query/prepared/visibility_graph.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/prepared/corner_distances.h"

#include <string.h>

tl_nav_visibility_graph *tl_nav_create_visibility_graph(const tl_allocator *allocator)
{
    tl_nav_visibility_graph *graph = tl_allocate_array(allocator, 1, sizeof *graph);
    if (graph != NULL) {
        memset(graph, 0, sizeof *graph);
        graph->free_vertex = TL_NAV_NO_VERTEX;
    }
    return graph;
}

void tl_nav_free_visibility_graph(const tl_allocator *allocator, tl_nav_visibility_graph *graph)
{
    if (graph == NULL) {
        return;
    }
    for (uint32_t slot = 0; slot < graph->slot_count; slot++) {
        tl_nav_graph_tile *tile = &graph->tiles[slot];
        tl_release_array(allocator, tile->sights, tile->sight_words, sizeof *tile->sights);
        tl_nav_free_cones(allocator, &tile->cones);
        tl_nav_free_known_rings(allocator, &tile->rings);
    }
    tl_nav_free_corner_distances(allocator, graph);
    tl_nav_free_legs(allocator, graph);
    tl_nav_free_names(allocator, &graph->names);
    tl_release_array(allocator, graph->vertices, graph->vertex_capacity, sizeof *graph->vertices);
    tl_release_array(allocator, graph->landmarks, graph->vertex_capacity, sizeof *graph->landmarks);
    tl_release_array(allocator, graph->marks, graph->vertex_capacity, sizeof *graph->marks);
    tl_release_array(allocator, graph->orders, graph->vertex_capacity, sizeof *graph->orders);
    tl_release_array(allocator, graph->tiles, graph->slot_count, sizeof *graph->tiles);
    tl_release_array(allocator, graph, 1, sizeof *graph);
}

uint64_t tl_nav_known_rings_size(const tl_nav_known_rings *rings)
{
    return rings->first != NULL ? ((uint64_t)rings->polygon_count + 1) * sizeof *rings->first +
                                      rings->edge_count * (uint64_t)sizeof *rings->edges +
                                      rings->seam_count * (uint64_t)sizeof *rings->seams
                                : 0;
}

void tl_nav_free_known_rings(const tl_allocator *allocator, tl_nav_known_rings *rings)
{
    tl_release_array(allocator, rings->first, tl_nav_known_rings_size(rings), 1);
    memset(rings, 0, sizeof *rings);
}

uint64_t tl_nav_visibility_graph_size(const tl_nav_visibility_graph *graph)
{
    const uint64_t vertex_size =
        sizeof *graph->vertices + sizeof *graph->landmarks + sizeof *graph->marks + sizeof *graph->orders;
    return sizeof *graph + graph->vertex_capacity * vertex_size + graph->slot_count * (uint64_t)sizeof *graph->tiles +
           graph->names.capacity * (uint64_t)sizeof *graph->names.entries + graph->tile_bytes;
}

// Copies the arrays by corner vertex into others with more room, or as much.
static tl_result move_corner_vertices(const tl_allocator *allocator, tl_nav_visibility_graph *graph, uint32_t capacity)
{
    tl_nav_corner_vertex *vertices = tl_allocate_array(allocator, capacity, sizeof *vertices);
    float(*landmarks)[TL_NAV_LANDMARKS] = tl_allocate_array(allocator, capacity, sizeof *landmarks);
    uint8_t *marks = tl_allocate_array(allocator, capacity, sizeof *marks);
    uint32_t *orders = tl_allocate_array(allocator, capacity, sizeof *orders);
    if (vertices == NULL || landmarks == NULL || marks == NULL || orders == NULL) {
        tl_release_array(allocator, vertices, capacity, sizeof *vertices);
        tl_release_array(allocator, landmarks, capacity, sizeof *landmarks);
        tl_release_array(allocator, marks, capacity, sizeof *marks);
        tl_release_array(allocator, orders, capacity, sizeof *orders);
        return TL_ERR_MEMORY;
    }
    memset(marks, 0, capacity * sizeof *marks);
    if (graph->vertex_room > 0) {
        memcpy(vertices, graph->vertices, graph->vertex_room * sizeof *vertices);
        memcpy(landmarks, graph->landmarks, graph->vertex_room * sizeof *landmarks);
        memcpy(marks, graph->marks, graph->vertex_room * sizeof *marks);
        memcpy(orders, graph->orders, graph->vertex_room * sizeof *orders);
    }
    tl_release_array(allocator, graph->vertices, graph->vertex_capacity, sizeof *vertices);
    tl_release_array(allocator, graph->landmarks, graph->vertex_capacity, sizeof *landmarks);
    tl_release_array(allocator, graph->marks, graph->vertex_capacity, sizeof *marks);
    tl_release_array(allocator, graph->orders, graph->vertex_capacity, sizeof *orders);
    graph->vertices = vertices;
    graph->landmarks = landmarks;
    graph->marks = marks;
    graph->orders = orders;
    graph->vertex_capacity = capacity;
    return TL_OK;
}

tl_result tl_nav_reserve_corner_vertices(const tl_allocator *allocator, tl_nav_visibility_graph *graph, uint64_t more)
{
    const uint64_t needed = graph->vertex_count + more;
    if (needed > TL_NAV_MAX_CORNER_VERTICES) {
        return TL_ERR_LIMIT;
    }
    if (needed <= graph->vertex_capacity) {
        return TL_OK;
    }
    // A thirty-second to spare: numbers that edits free are taken again.
    return move_corner_vertices(allocator, graph, (uint32_t)(needed + needed / 32 + 8));
}

uint32_t tl_nav_take_corner_vertex(tl_nav_visibility_graph *graph)
{
    uint32_t vertex = graph->free_vertex;
    if (vertex != TL_NAV_NO_VERTEX) {
        graph->free_vertex = graph->vertices[vertex].next;
    } else {
        TL_ASSERT(graph->vertex_room < graph->vertex_capacity);
        vertex = graph->vertex_room++;
    }
    graph->vertex_count++;
    return vertex;
}

void tl_nav_give_corner_vertex(tl_nav_visibility_graph *graph, uint32_t vertex)
{
    graph->edge_count -= graph->vertices[vertex].edge_count;
    memset(&graph->vertices[vertex], 0, sizeof graph->vertices[vertex]);
    memset(graph->landmarks[vertex], 0, sizeof graph->landmarks[vertex]);
    graph->vertices[vertex].next = graph->free_vertex;
    graph->free_vertex = vertex;
    graph->vertex_count--;
}

tl_result tl_nav_own_graph_arrays(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph)
{
    const tl_allocator *allocator = &navmesh->allocator;
    if (tl_nav_is_shared(navmesh->history, graph->vertices)) {
        TL_TRY(move_corner_vertices(allocator, graph, graph->vertex_capacity));
    }
    if (navmesh->slot_count > graph->slot_count || tl_nav_is_shared(navmesh->history, graph->tiles)) {
        const uint32_t count = navmesh->slot_count > graph->slot_count ? navmesh->slot_count : graph->slot_count;
        tl_nav_graph_tile *tiles = tl_allocate_array(allocator, count, sizeof *tiles);
        if (tiles == NULL) {
            return TL_ERR_MEMORY;
        }
        memset(tiles, 0, count * sizeof *tiles);
        for (uint32_t slot = 0; slot < count; slot++) {
            if (slot < graph->slot_count) {
                tiles[slot] = graph->tiles[slot];
            } else {
                tiles[slot].first_vertex = TL_NAV_NO_VERTEX;
            }
        }
        tl_release_array(allocator, graph->tiles, graph->slot_count, sizeof *tiles);
        graph->tiles = tiles;
        graph->slot_count = count;
    }
    return TL_OK;
}
