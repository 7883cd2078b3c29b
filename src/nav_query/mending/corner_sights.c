// SPDX-License-Identifier: MIT
//
// The edges and reaches of corner vertices, in one block a tile.
//
// An edge stands at both of its ends, and each end may have missed the other by rounding: so what one has seen, both
// have. Between two corner vertices that may both see a change towards one another only what was seen anew counts;
// where one of them sees what it saw the edge between them stays. So a graph that was mended has the edges of one that
// is baked afresh, but for those that only rounding tells apart.

#include "nav_query/mending/corner_sights.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

// One tile's, before they are put into its block.
typedef struct sight_lists {
    const tl_nav_graph_changes *changes;
    const tl_nav_change_sectors *sectors;
    const tl_nav_seen *seen;
    tl_nav_visibility_edge *edges; // of one corner vertex after another
    uint64_t edge_count, edge_capacity;
    tl_nav_number_list reaches; // of one after another
    tl_nav_number_list counts;  // of edges and reaches of each
} sight_lists;

static tl_result list_edge(sight_lists *l, tl_nav_visibility_edge edge)
{
    if (l->edge_count == l->edge_capacity) {
        tl_nav_visibility_edge *grown =
            tl_grow_array(l->changes->allocator, l->edges, &l->edge_capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        l->edges = grown;
    }
    l->edges[l->edge_count++] = edge;
    return TL_OK;
}

static tl_nav_visibility_edge edge_seen_to(const tl_nav_visibility_graph *graph, uint32_t to)
{
    const tl_nav_visibility_edge edge = { to, graph->vertices[to].x, graph->vertices[to].z };
    return edge;
}

bool tl_nav_edge_stays(const tl_nav_change_sectors *sectors, uint32_t from, uint32_t to)
{
    const uint8_t *marks = sectors->changes->graph->marks;
    if (marks[to] == TL_NAV_MARK_FRESH || marks[to] == TL_NAV_MARK_GONE) {
        return false;
    }
    return marks[from] == TL_NAV_MARK_NONE || marks[to] == TL_NAV_MARK_NONE || tl_nav_is_edge_kept(sectors, from, to);
}

// The edges of a corner vertex that stay, and those that were seen, by rising number.
static tl_result list_edges(sight_lists *l, uint32_t v)
{
    const tl_nav_visibility_graph *graph = l->changes->graph;
    const tl_nav_corner_vertex *vertex = &graph->vertices[v];
    const tl_nav_pair_list *seen = &l->seen->edges;
    uint64_t i = tl_nav_find_pair(seen, v);
    for (uint32_t k = 0; k < vertex->edge_count; k++) {
        const tl_nav_visibility_edge *edge = &vertex->edges[k];
        if (!tl_nav_edge_stays(l->sectors, v, edge->to)) {
            continue;
        }
        for (; i < seen->count && seen->items[i].key < ((uint64_t)v << 32 | edge->to); i++) {
            TL_TRY(list_edge(l, edge_seen_to(graph, (uint32_t)seen->items[i].key)));
        }
        i += i < seen->count && seen->items[i].key == ((uint64_t)v << 32 | edge->to) ? 1 : 0;
        TL_TRY(list_edge(l, *edge));
    }
    for (; i < seen->count && seen->items[i].key >> 32 == v; i++) {
        TL_TRY(list_edge(l, edge_seen_to(graph, (uint32_t)seen->items[i].key)));
    }
    return TL_OK;
}

// The slots that a corner vertex reached and has not lost, if it has not looked all around, and those where it has seen
// something, by rising number.
static tl_result list_reach(sight_lists *l, uint32_t v)
{
    const tl_allocator *allocator = l->changes->allocator;
    const tl_nav_corner_vertex *vertex = &l->changes->graph->vertices[v];
    const tl_nav_pair_list *seen = &l->seen->reaches;
    const uint8_t mark = l->changes->graph->marks[v];
    const uint32_t kept = mark == TL_NAV_MARK_NONE || mark == TL_NAV_MARK_LOOKS ? vertex->reach_count : 0;
    const uint32_t *reach = tl_nav_reach_of(vertex);
    uint64_t i = tl_nav_find_pair(seen, v);
    for (uint32_t k = 0; k < kept; k++) {
        if (mark == TL_NAV_MARK_LOOKS && tl_nav_has_pair(&l->sectors->lost, v, reach[k])) {
            continue;
        }
        for (; i < seen->count && seen->items[i].key < ((uint64_t)v << 32 | reach[k]); i++) {
            TL_TRY(tl_nav_add_number(allocator, &l->reaches, (uint32_t)seen->items[i].key));
        }
        i += i < seen->count && seen->items[i].key == ((uint64_t)v << 32 | reach[k]) ? 1 : 0;
        TL_TRY(tl_nav_add_number(allocator, &l->reaches, reach[k]));
    }
    for (; i < seen->count && seen->items[i].key >> 32 == v; i++) {
        TL_TRY(tl_nav_add_number(allocator, &l->reaches, (uint32_t)seen->items[i].key));
    }
    return TL_OK;
}

// Puts the lists into a block of the tile.
static tl_result fill_sights(const sight_lists *l, uint32_t slot)
{
    tl_nav_visibility_graph *graph = l->changes->graph;
    tl_nav_graph_tile *tile = &graph->tiles[slot];
    const size_t edge_words = sizeof(tl_nav_visibility_edge) / sizeof(uint32_t);
    const uint64_t words = edge_words * l->edge_count + l->reaches.count;
    if (l->edge_count > UINT32_MAX - graph->edge_count) {
        return TL_ERR_LIMIT;
    }
    uint32_t *block = tl_allocate_array(l->changes->allocator, words, sizeof *block);
    if (block == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t *at = block;
    const tl_nav_visibility_edge *edges = l->edges;
    const uint32_t *reach = l->reaches.numbers, *counts = l->counts.numbers;
    for (uint32_t v = tile->first_vertex; v != TL_NAV_NO_VERTEX; v = graph->vertices[v].next, counts += 2) {
        tl_nav_corner_vertex *vertex = &graph->vertices[v];
        graph->edge_count = graph->edge_count - vertex->edge_count + counts[0];
        vertex->edges = (const tl_nav_visibility_edge *)(const void *)at;
        vertex->edge_count = counts[0];
        vertex->reach_count = counts[1];
        if (counts[0] > 0) { // else there may be no list
            memcpy(at, edges, counts[0] * sizeof *edges);
            at += edge_words * counts[0];
            edges += counts[0];
        }
        if (counts[1] > 0) {
            memcpy(at, reach, counts[1] * sizeof *reach);
            at += counts[1];
            reach += counts[1];
        }
    }
    graph->tile_bytes += 4 * words;
    graph->tile_bytes -= 4 * tile->sight_words;
    tl_release_array(l->changes->allocator, tile->sights, tile->sight_words, sizeof *tile->sights);
    tile->sights = block;
    tile->sight_words = words;
    return TL_OK;
}

static tl_result remake_tile(sight_lists *l, uint32_t slot)
{
    const tl_nav_visibility_graph *graph = l->changes->graph;
    l->edge_count = l->reaches.count = l->counts.count = 0;
    for (uint32_t v = graph->tiles[slot].first_vertex; v != TL_NAV_NO_VERTEX; v = graph->vertices[v].next) {
        const uint64_t edges = l->edge_count, reaches = l->reaches.count;
        TL_TRY(list_edges(l, v));
        TL_TRY(list_reach(l, v));
        TL_TRY(tl_nav_add_number(l->changes->allocator, &l->counts, (uint32_t)(l->edge_count - edges)));
        TL_TRY(tl_nav_add_number(l->changes->allocator, &l->counts, (uint32_t)(l->reaches.count - reaches)));
    }
    return fill_sights(l, slot);
}

static tl_result remake_tiles(tl_nav_graph_changes *c, sight_lists *l, tl_stage *stage)
{
    const tl_nav_pair_list *edges = &l->seen->edges;
    for (uint64_t i = 0; i < edges->count; i++) {
        TL_TRY(tl_nav_note_slot(c, c->graph->vertices[edges->items[i].key >> 32].place.slot, TL_NAV_SLOT_SIGHTS));
    }
    for (uint64_t i = 0; i < c->slots.count; i++) {
        if ((c->slot_bits[c->slots.numbers[i]] & TL_NAV_SLOT_SIGHTS) != 0) {
            TL_TRY(remake_tile(l, c->slots.numbers[i]));
        }
        TL_TRY(tl_stage_tick(stage, (uint32_t)i));
    }
    return TL_OK;
}

tl_result tl_nav_remake_sights(const tl_nav_change_sectors *sectors, tl_nav_seen *seen, tl_stage *stage)
{
    const tl_allocator *allocator = sectors->changes->allocator;
    TL_TRY(tl_nav_unite_pairs(allocator, &seen->edges, stage));
    TL_TRY(tl_nav_unite_pairs(allocator, &seen->reaches, stage));
    sight_lists lists;
    memset(&lists, 0, sizeof lists);
    lists.changes = sectors->changes;
    lists.sectors = sectors;
    lists.seen = seen;
    const tl_result result = remake_tiles(sectors->changes, &lists, stage);
    tl_release_array(allocator, lists.edges, lists.edge_capacity, sizeof *lists.edges);
    tl_nav_free_numbers(allocator, &lists.reaches);
    tl_nav_free_numbers(allocator, &lists.counts);
    return result;
}
