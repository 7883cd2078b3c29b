// SPDX-License-Identifier: MIT
//
// Mending a visibility graph after edits, or making one from nothing, as if all tiles had come by edits: who may see a
// change looks around (corner_look.c), then the tiles whose corner vertices or polygons that concerns get new blocks
// (corner_sights.c, corner_cones.c), and landmarks are mended (landmark_mend.c). All but one comparison a slot goes by
// what has changed, not by how large the world is.

#include "nav_query/mending/graph_mend.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/mending/corner_look.h"
#include "nav_query/mending/landmark_mend.h"

#include <string.h>

typedef struct graph_mend {
    tl_nav_graph_changes changes;
    tl_nav_change_sectors sectors;
    tl_nav_corner_look look;
    tl_stage stage;        // corner vertices that have looked around
    uint32_t *first_cones; // [slot_count + 1], by slot: where its new cones begin
    bool *is_dropped;      // of one tile
    uint64_t dropped_capacity;
} graph_mend;

// Of all tiles so far: it grows where the world does, and not with an edit inside.
static double rounding_of(const tl_navmesh *navmesh)
{
    return TL_NAV_ON_LINE * (double)navmesh->extent;
}

bool tl_nav_can_mend_graph(const tl_navmesh *navmesh, const tl_nav_visibility_graph *graph)
{
    // What is on a line was judged by the graph's rounding, and names are given out anew before they run out.
    return graph != NULL && graph->rounding >= rounding_of(navmesh) && graph->last_fan <= navmesh->last_fan;
}

// Which of a tile's cones go: those beyond changes, and all of corner vertices that have looked all around, or are
// gone.
static tl_result find_dropped(graph_mend *m, uint32_t slot, bool *any_out)
{
    const tl_nav_visibility_graph *graph = m->changes.graph;
    const tl_nav_corner_cones *cones = &graph->tiles[slot].cones;
    if (m->dropped_capacity < cones->count) {
        bool *grown = tl_allocate_array(m->changes.allocator, 2 * (uint64_t)cones->count, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        tl_release_array(m->changes.allocator, m->is_dropped, m->dropped_capacity, sizeof *grown);
        m->is_dropped = grown;
        m->dropped_capacity = 2 * (uint64_t)cones->count;
    }
    *any_out = false;
    for (uint32_t i = 0; i < cones->count; i++) {
        m->is_dropped[i] = graph->marks[tl_nav_cone_vertex(cones, i)] > TL_NAV_MARK_LOOKS;
        *any_out = *any_out || m->is_dropped[i];
    }
    const tl_nav_pair_list *dropped = &m->sectors.dropped;
    for (uint64_t i = tl_nav_find_pair(dropped, slot); i < dropped->count && dropped->items[i].key >> 32 == slot; i++) {
        m->is_dropped[(uint32_t)dropped->items[i].key] = true;
        *any_out = true;
    }
    return TL_OK;
}

static tl_result remake_tile_cones(graph_mend *m, uint32_t slot)
{
    const tl_navmesh *navmesh = m->changes.navmesh;
    tl_nav_corner_cones *cones = &m->changes.graph->tiles[slot].cones;
    const uint32_t first = m->first_cones[slot], count = m->first_cones[slot + 1] - first;
    const bool is_other = (m->changes.slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0;
    bool drops = false;
    if (is_other) {
        m->changes.graph->tile_bytes -= tl_nav_cones_size(cones);
        tl_nav_free_cones(m->changes.allocator, cones);
    }
    if (is_other && (slot >= navmesh->slot_count || navmesh->slots[slot].tile == NULL)) {
        return TL_OK;
    }
    TL_TRY(find_dropped(m, slot, &drops));
    const uint32_t *old_polygons = tl_nav_old_polygons(&m->changes, slot);
    if (!is_other && !drops && count == 0 && old_polygons == NULL) {
        return TL_OK;
    }
    return tl_nav_remake_cones(m->changes.allocator, m->changes.graph, slot, navmesh->slots[slot].rings.polygon_count,
                               old_polygons, m->is_dropped, m->look.cones.cones + first, count);
}

static tl_result remake_cones(graph_mend *m)
{
    tl_nav_graph_changes *c = &m->changes;
    tl_nav_cone_list *cones = &m->look.cones;
    m->first_cones = tl_allocate_array(c->allocator, (uint64_t)c->graph->slot_count + 1, sizeof *m->first_cones);
    if (m->first_cones == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_nav_group_cones(cones, c->graph->slot_count, m->first_cones));
    for (uint64_t i = 0; i < m->look.seen.reaches.count; i++) {
        TL_TRY(tl_nav_note_slot(c, (uint32_t)m->look.seen.reaches.items[i].key, TL_NAV_SLOT_CONES));
    }
    TL_TRY(tl_nav_sort_pairs(c->allocator, &m->sectors.dropped, &m->stage));
    for (uint64_t i = 0; i < m->sectors.dropped.count; i++) {
        TL_TRY(tl_nav_note_slot(c, (uint32_t)(m->sectors.dropped.items[i].key >> 32), TL_NAV_SLOT_CONES));
    }
    for (uint64_t i = 0; i < c->slots.count; i++) {
        if ((c->slot_bits[c->slots.numbers[i]] & TL_NAV_SLOT_CONES) != 0) {
            TL_TRY(remake_tile_cones(m, c->slots.numbers[i]));
        }
        TL_TRY(tl_stage_tick(&m->stage, i));
    }
    return TL_OK;
}

static tl_result mend(graph_mend *m, const tl_navmesh *navmesh, tl_nav_visibility_graph *graph)
{
    TL_TRY(tl_nav_find_changes(navmesh, graph, &m->changes));
    TL_TRY(tl_nav_find_change_sectors(&m->changes, &m->sectors));
    TL_TRY(tl_nav_begin_looks(&m->sectors, &m->look));
    const tl_nav_number_list *lookers = &m->changes.lookers;
    m->stage.total = lookers->count;
    for (uint64_t i = 0; i < lookers->count; i++) {
        TL_TRY(tl_nav_look_from(&m->look, lookers->numbers[i]));
        TL_TRY(tl_stage_add(&m->stage, 1));
    }
    TL_TRY(tl_nav_remake_sights(&m->sectors, &m->look.seen, &m->stage));
    TL_TRY(remake_cones(m));
    TL_TRY(tl_stage_end(&m->stage));
    graph->looked = (uint32_t)lookers->count;
    graph->last_fan = navmesh->last_fan;
    TL_TRY(tl_nav_mend_landmarks(&m->changes, &m->look.seen.edges, m->stage.host));
    return tl_nav_settle_changes(&m->changes);
}

tl_result tl_nav_mend_graph(const tl_navmesh *navmesh, const tl_host *host, tl_nav_visibility_graph *graph)
{
    const tl_allocator *allocator = &navmesh->allocator;
    graph_mend m;
    memset(&m, 0, sizeof m);
    TL_TRY(tl_stage_begin(&m.stage, host, "visibility graph", 0));
    graph->rounding = graph->rounding > 0.0 ? graph->rounding : rounding_of(navmesh);
    TL_TRY(tl_nav_own_graph_arrays(navmesh, graph));
    m.changes.allocator = allocator;
    m.changes.graph = graph;
    m.look.changes = m.sectors.changes = &m.changes;
    const tl_result result = mend(&m, navmesh, graph);
    tl_nav_end_looks(&m.look);
    tl_nav_free_change_sectors(&m.sectors);
    tl_release_array(allocator, m.first_cones, (uint64_t)graph->slot_count + 1, sizeof *m.first_cones);
    tl_release_array(allocator, m.is_dropped, m.dropped_capacity, sizeof *m.is_dropped);
    tl_nav_free_changes(&m.changes);
    return result;
}
