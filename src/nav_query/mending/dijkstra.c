// SPDX-License-Identifier: MIT
//
// Dijkstra over the visibility graph. A vertex waits once for each time that its distance fell. Ties go to the lower
// vertex, so that the same paths are found everywhere.
//
// A heap of all that waits would be most of the work: a city's holds thousands, and each that leaves goes down a dozen
// levels of it. So only what is nearest is in a heap, those of one bucket of distances; others lie unsorted in lists,
// a bucket each, until it is their bucket's turn. Those whose distance has fallen since never enter the heap. All that
// waits lies within the longest edge of the nearest, so a ring of buckets is enough. The order in which vertices leave
// is that of one heap.
// Source: Dijkstra, A Note on Two Problems in Connexion with Graphs, 1959; Cherkassky, Goldberg, Silverstein, Buckets,
// Heaps, Lists, and Monotone Priority Queues, SIAM Journal on Computing 28, 1999, for the queue.

#include "nav_query/mending/dijkstra.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/lowest_bit.h"
#include "base/min_max.h"

#include <float.h>
#include <math.h>
#include <string.h>

// Vertices between two calls of progress: with some dozen edges each they take a few milliseconds.
enum { SETTLED_PER_CALL = 4096 };

enum { BUCKET_MASK = TL_NAV_DIJKSTRA_BUCKETS - 1, BUCKET_WORDS = TL_NAV_DIJKSTRA_BUCKETS / 64 };

static void measure_edges(tl_nav_dijkstra_team *team)
{
    const tl_nav_visibility_graph *graph = team->graph;
    uint32_t count = 0;
    double longest = 0.0;
    for (uint32_t v = 0; v < graph->vertex_room; v++) {
        const tl_nav_corner_vertex *vertex = &graph->vertices[v];
        team->first_edge[v] = count;
        for (uint32_t k = 0; k < vertex->edge_count; k++) {
            const tl_nav_dijkstra_edge edge = { tl_nav_visibility_edge_length(vertex, &vertex->edges[k]),
                                                vertex->edges[k].to, 0 };
            team->edges[count++] = edge;
            longest = tl_max_f64(longest, edge.length);
        }
    }
    TL_ASSERT(count == team->edge_count);
    team->first_edge[graph->vertex_room] = count;
    // Two to spare: one is open, and a quotient may round up.
    team->buckets_a_metre = longest > (double)FLT_MIN ? (TL_NAV_DIJKSTRA_BUCKETS - 2) / longest : 0.0;
}

tl_result tl_nav_dijkstra_begin(const tl_allocator *allocator, const tl_nav_visibility_graph *graph, tl_stage *stage,
                                tl_nav_dijkstra_team *team_out)
{
    memset(team_out, 0, sizeof *team_out);
    team_out->allocator = allocator;
    team_out->graph = graph;
    team_out->stage = stage;
    team_out->worker_count = tl_worker_count(stage->host);
    team_out->edge_count = graph->edge_count;
    team_out->first_edge = tl_allocate_array(allocator, (uint64_t)graph->vertex_room + 1, sizeof(uint32_t));
    team_out->edges = tl_allocate_array(allocator, graph->edge_count, sizeof *team_out->edges);
    team_out->searches = tl_allocate_array(allocator, team_out->worker_count, sizeof *team_out->searches);
    if (team_out->searches != NULL) {
        memset(team_out->searches, 0, team_out->worker_count * sizeof *team_out->searches);
    }
    if (team_out->first_edge == NULL || team_out->edges == NULL || team_out->searches == NULL) {
        tl_nav_dijkstra_end(team_out);
        return TL_ERR_MEMORY;
    }
    measure_edges(team_out);
    return TL_OK;
}

void tl_nav_dijkstra_end(tl_nav_dijkstra_team *team)
{
    const tl_allocator *allocator = team->allocator;
    const uint32_t room = team->graph->vertex_room;
    for (uint32_t i = 0; team->searches != NULL && i < team->worker_count; i++) {
        const tl_nav_dijkstra *search = &team->searches[i];
        tl_release_array(allocator, search->length, room, sizeof *search->length);
        tl_release_array(allocator, search->before, room, sizeof *search->before);
        tl_release_array(allocator, search->heap, search->heap_capacity, sizeof *search->heap);
        tl_release_array(allocator, search->later, search->later_capacity, sizeof *search->later);
    }
    tl_release_array(allocator, team->searches, team->worker_count, sizeof *team->searches);
    tl_release_array(allocator, team->first_edge, (uint64_t)room + 1, sizeof *team->first_edge);
    tl_release_array(allocator, team->edges, team->edge_count, sizeof *team->edges);
}

static tl_result allocate_search(const tl_nav_dijkstra_team *team, tl_nav_dijkstra *search)
{
    const uint32_t room = team->graph->vertex_room;
    search->first_free = TL_NAV_NO_VERTEX;
    search->length = tl_allocate_array(team->allocator, room, sizeof *search->length);
    search->before = tl_allocate_array(team->allocator, room, sizeof *search->before);
    return search->length != NULL && search->before != NULL ? TL_OK : TL_ERR_MEMORY;
}

// Makes room for one more.
static tl_result make_queue_room(const tl_nav_dijkstra_team *team, tl_nav_open_vertex **items, uint64_t *capacity,
                                 uint32_t count)
{
    if (count == *capacity) {
        tl_nav_open_vertex *grown = tl_grow_array(team->allocator, *items, capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        *items = grown;
    }
    return TL_OK;
}

static tl_result push_near(const tl_nav_dijkstra_team *team, tl_nav_dijkstra *search, tl_nav_open_vertex item)
{
    TL_TRY(make_queue_room(team, &search->heap, &search->heap_capacity, search->heap_count));
    tl_nav_open_vertex_push(search->heap, &search->heap_count, item, NULL);
    return TL_OK;
}

static tl_result push_later(const tl_nav_dijkstra_team *team, tl_nav_dijkstra *search, tl_nav_open_vertex item,
                            uint64_t bucket)
{
    const uint32_t place = (uint32_t)bucket & BUCKET_MASK;
    uint64_t *word = &search->has_items[place / 64];
    const uint64_t bit = UINT64_C(1) << (place % 64);
    uint32_t at = search->first_free;
    if (at != TL_NAV_NO_VERTEX) {
        search->first_free = search->later[at].next;
    } else {
        TL_TRY(make_queue_room(team, &search->later, &search->later_capacity, search->later_count));
        at = search->later_count++;
    }
    item.next = (*word & bit) != 0 ? search->first[place] : TL_NAV_NO_VERTEX;
    search->later[at] = item;
    search->first[place] = at;
    *word |= bit;
    return TL_OK;
}

static tl_result open_vertex(const tl_nav_dijkstra_team *team, tl_nav_dijkstra *search, uint32_t vertex)
{
    const tl_nav_open_vertex item = { search->length[vertex], vertex, TL_NAV_NO_VERTEX };
    const uint64_t bucket = (uint64_t)(item.length * team->buckets_a_metre);
    return bucket <= search->open_bucket ? push_near(team, search, item) : push_later(team, search, item, bucket);
}

// Opens the next bucket in which something waits. False: nothing does.
static bool find_bucket(tl_nav_dijkstra *search)
{
    const uint32_t from = (uint32_t)(search->open_bucket + 1) & BUCKET_MASK;
    for (uint32_t i = 0; i <= BUCKET_WORDS; i++) {
        const uint32_t word = (from / 64 + i) % BUCKET_WORDS;
        const uint64_t ahead = UINT64_MAX << (from % 64);
        const uint64_t bits = search->has_items[word] & (i == 0 ? ahead : i == BUCKET_WORDS ? ~ahead : UINT64_MAX);
        if (bits != 0) {
            const uint32_t place = 64 * word + tl_lowest_bit(bits);
            search->open_bucket += 1 + ((place - from) & BUCKET_MASK);
            return true;
        }
    }
    return false;
}

// Puts the items of the next bucket in which any still count into the heap, which is empty.
static tl_result open_next_bucket(const tl_nav_dijkstra_team *team, tl_nav_dijkstra *search)
{
    while (search->heap_count == 0 && find_bucket(search)) {
        const uint32_t place = (uint32_t)search->open_bucket & BUCKET_MASK;
        search->has_items[place / 64] &= ~(UINT64_C(1) << (place % 64));
        for (uint32_t at = search->first[place]; at != TL_NAV_NO_VERTEX;) {
            const tl_nav_open_vertex item = search->later[at];
            search->later[at].next = search->first_free;
            search->first_free = at;
            at = item.next;
            if (item.length == search->length[item.vertex]) {
                TL_TRY(push_near(team, search, item));
            }
        }
    }
    return TL_OK;
}

// A vertex has its length, and those beside it may have a shorter one by way of it.
static tl_result settle_vertex(const tl_nav_dijkstra_team *team, tl_nav_dijkstra *search, tl_nav_open_vertex item)
{
    for (uint32_t k = team->first_edge[item.vertex]; k < team->first_edge[item.vertex + 1]; k++) {
        const tl_nav_dijkstra_edge *edge = &team->edges[k];
        const double length = item.length + edge->length;
        if (length < search->length[edge->to]) {
            search->length[edge->to] = length;
            search->before[edge->to] = item.vertex;
            TL_TRY(open_vertex(team, search, edge->to));
        }
    }
    return TL_OK;
}

static tl_result spread_lengths(const tl_nav_dijkstra_team *team, tl_nav_dijkstra *search)
{
    for (uint32_t settled = 0;;) {
        TL_TRY(open_next_bucket(team, search));
        if (search->heap_count == 0) {
            return TL_OK;
        }
        const tl_nav_open_vertex next = tl_nav_open_vertex_pop(search->heap, &search->heap_count, NULL);
        if (next.length > search->length[next.vertex]) {
            continue;
        }
        if (settled++ % SETTLED_PER_CALL == 0 && team->worker_count == 1) {
            TL_TRY(tl_stage_add(team->stage, 0));
        }
        TL_TRY(settle_vertex(team, search, next));
    }
}

static tl_result measure_from(const tl_nav_dijkstra_team *team, tl_nav_dijkstra *search, const uint32_t *sources,
                              uint32_t source_count)
{
    if (search->length == NULL) {
        TL_TRY(allocate_search(team, search));
    }
    for (uint32_t i = 0; i < team->graph->vertex_room; i++) {
        search->length[i] = (double)INFINITY;
    }
    search->open_bucket = 0;
    for (uint32_t i = 0; i < source_count; i++) {
        search->length[sources[i]] = 0.0;
        search->before[sources[i]] = sources[i];
        TL_TRY(open_vertex(team, search, sources[i]));
    }
    return spread_lengths(team, search);
}

const tl_nav_dijkstra *tl_nav_dijkstra_run(tl_nav_dijkstra_team *team, uint32_t worker, const uint32_t *sources,
                                           uint32_t source_count)
{
    tl_nav_dijkstra *search = &team->searches[worker];
    if (search->result == TL_OK) {
        search->result = measure_from(team, search, sources, source_count);
    }
    return search->result == TL_OK ? search : NULL;
}

tl_result tl_nav_dijkstra_result(const tl_nav_dijkstra_team *team)
{
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < team->worker_count && result == TL_OK; i++) {
        result = team->searches[i].result;
    }
    return result;
}
