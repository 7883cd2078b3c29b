// SPDX-License-Identifier: MIT
//
// Baking the visibility graph: from each corner vertex all that is visible is found once, by the wedges of the
// exact search.
//
// An edge needs two corner vertices that see one another, and at both ends walls on the side to which a path would
// turn: few lines of sight qualify. A city of 25,000 polygons has 25,000 corner vertices with 14 edges each, found in
// 0.4 s. Where a polygon is linked to two floors over the same stretch of a seam, a vertex has several free ways around
// it (fans.c) and no single number; such a navmesh gets no graph.
// Source: Lozano-Perez and Wesley, An Algorithm for Planning Collision-Free Paths Among Polyhedral Obstacles, 1979 (the
// visibility graph); de Berg et al., Computational Geometry, 3rd edition, 2008, chapter 15 (why only lines that touch
// both obstacles count).

#include "nav_query/prepared/visibility_graph.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/prepared/corner_distances.h"
#include "nav_query/prepared/graph_reuse.h"
#include "nav_query/prepared/landmarks.h"
#include "nav_query/search/query_memory.h"

#include <string.h>

// Wedges that one look around may need at first. It is doubled where that is too few.
enum { FIRST_WEDGES = 4096 };

// Pairs of numbers, as many as come.
typedef struct pair_list {
    uint64_t *pairs; // key << 32 | value
    uint64_t count, capacity;
} pair_list;

typedef struct graph_baker {
    const tl_navmesh *navmesh;
    tl_allocator allocator;
    tl_stage stage; // corner vertices that have looked around
    tl_nav_visibility_graph *graph;
    uint32_t *vertex_of; // [last_fan + 1], by number; UINT32_MAX: none
    uint32_t fan_count;
    tl_nav_graph_reuse reuse;
    tl_nav_query *query;
    pair_list sights; // corner vertex and corner vertex
    tl_nav_cone_list cones;
    uint32_t vertex;  // that looks
    tl_result result; // of the lists
} graph_baker;

static void add_pair(graph_baker *b, uint32_t key, uint32_t value)
{
    pair_list *list = &b->sights;
    if (list->count == list->capacity) {
        uint64_t *grown = tl_grow_array(&b->allocator, list->pairs, &list->capacity, sizeof *grown);
        if (grown == NULL) {
            b->result = TL_ERR_MEMORY;
            return;
        }
        list->pairs = grown;
    }
    list->pairs[list->count++] = (uint64_t)key << 32 | value;
}

static uint32_t count_vertices(graph_baker *b)
{
    uint32_t vertices = 0;
    memset(b->vertex_of, 0xff, b->fan_count * sizeof *b->vertex_of);
    for (uint32_t slot = 0; slot < b->navmesh->slot_count; slot++) {
        const tl_nav_rings *rings = &b->navmesh->slots[slot].rings;
        const uint32_t edges = b->navmesh->slots[slot].tile != NULL ? rings->edge_count : 0;
        for (uint32_t i = 0; i < edges; i++) {
            const uint32_t turn = tl_nav_turn_of(rings, tl_nav_edge_of(rings, i));
            if (turn != 0 && b->vertex_of[turn] == UINT32_MAX) {
                b->vertex_of[turn] = vertices++;
            }
        }
    }
    return vertices;
}

static void fill_corner_vertex(graph_baker *b, tl_nav_ring_place place)
{
    const tl_nav_ring ring = tl_nav_ring_at(b->navmesh, place.slot, place.polygon);
    const tl_nav_ring_edge edge = tl_nav_ring_edge_at(&ring, place.edge);
    const tl_vec3 at = ring.points[place.edge];
    const tl_nav_rings *rings = &b->navmesh->slots[place.slot].rings;
    const uint32_t turn = tl_nav_turn_of(rings, edge);
    if (turn == 0 || b->graph->vertices[b->vertex_of[turn]].turn != 0) {
        return;
    }
    tl_nav_corner_vertex vertex = { at.x, at.y, at.z, turn, 0, *tl_nav_walls_of(rings, edge), place };
    tl_nav_find_fan(b->navmesh, NULL, &vertex.place);
    b->graph->vertices[b->vertex_of[turn]] = vertex;
}

static void fill_corner_vertices(graph_baker *b)
{
    for (uint32_t slot = 0; slot < b->navmesh->slot_count; slot++) {
        const tl_nav_rings *rings = &b->navmesh->slots[slot].rings;
        b->graph->slot_first[slot] = b->graph->polygon_count;
        b->graph->slot_salt[slot] = b->navmesh->slots[slot].tile != NULL ? b->navmesh->slots[slot].salt : 0;
        for (uint32_t p = 0; b->navmesh->slots[slot].tile != NULL && p < rings->polygon_count; p++) {
            b->graph->polygon_count++;
            for (uint32_t i = 0; i < tl_nav_ring_first(rings, p + 1) - tl_nav_ring_first(rings, p); i++) {
                tl_nav_ring_place place = { slot, p, i };
                fill_corner_vertex(b, place);
            }
        }
    }
}

static void note_sight(void *user, uint32_t turn)
{
    graph_baker *b = user;
    uint32_t seen = b->vertex_of[turn];
    const tl_nav_corner_vertex *from = &b->graph->vertices[b->vertex];
    const tl_nav_corner_vertex *to = &b->graph->vertices[seen];
    double x = (double)to->x - (double)from->x;
    double z = (double)to->z - (double)from->z;
    if (seen != b->vertex && (x != 0.0 || z != 0.0) && tl_nav_turns_at(from, -x, -z, b->graph->rounding) != 0 &&
        tl_nav_turns_at(to, x, z, b->graph->rounding) != 0) {
        // Each end may have missed the other by rounding.
        add_pair(b, b->vertex, seen);
        add_pair(b, seen, b->vertex);
    }
}

// Tells the ends of the edges that a corner vertex keeps: those that look around anew may miss it by rounding.
static void tell_ends(graph_baker *b, uint32_t vertex)
{
    const tl_nav_visibility_graph *old = b->reuse.old;
    const tl_nav_corner_vertex *from = &old->vertices[b->reuse.before[vertex]];
    for (uint32_t k = from[0].first_edge; k < from[1].first_edge; k++) {
        if (b->reuse.now[old->edges[k].to] == TL_NAV_NO_VERTEX) {
            add_pair(b, b->vertex_of[old->vertices[old->edges[k].to].turn], vertex);
        }
    }
}

static tl_result make_look_query(graph_baker *b, uint32_t max_nodes)
{
    tl_nav_query_release(b->query);
    const tl_nav_query_sizes none = { 0, 0 };
    return tl_nav_query_allocate(max_nodes, none, &b->allocator, &b->query);
}

static tl_result look_from(graph_baker *b, uint32_t vertex)
{
    const tl_nav_corner_vertex *from = &b->graph->vertices[vertex];
    tl_nav_shortest_search start;
    memset(&start, 0, sizeof start);
    start.navmesh = b->navmesh;
    start.start_slot = from->place.slot;
    start.start_polygon = from->place.polygon;
    start.start = tl_vec3_make(from->x, from->y, from->z);
    tl_nav_sight sight = { note_sight, b, &from->walls };
    b->vertex = vertex;
    start.query = b->query;
    while (!tl_nav_see(&start, &sight)) {
        if (b->query->max_nodes > TL_NAV_MAX_QUERY_NODES / 2) {
            return TL_ERR_LIMIT;
        }
        TL_TRY(make_look_query(b, 2 * b->query->max_nodes));
        start.query = b->query;
    }
    for (uint32_t i = 0; i < b->query->wedge_count; i++) {
        TL_TRY(tl_nav_add_cones(&b->cones, b->graph, vertex, &b->query->wedges[i]));
    }
    return b->result;
}

// Sums counts up and leaves the pairs' values by key: those of key k at [first[k], first[k + 1]).
static void group(const pair_list *list, uint32_t key_count, uint32_t *first, uint32_t *values)
{
    memset(first, 0, ((size_t)key_count + 1) * sizeof *first);
    for (uint64_t i = 0; i < list->count; i++) {
        first[list->pairs[i] >> 32]++;
    }
    uint32_t sum = 0;
    for (uint32_t k = 0; k <= key_count; k++) {
        sum += first[k];
        first[k] = sum;
    }
    for (uint64_t i = list->count; i > 0; i--) {
        values[--first[list->pairs[i - 1] >> 32]] = (uint32_t)list->pairs[i - 1];
    }
}

#define TL_HEAP(name)                 largest_##name
#define TL_HEAP_ITEM                  uint32_t
#define TL_HEAP_BEFORE(context, a, b) ((a) > (b))
#include "base/heap.inl"

// Ascending, each once; returns how many are left. A heapsort: most corner vertices have few edges, but one may see all
// others.
static uint32_t sort_unique(uint32_t *values, uint32_t count)
{
    uint32_t ascending = 1;
    while (ascending < count && values[ascending - 1] < values[ascending]) {
        ascending++;
    }
    if (ascending >= count) {
        return count; // as edges that were kept are
    }
    for (uint32_t i = count / 2; i-- > 0;) {
        largest_sift_down(values, count, i, values[i], NULL);
    }
    for (uint32_t left = count; left > 1;) {
        const uint32_t top = largest_pop(values, &left, NULL);
        values[left] = top;
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (kept == 0 || values[kept - 1] != values[i]) {
            values[kept++] = values[i];
        }
    }
    return kept;
}

// Where the edges of a corner vertex lead that it had before, if it sees what it saw. Returns their number.
static uint32_t kept_ends(const graph_baker *b, uint32_t vertex, uint32_t *to_out)
{
    const tl_nav_visibility_graph *old = b->reuse.old;
    if (!tl_nav_is_reused(&b->reuse, vertex)) {
        return 0;
    }
    const tl_nav_corner_vertex *from = &old->vertices[b->reuse.before[vertex]];
    const uint32_t count = from[1].first_edge - from[0].first_edge;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t to = old->edges[from->first_edge + k].to, now = b->reuse.now[to];
        to_out[k] = now != TL_NAV_NO_VERTEX ? now : b->vertex_of[old->vertices[to].turn];
    }
    return count;
}

// Where all edges lead, vertex by vertex: those that were kept, and what was seen. `to` has room for all.
static void gather_ends(graph_baker *b, const uint32_t *first, const uint32_t *seen, uint32_t *to)
{
    tl_nav_visibility_graph *graph = b->graph;
    for (uint32_t i = 0; i < graph->vertex_count; i++) {
        uint32_t *ends = to + graph->edge_count;
        const uint32_t kept = kept_ends(b, i, ends), fresh = first[i + 1] - first[i];
        memcpy(ends + kept, seen + first[i], fresh * sizeof *ends);
        graph->vertices[i].first_edge = graph->edge_count;
        graph->edge_count += sort_unique(ends, kept + fresh);
    }
    graph->vertices[graph->vertex_count].first_edge = graph->edge_count;
}

static void fill_edges(tl_nav_visibility_graph *graph, const uint32_t *to)
{
    for (uint32_t i = 0; i < graph->vertex_count; i++) {
        const tl_nav_corner_vertex *from = &graph->vertices[i];
        for (uint32_t k = from[0].first_edge; k < from[1].first_edge; k++) {
            const tl_nav_corner_vertex *end = &graph->vertices[to[k]];
            double x = (double)end->x - (double)from->x;
            double z = (double)end->z - (double)from->z;
            tl_nav_visibility_edge edge = { to[k], end->x, end->z, tl_nav_turns_at(end, x, z, graph->rounding) };
            graph->edges[k] = edge;
        }
    }
}

static tl_result make_edges(graph_baker *b)
{
    TL_TRY(tl_stage_add(&b->stage, 0));
    tl_nav_visibility_graph *graph = b->graph;
    const uint64_t room = b->sights.count + (b->reuse.old != NULL ? b->reuse.old->edge_count : 0);
    if (room > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    const uint64_t places = (uint64_t)graph->vertex_count + 1;
    uint32_t *first = tl_allocate_array(&b->allocator, places, sizeof *first);
    uint32_t *seen = tl_allocate_array(&b->allocator, b->sights.count, sizeof *seen);
    uint32_t *to = tl_allocate_array(&b->allocator, room, sizeof *to);
    if (first != NULL && seen != NULL && to != NULL) {
        group(&b->sights, graph->vertex_count, first, seen);
        gather_ends(b, first, seen, to);
        graph->edges = tl_allocate_array(&b->allocator, graph->edge_count, sizeof *graph->edges);
    }
    if (graph->edges != NULL) {
        fill_edges(graph, to);
    }
    tl_release_array(&b->allocator, first, places, sizeof *first);
    tl_release_array(&b->allocator, seen, b->sights.count, sizeof *seen);
    tl_release_array(&b->allocator, to, room, sizeof *to);
    return graph->edges != NULL ? TL_OK : TL_ERR_MEMORY;
}

static tl_result find_vertices(graph_baker *b)
{
    tl_nav_visibility_graph *graph = b->graph;
    b->fan_count = b->navmesh->last_fan + 1;
    b->vertex_of = tl_allocate_array(&b->allocator, b->fan_count, sizeof *b->vertex_of);
    if (b->vertex_of == NULL) {
        return TL_ERR_MEMORY;
    }
    graph->vertex_count = count_vertices(b);
    graph->slot_count = b->navmesh->slot_count;
    graph->vertices = tl_allocate_array(&b->allocator, (uint64_t)graph->vertex_count + 1, sizeof *graph->vertices);
    graph->landmarks = tl_allocate_array(&b->allocator, graph->vertex_count, sizeof *graph->landmarks);
    graph->slot_first = tl_allocate_array(&b->allocator, graph->slot_count, sizeof *graph->slot_first);
    graph->slot_salt = tl_allocate_array(&b->allocator, graph->slot_count, sizeof *graph->slot_salt);
    if (graph->vertices == NULL || graph->landmarks == NULL || graph->slot_first == NULL || graph->slot_salt == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(graph->vertices, 0, ((size_t)graph->vertex_count + 1) * sizeof *graph->vertices);
    // Of all tiles so far: it grows where the world does, and not with an edit inside.
    graph->rounding = TL_NAV_ON_LINE * (double)b->navmesh->extent;
    fill_corner_vertices(b);
    return TL_OK;
}

static tl_result bake_graph(graph_baker *b)
{
    TL_TRY(find_vertices(b));
    TL_TRY(make_look_query(b, FIRST_WEDGES));
    TL_TRY(tl_nav_find_reuse(b->navmesh, b->graph, b->vertex_of, b->fan_count, &b->reuse));
    b->stage.total = b->graph->vertex_count;
    for (uint32_t i = 0; i < b->graph->vertex_count; i++) {
        if (tl_nav_is_reused(&b->reuse, i)) {
            tell_ends(b, i);
            TL_TRY(b->result);
        } else {
            TL_TRY(look_from(b, i));
            b->graph->looked++;
        }
        TL_TRY(tl_stage_add(&b->stage, 1));
    }
    TL_TRY(make_edges(b));
    TL_TRY(tl_nav_group_cones(&b->cones, b->navmesh, b->graph, &b->reuse, &b->stage));
    TL_TRY(tl_stage_end(&b->stage));
    return tl_nav_find_landmarks(&b->allocator, b->stage.host, &b->reuse, b->graph);
}

uint64_t tl_nav_visibility_graph_size(const tl_nav_visibility_graph *graph)
{
    const uint64_t vertex_size = sizeof *graph->vertices + sizeof *graph->landmarks;
    return sizeof *graph + (uint64_t)graph->vertex_count * vertex_size + sizeof *graph->vertices +
           (uint64_t)graph->edge_count * sizeof *graph->edges +
           (uint64_t)graph->slot_count * (sizeof *graph->slot_first + sizeof *graph->slot_salt) +
           tl_nav_cones_size(&graph->cones, graph->polygon_count);
}

void tl_nav_free_visibility_graph(const tl_allocator *allocator, tl_nav_visibility_graph *graph)
{
    if (graph != NULL) {
        tl_release_array(allocator, graph->vertices, (uint64_t)graph->vertex_count + 1, sizeof *graph->vertices);
        tl_release_array(allocator, graph->landmarks, graph->vertex_count, sizeof *graph->landmarks);
        tl_release_array(allocator, graph->edges, graph->edge_count, sizeof *graph->edges);
        tl_release_array(allocator, graph->slot_first, graph->slot_count, sizeof *graph->slot_first);
        tl_release_array(allocator, graph->slot_salt, graph->slot_count, sizeof *graph->slot_salt);
        tl_nav_free_cones(allocator, graph);
        tl_nav_free_corner_distances(allocator, graph);
        tl_nav_free_legs(allocator, graph);
        tl_release_array(allocator, graph, 1, sizeof *graph);
    }
}

tl_result tl_nav_bake_visibility_graph(const tl_navmesh *navmesh, const tl_host *host,
                                       tl_nav_visibility_graph **graph_out)
{
    graph_baker b;
    memset(&b, 0, sizeof b);
    b.navmesh = navmesh;
    b.allocator = navmesh->allocator;
    b.cones.allocator = &b.allocator;
    b.graph = tl_allocate_array(&b.allocator, 1, sizeof *b.graph);
    if (b.graph == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(b.graph, 0, sizeof *b.graph);
    tl_result result = tl_stage_begin(&b.stage, host, "visibility graph", 0);
    result = result == TL_OK ? bake_graph(&b) : result;
    tl_nav_query_release(b.query);
    tl_release_array(&b.allocator, b.sights.pairs, b.sights.capacity, sizeof *b.sights.pairs);
    tl_release_array(&b.allocator, b.cones.cones, b.cones.capacity, sizeof *b.cones.cones);
    tl_release_array(&b.allocator, b.vertex_of, b.fan_count, sizeof *b.vertex_of);
    tl_nav_free_reuse(&b.allocator, b.graph, &b.reuse);
    if (result != TL_OK) {
        tl_nav_free_visibility_graph(&b.allocator, b.graph);
        return result;
    }
    *graph_out = b.graph;
    return TL_OK;
}
