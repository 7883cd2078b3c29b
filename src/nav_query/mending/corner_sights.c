// SPDX-License-Identifier: MIT
//
// The edges and reaches of corner vertices, in one block a tile.
//
// An edge stands at both of its ends, and each end may have missed the other by rounding: so what one has seen, both
// have. Between two corner vertices that have both looked around anew only what was seen counts; where one of them sees
// what it saw the edge between them stays. So a graph that was mended has the edges of one that is baked afresh, but
// for those that only rounding tells apart.

#include "nav_query/mending/corner_sights.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

tl_result tl_nav_add_pair(const tl_allocator *allocator, tl_nav_pair_list *list, uint32_t first, uint32_t second)
{
    if (list->count == list->capacity) {
        tl_sort_item *grown = (tl_sort_item *)tl_grow_array(allocator, list->items, &list->capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        list->items = grown;
    }
    const tl_sort_item item = { (uint64_t)first << 32 | second, 0, 0 };
    list->items[list->count++] = item;
    return TL_OK;
}

void tl_nav_free_pairs(const tl_allocator *allocator, tl_nav_pair_list *list)
{
    tl_release_array(allocator, list->items, list->capacity, sizeof *list->items);
    memset(list, 0, sizeof *list);
}

// Ascending, each once.
static tl_result sort_pairs(const tl_allocator *allocator, tl_nav_pair_list *list, tl_stage *stage)
{
    if (list->count > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    tl_sort_item *scratch = (tl_sort_item *)tl_allocate_array(allocator, list->count, sizeof *scratch);
    if (scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    const tl_result result = tl_radix_sort_in_stage(list->items, scratch, (uint32_t)list->count, stage);
    tl_release_array(allocator, scratch, list->count, sizeof *scratch);
    TL_TRY(result);
    uint64_t kept = 0;
    for (uint64_t i = 0; i < list->count; i++) {
        if (kept == 0 || list->items[kept - 1].key != list->items[i].key) {
            list->items[kept++] = list->items[i];
        }
    }
    list->count = kept;
    return TL_OK;
}

// The first pair whose first number is no less.
static uint64_t find_pair(const tl_nav_pair_list *list, uint32_t first)
{
    uint64_t begin = 0, end = list->count;
    while (begin < end) {
        const uint64_t middle = begin + (end - begin) / 2;
        if (list->items[middle].key >> 32 < first) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

// One tile's, before they are put into its block.
typedef struct sight_lists {
    const tl_nav_graph_changes *changes;
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
            (tl_nav_visibility_edge *)tl_grow_array(l->changes->allocator, l->edges, &l->edge_capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        l->edges = grown;
    }
    l->edges[l->edge_count++] = edge;
    return TL_OK;
}

static tl_nav_visibility_edge edge_between(const tl_nav_visibility_graph *graph, uint32_t from, uint32_t to)
{
    const tl_nav_corner_vertex *begin = &graph->vertices[from], *end = &graph->vertices[to];
    const double x = (double)end->x - (double)begin->x, z = (double)end->z - (double)begin->z;
    const tl_nav_visibility_edge edge = { to, end->x, end->z, tl_nav_turns_at(end, x, z, graph->rounding) };
    return edge;
}

static bool stays(const tl_nav_graph_changes *c, uint32_t from, const tl_nav_visibility_edge *edge)
{
    const uint8_t *marks = c->graph->marks;
    return marks[edge->to] == TL_NAV_MARK_NONE ||
           (marks[from] == TL_NAV_MARK_NONE && marks[edge->to] == TL_NAV_MARK_LOOKS);
}

// The edges of a corner vertex that stay, and those that were seen, by rising number.
static tl_result list_edges(sight_lists *l, uint32_t v)
{
    const tl_nav_visibility_graph *graph = l->changes->graph;
    const tl_nav_corner_vertex *vertex = &graph->vertices[v];
    const tl_nav_pair_list *seen = &l->seen->edges;
    uint64_t i = find_pair(seen, v);
    for (uint32_t k = 0; k < vertex->edge_count; k++) {
        const tl_nav_visibility_edge *edge = &vertex->edges[k];
        if (!stays(l->changes, v, edge)) {
            continue;
        }
        for (; i < seen->count && seen->items[i].key < ((uint64_t)v << 32 | edge->to); i++) {
            TL_TRY(list_edge(l, edge_between(graph, v, (uint32_t)seen->items[i].key)));
        }
        i += i < seen->count && seen->items[i].key == ((uint64_t)v << 32 | edge->to) ? 1 : 0;
        TL_TRY(list_edge(l, *edge));
    }
    for (; i < seen->count && seen->items[i].key >> 32 == v; i++) {
        TL_TRY(list_edge(l, edge_between(graph, v, (uint32_t)seen->items[i].key)));
    }
    return TL_OK;
}

static tl_result list_reach(sight_lists *l, uint32_t v)
{
    const tl_allocator *allocator = l->changes->allocator;
    const tl_nav_corner_vertex *vertex = &l->changes->graph->vertices[v];
    const tl_nav_pair_list *seen = &l->seen->reaches;
    if (l->changes->graph->marks[v] == TL_NAV_MARK_NONE) {
        for (uint32_t k = 0; k < vertex->reach_count; k++) {
            TL_TRY(tl_nav_add_number(allocator, &l->reaches, tl_nav_reach_of(vertex)[k]));
        }
        return TL_OK;
    }
    for (uint64_t i = find_pair(seen, v); i < seen->count && seen->items[i].key >> 32 == v; i++) {
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
    uint32_t *block = (uint32_t *)tl_allocate_array(l->changes->allocator, words, sizeof *block);
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
        if (counts[0] > 0) {
            memcpy(at, edges, counts[0] * sizeof *edges);
        }
        if (counts[1] > 0) {
            memcpy(at + edge_words * counts[0], reach, counts[1] * sizeof *reach);
        }
        at += edge_words * counts[0] + counts[1];
        edges += counts[0];
        reach += counts[1];
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

tl_result tl_nav_remake_sights(tl_nav_graph_changes *c, tl_nav_seen *seen, tl_stage *stage)
{
    TL_TRY(sort_pairs(c->allocator, &seen->edges, stage));
    TL_TRY(sort_pairs(c->allocator, &seen->reaches, stage));
    sight_lists lists;
    memset(&lists, 0, sizeof lists);
    lists.changes = c;
    lists.seen = seen;
    const tl_result result = remake_tiles(c, &lists, stage);
    tl_release_array(c->allocator, lists.edges, lists.edge_capacity, sizeof *lists.edges);
    tl_nav_free_numbers(c->allocator, &lists.reaches);
    tl_nav_free_numbers(c->allocator, &lists.counts);
    return result;
}
