// SPDX-License-Identifier: MIT
//
// What an edit leaves of a visibility graph: the edges and cones of all corner vertices that cannot see the change.
//
// A tile that came or went is known by its slot's salt, and a slot keeps the number of the last edit that changed what
// a search sees in it (tl_nav_note_edit). Where the tile stayed, an edit beside it has changed no more than its
// polygons at portals that lead to tiles that came, or to none, and those at vertices with new names; names are handed
// out once, so the same name means the same vertex. A corner vertex sees what it saw where none of its cones, which
// hold all that it can turn from or to, lies in a polygon that may have changed, and where all vertices at the ends of
// its edges still have their names. The others look around anew, and their edges are noted at both ends; so a graph
// that was mended has the edges of one that is baked afresh, but for those that only rounding tells apart.

#include "nav_query/prepared/graph_reuse.h"

#include "base/arena.h"

#include <string.h>

static uint32_t polygons_end(const tl_nav_visibility_graph *graph, uint32_t slot)
{
    return slot + 1 < graph->slot_count ? graph->slot_first[slot + 1] : graph->polygon_count;
}

// Names the vertices of both graphs to one another.
static void match_names(const uint32_t *vertex_of, uint32_t fan_count, uint32_t vertex_count, tl_nav_graph_reuse *reuse)
{
    const tl_nav_visibility_graph *old = reuse->old;
    memset(reuse->before, 0xff, vertex_count * sizeof *reuse->before);
    for (uint32_t i = 0; i < old->vertex_count; i++) {
        const uint32_t turn = old->vertices[i].turn;
        reuse->now[i] = turn < fan_count ? vertex_of[turn] : TL_NAV_NO_VERTEX;
        if (reuse->now[i] != TL_NAV_NO_VERTEX) {
            reuse->before[reuse->now[i]] = i;
        }
    }
}

// Whether an edge may have been another before an edit beside its tile.
static bool may_be_new(const tl_navmesh *navmesh, const tl_nav_graph_reuse *reuse, uint32_t slot, tl_nav_ring_edge edge,
                       const uint32_t *vertex_of)
{
    const uint32_t turn = tl_nav_turn_of(&navmesh->slots[slot].rings, edge);
    if (turn != 0 && reuse->before[vertex_of[turn]] == TL_NAV_NO_VERTEX) {
        return true;
    }
    if (!tl_nav_ring_is_open(edge.to)) {
        return tl_nav_ring_twin_hint(edge) == TL_NAV_RING_ON_PORTAL;
    }
    return (edge.to & TL_NAV_RING_SEAM) != 0 &&
           !tl_nav_is_tile_reused(navmesh, reuse, tl_nav_ring_across(navmesh, slot, edge.to).slot);
}

static bool may_polygon_be_new(const tl_navmesh *navmesh, const tl_nav_graph_reuse *reuse, uint32_t slot,
                               uint32_t polygon, const uint32_t *vertex_of)
{
    const tl_nav_ring ring = tl_nav_ring_at(navmesh, slot, polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        if (may_be_new(navmesh, reuse, slot, tl_nav_ring_edge_at(&ring, i), vertex_of)) {
            return true;
        }
    }
    return false;
}

// Strikes out the vertices that see into polygons which may have changed.
static void drop_onlookers(const tl_navmesh *navmesh, const uint32_t *vertex_of, tl_nav_graph_reuse *reuse)
{
    const tl_nav_visibility_graph *old = reuse->old;
    for (uint32_t slot = 0; slot < old->slot_count; slot++) {
        const bool stays = tl_nav_is_tile_reused(navmesh, reuse, slot);
        if (stays && navmesh->slots[slot].last_edit.number <= navmesh->graph_edit) {
            continue;
        }
        for (uint32_t p = old->slot_first[slot]; p < polygons_end(old, slot); p++) {
            if (stays && !may_polygon_be_new(navmesh, reuse, slot, p - old->slot_first[slot], vertex_of)) {
                continue;
            }
            for (uint32_t i = old->cones.first[p]; i < old->cones.first[p + 1]; i++) {
                reuse->now[tl_nav_cone_vertex(&old->cones, i)] = TL_NAV_NO_VERTEX;
            }
        }
    }
}

// Strikes out those of tiles that went, and those that saw a vertex which is gone. `is_gone`: by old vertex, whether
// its name is no more.
static void drop_neighbours(const tl_navmesh *navmesh, const bool *is_gone, tl_nav_graph_reuse *reuse)
{
    const tl_nav_visibility_graph *old = reuse->old;
    for (uint32_t i = 0; i < old->vertex_count; i++) {
        bool is_left = tl_nav_is_tile_reused(navmesh, reuse, old->vertices[i].place.slot);
        for (uint32_t k = old->vertices[i].first_edge; k < old->vertices[i + 1].first_edge && is_left; k++) {
            is_left = !is_gone[old->edges[k].to];
        }
        reuse->now[i] = is_left ? reuse->now[i] : TL_NAV_NO_VERTEX;
    }
}

tl_result tl_nav_find_reuse(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph, const uint32_t *vertex_of,
                            uint32_t fan_count, tl_nav_graph_reuse *reuse_out)
{
    const tl_allocator *allocator = &navmesh->allocator;
    const tl_nav_visibility_graph *old = navmesh->graph;
    memset(reuse_out, 0, sizeof *reuse_out);
    // What is on a line was judged by the old graph's rounding.
    if (old == NULL || old->rounding < graph->rounding) {
        return TL_OK;
    }
    graph->rounding = old->rounding;
    reuse_out->old = old;
    reuse_out->now = tl_allocate_array(allocator, old->vertex_count, sizeof *reuse_out->now);
    reuse_out->before = tl_allocate_array(allocator, graph->vertex_count, sizeof *reuse_out->before);
    bool *is_gone = tl_allocate_array(allocator, old->vertex_count, sizeof *is_gone);
    const bool fits = reuse_out->now != NULL && reuse_out->before != NULL && is_gone != NULL;
    if (fits) {
        match_names(vertex_of, fan_count, graph->vertex_count, reuse_out);
        for (uint32_t i = 0; i < old->vertex_count; i++) {
            is_gone[i] = reuse_out->now[i] == TL_NAV_NO_VERTEX;
        }
        drop_onlookers(navmesh, vertex_of, reuse_out);
        drop_neighbours(navmesh, is_gone, reuse_out);
    }
    tl_release_array(allocator, is_gone, old->vertex_count, sizeof *is_gone);
    return fits ? TL_OK : TL_ERR_MEMORY;
}

void tl_nav_free_reuse(const tl_allocator *allocator, const tl_nav_visibility_graph *graph, tl_nav_graph_reuse *reuse)
{
    if (reuse->old != NULL) {
        tl_release_array(allocator, reuse->now, reuse->old->vertex_count, sizeof *reuse->now);
        tl_release_array(allocator, reuse->before, graph->vertex_count, sizeof *reuse->before);
    }
    memset(reuse, 0, sizeof *reuse);
}
