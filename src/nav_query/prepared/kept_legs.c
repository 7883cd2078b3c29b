// SPDX-License-Identifier: MIT
//
// The polygons of each edge of the visibility graph, so that a path is put together from legs instead of walked.
//
// On levels whose table of distances answers a query, half of the query was walking along its path again to write its
// polygons. An edge is the same two places for every path, so it is walked once, here. Where a leg begins is not always
// told by the leg alone: a line along an edge leads into two polygons, and which is better depends on where the path
// comes from. Such legs are not kept; a query walks them. So the polygons are the same with and without.

#include "nav_query/prepared/kept_legs.h"

#include "nav_query/prepared/graph_path.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

// Longer legs are walked by each query.
enum { MAX_LEG_POLYGONS = 1024 };

typedef struct leg_keeper {
    const tl_navmesh *navmesh;
    tl_nav_visibility_graph *graph;
    tl_nav_kept_legs kept; // fans are complete
    uint64_t polygon_capacity, fan_capacity;
} leg_keeper;

static tl_nav_ref *room_for(const tl_allocator *allocator, tl_nav_ref **list, uint64_t count, uint64_t *capacity,
                            uint64_t more)
{
    while (*capacity - count < more) {
        tl_nav_ref *grown = tl_grow_array(allocator, *list, capacity, sizeof **list);
        if (grown == NULL) {
            return NULL;
        }
        *list = grown;
    }
    return *list + count;
}

static tl_result keep_fans(leg_keeper *k)
{
    tl_nav_kept_legs *kept = &k->kept;
    const tl_allocator *allocator = &k->navmesh->allocator;
    for (uint32_t v = 0; v < k->graph->vertex_room; v++) {
        tl_nav_ring_place fan[TL_NAV_MAX_FAN];
        kept->fan_first[v] = (uint32_t)kept->fan_count;
        if (k->graph->vertices[v].turn == 0) {
            continue; // a free number
        }
        const uint32_t count = tl_nav_fan_of(k->navmesh, &k->graph->vertices[v], fan);
        tl_nav_ref *to = room_for(allocator, &kept->fans, kept->fan_count, &k->fan_capacity, count);
        if (to == NULL) {
            return TL_ERR_MEMORY;
        }
        for (uint32_t i = 0; i < count; i++) {
            to[i] = tl_nav_make_ref(k->navmesh, fan[i].slot, fan[i].polygon);
        }
        kept->fan_count += count;
    }
    kept->fan_first[k->graph->vertex_room] = (uint32_t)kept->fan_count;
    return TL_OK;
}

// The only place of a vertex's fan into which a line leads, or TL_NAV_NO_PLACE.
static uint8_t only_entry(const tl_nav_line *line, const tl_nav_ring_place *fan, uint32_t count)
{
    uint8_t only = TL_NAV_NO_PLACE;
    for (uint32_t i = 0; i < count; i++) {
        if (tl_nav_line_enters(line, &fan[i])) {
            if (only != TL_NAV_NO_PLACE) {
                return TL_NAV_NO_PLACE;
            }
            only = (uint8_t)i;
        }
    }
    return only;
}

// The first place of a vertex's fan that is a polygon, or TL_NAV_NO_PLACE.
static uint8_t place_in_fan(const tl_nav_kept_legs *kept, uint32_t vertex, tl_nav_ref polygon)
{
    for (uint32_t i = kept->fan_first[vertex]; i < kept->fan_first[vertex + 1]; i++) {
        if (kept->fans[i] == polygon) {
            return (uint8_t)(i - kept->fan_first[vertex]);
        }
    }
    return TL_NAV_NO_PLACE;
}

static void keep_leg(const leg_keeper *k, uint32_t from, const tl_nav_visibility_edge *edge, tl_nav_ref *polygons,
                     tl_nav_kept_leg *leg, uint32_t *count_out)
{
    const tl_nav_corner_vertex *begin = &k->graph->vertices[from];
    const tl_nav_corner_vertex *end = &k->graph->vertices[edge->to];
    const tl_nav_line line = { k->navmesh,
                               (double)begin->x,
                               (double)begin->z,
                               (double)end->x - (double)begin->x,
                               (double)end->z - (double)begin->z,
                               end->turn,
                               TL_NAV_NO_SLOT,
                               TL_NO_POLYGON,
                               k->graph->rounding };
    tl_nav_ring_place fan[TL_NAV_MAX_FAN];
    leg->enters = only_entry(&line, fan, tl_nav_fan_of(k->navmesh, begin, fan));
    if (leg->enters == TL_NAV_NO_PLACE) {
        return;
    }
    tl_nav_trail trail = { polygons, MAX_LEG_POLYGONS, 0, 0, 0 };
    const tl_nav_ring_place *first = &fan[leg->enters];
    if (tl_nav_walk_line(&line, first->slot, first->polygon, &trail) == TL_NAV_LINE_ARRIVES &&
        trail.count <= MAX_LEG_POLYGONS) {
        leg->arrives = place_in_fan(&k->kept, edge->to, polygons[trail.count - 1]);
    }
    if (leg->arrives == TL_NAV_NO_PLACE) {
        leg->enters = TL_NAV_NO_PLACE;
        return;
    }
    *count_out = trail.count;
}

static tl_result keep_all(leg_keeper *k)
{
    tl_nav_kept_legs *kept = &k->kept;
    const tl_nav_visibility_graph *graph = k->graph;
    TL_TRY(keep_fans(k));
    tl_nav_kept_leg *leg = kept->legs;
    for (uint32_t v = 0; v < graph->vertex_room; v++) {
        kept->leg_first[v] = (uint32_t)(leg - kept->legs);
        for (uint32_t e = 0; e < graph->vertices[v].edge_count; e++, leg++) {
            tl_nav_ref *to = room_for(&k->navmesh->allocator, &kept->polygons, kept->polygon_count,
                                      &k->polygon_capacity, MAX_LEG_POLYGONS);
            uint32_t count = 0;
            if (to == NULL) {
                return TL_ERR_MEMORY;
            }
            leg->first = (uint32_t)kept->polygon_count;
            leg->enters = leg->arrives = TL_NAV_NO_PLACE;
            leg->padding = 0;
            keep_leg(k, v, &graph->vertices[v].edges[e], to, leg, &count);
            kept->polygon_count += count;
            if (kept->polygon_count > UINT32_MAX - MAX_LEG_POLYGONS) {
                return TL_ERR_LIMIT;
            }
        }
    }
    const tl_nav_kept_leg end = { (uint32_t)kept->polygon_count, TL_NAV_NO_PLACE, TL_NAV_NO_PLACE, 0 };
    kept->legs[graph->edge_count] = end;
    return TL_OK;
}

// Lists without what they have too much room for.
static tl_result trim(const tl_allocator *allocator, tl_nav_ref **list, uint64_t count, uint64_t capacity)
{
    tl_nav_ref *exact = tl_allocate_array(allocator, count, sizeof *exact);
    if (exact == NULL) {
        return TL_ERR_MEMORY;
    }
    if (count > 0) {
        memcpy(exact, *list, (size_t)count * sizeof *exact);
    }
    tl_release_array(allocator, *list, capacity, sizeof *exact);
    *list = exact;
    return TL_OK;
}

tl_result tl_nav_keep_legs(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph)
{
    const tl_allocator *allocator = &navmesh->allocator;
    leg_keeper k;
    memset(&k, 0, sizeof k);
    k.navmesh = navmesh;
    k.graph = graph;
    k.kept.legs = tl_allocate_array(allocator, (uint64_t)graph->edge_count + 1, sizeof *k.kept.legs);
    k.kept.leg_first = tl_allocate_array(allocator, graph->vertex_room, sizeof *k.kept.leg_first);
    k.kept.fan_first = tl_allocate_array(allocator, (uint64_t)graph->vertex_room + 1, sizeof *k.kept.fan_first);
    const bool fits = k.kept.legs != NULL && k.kept.leg_first != NULL && k.kept.fan_first != NULL;
    tl_result result = fits ? keep_all(&k) : TL_ERR_MEMORY;
    if (result == TL_OK) {
        result = trim(allocator, &k.kept.fans, k.kept.fan_count, k.fan_capacity);
        k.fan_capacity = result == TL_OK ? k.kept.fan_count : k.fan_capacity;
    }
    if (result == TL_OK) {
        result = trim(allocator, &k.kept.polygons, k.kept.polygon_count, k.polygon_capacity);
        k.polygon_capacity = result == TL_OK ? k.kept.polygon_count : k.polygon_capacity;
    }
    if (result != TL_OK) {
        tl_release_array(allocator, k.kept.legs, (uint64_t)graph->edge_count + 1, sizeof *k.kept.legs);
        tl_release_array(allocator, k.kept.leg_first, graph->vertex_room, sizeof *k.kept.leg_first);
        tl_release_array(allocator, k.kept.fan_first, (uint64_t)graph->vertex_room + 1, sizeof *k.kept.fan_first);
        tl_release_array(allocator, k.kept.fans, k.fan_capacity, sizeof *k.kept.fans);
        tl_release_array(allocator, k.kept.polygons, k.polygon_capacity, sizeof *k.kept.polygons);
        return result;
    }
    graph->kept = k.kept;
    return TL_OK;
}

void tl_nav_free_legs(const tl_allocator *allocator, tl_nav_visibility_graph *graph)
{
    tl_nav_kept_legs *kept = &graph->kept;
    tl_release_array(allocator, kept->legs, (uint64_t)graph->edge_count + 1, sizeof *kept->legs);
    tl_release_array(allocator, kept->leg_first, graph->vertex_room, sizeof *kept->leg_first);
    tl_release_array(allocator, kept->fan_first, (uint64_t)graph->vertex_room + 1, sizeof *kept->fan_first);
    tl_release_array(allocator, kept->fans, kept->fan_count, sizeof *kept->fans);
    tl_release_array(allocator, kept->polygons, kept->polygon_count, sizeof *kept->polygons);
    memset(kept, 0, sizeof *kept);
}

uint64_t tl_nav_kept_legs_size(const tl_nav_visibility_graph *graph)
{
    const tl_nav_kept_legs *kept = &graph->kept;
    if (kept->legs == NULL) {
        return 0;
    }
    return ((uint64_t)graph->edge_count + 1) * sizeof *kept->legs +
           (2 * (uint64_t)graph->vertex_room + 1) * sizeof *kept->fan_first +
           (kept->fan_count + kept->polygon_count) * sizeof *kept->fans;
}
