// SPDX-License-Identifier: MIT
//
// Finding the roads of a navmesh: from each bend all that is seen is looked at once, by the wedges of the exact search.
//
// A road needs a bend that sees another one, and at both ends walls on the hand to which a path would turn: few lines
// of sight are left. On a city of 25,000 polygons there are 25,000 bends with 14 roads each, found in 0.4 s.
// Where a polygon is linked to two floors over the same stretch of a seam, a vertex has several free ways around it
// (fans.c) and no one number; such a navmesh gets no roads.
// Source: de Berg et al., Computational Geometry, 3rd edition, 2008, chapter 15 (the visibility graph and why only
// lines that touch both obstacles count).

#include "nav_query/prepared/roads.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/exact/wedge_sight.h"

#include <string.h>

// Wedges that one look around may need at first. It is doubled where that is too few.
enum { FIRST_WEDGES = 4096 };

// Pairs of numbers, as many as come.
typedef struct pair_list {
    uint64_t *pairs; // key << 32 | value
    uint64_t count, capacity;
} pair_list;

typedef struct builder {
    tl_navmesh *navmesh;
    tl_allocator allocator;
    tl_nav_roads *roads;
    uint32_t *bend_of; // [last_fan + 1], by number; UINT32_MAX: none
    uint32_t fan_count;
    tl_nav_query *query;
    pair_list sights; // bend and bend
    tl_nav_view_list views;
    uint32_t bend;    // that looks
    tl_result result; // of the lists
} builder;

static void add_pair(builder *b, uint32_t key, uint32_t value)
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

static uint32_t count_bends(builder *b)
{
    uint32_t bends = 0;
    memset(b->bend_of, 0xff, b->fan_count * sizeof *b->bend_of);
    for (uint32_t slot = 0; slot < b->navmesh->slot_count; slot++) {
        const tl_nav_rings *rings = &b->navmesh->slots[slot].rings;
        uint32_t edges = b->navmesh->slots[slot].tile != NULL ? rings->cells[rings->polygon_count].first : 0;
        for (uint32_t i = 0; i < edges; i++) {
            uint32_t turn = rings->edges[i].turn;
            if (turn != 0 && b->bend_of[turn] == UINT32_MAX) {
                b->bend_of[turn] = bends++;
            }
        }
    }
    return bends;
}

static void fill_bend(builder *b, tl_nav_ring_place place)
{
    uint32_t count = 0;
    const tl_nav_ring_edge *vertex = tl_nav_ring_at(b->navmesh, place.slot, place.polygon, &count) + place.edge;
    const tl_nav_rings *rings = &b->navmesh->slots[place.slot].rings;
    if (vertex->turn == 0 || b->roads->bends[b->bend_of[vertex->turn]].turn != 0) {
        return;
    }
    tl_nav_bend bend = { vertex->x,    vertex->y, vertex->z,
                         vertex->turn, 0,         rings->walls[rings->cells[place.polygon].first + place.edge],
                         place };
    tl_nav_find_fan(b->navmesh, NULL, &bend.place);
    b->roads->bends[b->bend_of[vertex->turn]] = bend;
    double x = fabs((double)vertex->x);
    double z = fabs((double)vertex->z);
    b->roads->rounding = fmax(b->roads->rounding, TL_NAV_ON_LINE * fmax(x, z));
}

static void fill_bends(builder *b)
{
    for (uint32_t slot = 0; slot < b->navmesh->slot_count; slot++) {
        const tl_nav_rings *rings = &b->navmesh->slots[slot].rings;
        b->roads->slot_first[slot] = b->roads->polygon_count;
        for (uint32_t p = 0; b->navmesh->slots[slot].tile != NULL && p < rings->polygon_count; p++) {
            b->roads->polygon_count++;
            for (uint32_t i = 0; i < rings->cells[p + 1].first - rings->cells[p].first; i++) {
                tl_nav_ring_place place = { slot, p, i };
                fill_bend(b, place);
            }
        }
    }
}

static void note_sight(void *user, uint32_t turn)
{
    builder *b = user;
    uint32_t seen = b->bend_of[turn];
    const tl_nav_bend *from = &b->roads->bends[b->bend];
    const tl_nav_bend *to = &b->roads->bends[seen];
    double x = (double)to->x - (double)from->x;
    double z = (double)to->z - (double)from->z;
    if (seen != b->bend && (x != 0.0 || z != 0.0) && tl_nav_hands_at(from, -x, -z, b->roads->rounding) != 0 &&
        tl_nav_hands_at(to, x, z, b->roads->rounding) != 0) {
        // Each end may have missed the other by rounding.
        add_pair(b, b->bend, seen);
        add_pair(b, seen, b->bend);
    }
}

static tl_result make_query(builder *b, uint32_t max_nodes)
{
    tl_nav_query_destroy(b->query);
    tl_nav_query_def def = { max_nodes, &b->allocator };
    return tl_nav_query_create(&def, &b->query);
}

static tl_result look_from(builder *b, uint32_t bend)
{
    const tl_nav_bend *from = &b->roads->bends[bend];
    tl_nav_shortest_search start;
    memset(&start, 0, sizeof start);
    start.navmesh = b->navmesh;
    start.start_slot = from->place.slot;
    start.start_polygon = from->place.polygon;
    start.start = tl_vec3_make(from->x, from->y, from->z);
    tl_nav_sight sight = { note_sight, b };
    b->bend = bend;
    start.query = b->query;
    while (!tl_nav_see(&start, &sight)) {
        if (b->query->max_nodes > UINT32_MAX / 4) {
            return TL_ERR_LIMIT;
        }
        TL_TRY(make_query(b, 2 * b->query->max_nodes));
        start.query = b->query;
    }
    for (uint32_t i = 0; i < b->query->wedge_count; i++) {
        TL_TRY(tl_nav_note_views(&b->views, b->roads, bend, &b->query->wedges[i]));
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

// Ascending, each once; returns how many are left. A bend's roads are few.
static uint32_t sort_unique(uint32_t *values, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t value = values[i];
        uint32_t at = kept;
        while (at > 0 && values[at - 1] > value) {
            at--;
        }
        if (at > 0 && values[at - 1] == value) {
            continue;
        }
        memmove(values + at + 1, values + at, (kept - at) * sizeof *values);
        values[at] = value;
        kept++;
    }
    return kept;
}

static tl_result make_roads(builder *b)
{
    tl_nav_roads *roads = b->roads;
    uint32_t count = roads->bend_count;
    uint32_t *first = tl_allocate_array(&b->allocator, (uint64_t)count + 1, sizeof *first);
    uint32_t *to = tl_allocate_array(&b->allocator, b->sights.count, sizeof *to);
    if (first != NULL && to != NULL) {
        group(&b->sights, count, first, to);
        for (uint32_t i = 0; i < count; i++) {
            uint32_t end = sort_unique(to + first[i], first[i + 1] - first[i]);
            roads->bends[i].first_road = roads->road_count;
            memmove(to + roads->road_count, to + first[i], end * sizeof *to);
            roads->road_count += end;
        }
        roads->bends[count].first_road = roads->road_count;
        roads->roads = tl_allocate_array(&b->allocator, roads->road_count, sizeof *roads->roads);
    }
    for (uint32_t i = 0; i < count && roads->roads != NULL; i++) {
        const tl_nav_bend *from = &roads->bends[i];
        for (uint32_t k = from[0].first_road; k < from[1].first_road; k++) {
            const tl_nav_bend *end = &roads->bends[to[k]];
            double x = (double)end->x - (double)from->x;
            double z = (double)end->z - (double)from->z;
            tl_nav_road road = { to[k], end->x, end->z, tl_nav_hands_at(end, x, z, roads->rounding) };
            roads->roads[k] = road;
        }
    }
    tl_release_array(&b->allocator, first, (uint64_t)count + 1, sizeof *first);
    tl_release_array(&b->allocator, to, b->sights.count, sizeof *to);
    return roads->roads != NULL ? TL_OK : TL_ERR_MEMORY;
}

static tl_result find_bends(builder *b)
{
    tl_nav_roads *roads = b->roads;
    b->fan_count = b->navmesh->last_fan + 1;
    b->bend_of = tl_allocate_array(&b->allocator, b->fan_count, sizeof *b->bend_of);
    if (b->bend_of == NULL) {
        return TL_ERR_MEMORY;
    }
    roads->bend_count = count_bends(b);
    roads->slot_count = b->navmesh->slot_count;
    roads->bends = tl_allocate_array(&b->allocator, (uint64_t)roads->bend_count + 1, sizeof *roads->bends);
    roads->marks = tl_allocate_array(&b->allocator, roads->bend_count, sizeof *roads->marks);
    roads->slot_first = tl_allocate_array(&b->allocator, roads->slot_count, sizeof *roads->slot_first);
    if (roads->bends == NULL || roads->marks == NULL || roads->slot_first == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(roads->bends, 0, ((size_t)roads->bend_count + 1) * sizeof *roads->bends);
    fill_bends(b);
    return TL_OK;
}

static tl_result build(builder *b)
{
    TL_TRY(find_bends(b));
    TL_TRY(make_query(b, FIRST_WEDGES));
    for (uint32_t i = 0; i < b->roads->bend_count; i++) {
        TL_TRY(look_from(b, i));
    }
    if (b->sights.count > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    TL_TRY(make_roads(b));
    TL_TRY(tl_nav_group_views(&b->views, b->navmesh, b->roads));
    return tl_nav_mark_roads(&b->allocator, b->roads);
}

uint64_t tl_nav_roads_size(const tl_nav_roads *roads)
{
    const uint64_t bend_size = sizeof *roads->bends + sizeof *roads->marks;
    return sizeof *roads + (uint64_t)roads->bend_count * bend_size + sizeof *roads->bends +
           (uint64_t)roads->road_count * sizeof *roads->roads +
           (uint64_t)roads->slot_count * sizeof *roads->slot_first +
           ((uint64_t)roads->polygon_count + 1) * sizeof *roads->views.first +
           roads->views.size * sizeof *roads->views.block;
}

void tl_nav_free_roads(const tl_allocator *allocator, tl_nav_roads *roads)
{
    if (roads != NULL) {
        tl_release_array(allocator, roads->bends, (uint64_t)roads->bend_count + 1, sizeof *roads->bends);
        tl_release_array(allocator, roads->marks, roads->bend_count, sizeof *roads->marks);
        tl_release_array(allocator, roads->roads, roads->road_count, sizeof *roads->roads);
        tl_release_array(allocator, roads->slot_first, roads->slot_count, sizeof *roads->slot_first);
        tl_nav_free_views(allocator, roads);
        tl_nav_free_bend_table(allocator, roads);
        tl_nav_free_hub_labels(allocator, roads);
        tl_release_array(allocator, roads, 1, sizeof *roads);
    }
}

tl_result tl_nav_make_roads(tl_navmesh *navmesh, tl_nav_roads **roads_out)
{
    builder b;
    memset(&b, 0, sizeof b);
    b.navmesh = navmesh;
    b.allocator = navmesh->allocator;
    b.views.allocator = &b.allocator;
    b.roads = tl_allocate_array(&b.allocator, 1, sizeof *b.roads);
    if (b.roads == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(b.roads, 0, sizeof *b.roads);
    tl_result result = build(&b);
    tl_nav_query_destroy(b.query);
    tl_release_array(&b.allocator, b.sights.pairs, b.sights.capacity, sizeof *b.sights.pairs);
    tl_release_array(&b.allocator, b.views.views, b.views.capacity, sizeof *b.views.views);
    tl_release_array(&b.allocator, b.bend_of, b.fan_count, sizeof *b.bend_of);
    if (result != TL_OK) {
        tl_nav_free_roads(&b.allocator, b.roads);
        return result;
    }
    b.roads->edit = navmesh->edit.number;
    *roads_out = b.roads;
    return TL_OK;
}
