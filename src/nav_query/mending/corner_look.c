// SPDX-License-Identifier: MIT
//
// Looking around from a corner vertex: all that is visible is found once, by the wedges of the exact search.
//
// An edge needs two corner vertices that see one another, and at both ends walls on the side to which a path would
// turn: few lines of sight qualify.

#include "nav_query/mending/corner_look.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/search/query_memory.h"

#include <string.h>

// Wedges that one look around may need at first. It is doubled where that is too few.
enum { FIRST_WEDGES = 4096 };

static tl_result make_look_query(tl_nav_corner_look *look, uint32_t max_nodes)
{
    tl_nav_query_release(look->query);
    look->query = NULL;
    const tl_nav_query_sizes none = { 0, 0 };
    return tl_nav_query_allocate(max_nodes, none, look->changes->allocator, &look->query);
}

tl_result tl_nav_begin_looks(const tl_nav_graph_changes *changes, tl_nav_corner_look *look_out)
{
    memset(look_out, 0, sizeof *look_out);
    const uint32_t slots = changes->graph->slot_count;
    look_out->changes = changes;
    look_out->cones.allocator = changes->allocator;
    look_out->last_looks = (uint32_t *)tl_allocate_array(changes->allocator, slots, sizeof *look_out->last_looks);
    if (look_out->last_looks == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(look_out->last_looks, 0, slots * sizeof *look_out->last_looks);
    return make_look_query(look_out, FIRST_WEDGES);
}

void tl_nav_end_looks(tl_nav_corner_look *look)
{
    const tl_allocator *allocator = look->changes->allocator;
    tl_nav_query_release(look->query);
    tl_nav_free_pairs(allocator, &look->seen.edges);
    tl_nav_free_pairs(allocator, &look->seen.reaches);
    tl_release_array(allocator, look->cones.cones, look->cones.capacity, sizeof *look->cones.cones);
    tl_release_array(allocator, look->last_looks, look->changes->graph->slot_count, sizeof *look->last_looks);
}

static void note_sight(void *user, uint32_t turn)
{
    tl_nav_corner_look *look = (tl_nav_corner_look *)user;
    const tl_nav_visibility_graph *graph = look->changes->graph;
    const uint32_t seen = tl_nav_find_name(&graph->names, turn);
    TL_ASSERT(seen != TL_NAV_NO_VERTEX);
    const tl_nav_corner_vertex *from = &graph->vertices[look->vertex];
    const tl_nav_corner_vertex *to = &graph->vertices[seen];
    const double x = (double)to->x - (double)from->x, z = (double)to->z - (double)from->z;
    if (look->result == TL_OK && seen != look->vertex && (x != 0.0 || z != 0.0) &&
        tl_nav_turns_at(from, -x, -z, graph->rounding) != 0 && tl_nav_turns_at(to, x, z, graph->rounding) != 0) {
        // Each end may have missed the other by rounding.
        const tl_allocator *allocator = look->changes->allocator;
        look->result = tl_nav_add_pair(allocator, &look->seen.edges, look->vertex, seen);
        look->result =
            look->result == TL_OK ? tl_nav_add_pair(allocator, &look->seen.edges, seen, look->vertex) : look->result;
    }
}

static tl_result see_from(tl_nav_corner_look *look)
{
    const tl_nav_corner_vertex *from = &look->changes->graph->vertices[look->vertex];
    tl_nav_shortest_search start;
    memset(&start, 0, sizeof start);
    start.navmesh = look->changes->navmesh;
    start.start_slot = from->place.slot;
    start.start_polygon = from->place.polygon;
    start.start = tl_vec3_make(from->x, from->y, from->z);
    const tl_nav_sight sight = { note_sight, look, &from->walls };
    start.query = look->query;
    while (!tl_nav_see(&start, &sight)) {
        if (look->query->max_nodes > TL_NAV_MAX_QUERY_NODES / 2) {
            return TL_ERR_LIMIT;
        }
        TL_TRY(make_look_query(look, 2 * look->query->max_nodes));
        start.query = look->query;
    }
    return look->result;
}

static tl_result note_reach(tl_nav_corner_look *look, uint32_t slot)
{
    if (look->last_looks[slot] == look->look_count) {
        return TL_OK;
    }
    look->last_looks[slot] = look->look_count;
    return tl_nav_add_pair(look->changes->allocator, &look->seen.reaches, look->vertex, slot);
}

tl_result tl_nav_look_around(tl_nav_corner_look *look, uint32_t vertex)
{
    look->vertex = vertex;
    look->look_count++;
    TL_TRY(see_from(look));
    for (uint32_t i = 0; i < look->query->wedge_count; i++) {
        const uint64_t before = look->cones.count;
        TL_TRY(tl_nav_add_cones(&look->cones, look->changes->graph, vertex, &look->query->wedges[i]));
        if (look->cones.count > before) {
            TL_TRY(note_reach(look, look->query->wedges[i].slot));
        }
    }
    return TL_OK;
}
