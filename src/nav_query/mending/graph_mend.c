// SPDX-License-Identifier: MIT
//
// Mending a visibility graph after edits, or making one from nothing, as if all tiles had come by edits: who may see a
// change looks around (all_looks.c), then the tiles whose corner vertices or polygons that concerns get new blocks
// (corner_sights.c, corner_cones.c), and landmarks are mended (landmark_mend.c). All but one comparison a slot goes by
// what has changed, not by how large the world is.

#include "nav_query/mending/graph_mend.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/mending/all_looks.h"
#include "nav_query/mending/landmark_mend.h"

#include <string.h>

// What a worker needs to make the cones of tiles.
typedef struct cone_worker {
    bool *is_dropped; // of one tile
    uint64_t dropped_capacity;
    uint64_t bytes_before, bytes; // of the blocks of its tiles
    tl_result result;             // of all of them; after a failure it makes none
} cone_worker;

typedef struct graph_mend {
    tl_nav_graph_changes changes;
    tl_nav_change_sectors sectors;
    tl_nav_all_looks looks;
    tl_stage stage; // corner vertices that have looked around
    cone_worker *workers;
    uint32_t worker_count;
} graph_mend;

// Tiles between two calls of progress, for a worker.
enum { TILES_A_CALL = 64 };

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
static tl_result find_dropped(const graph_mend *m, cone_worker *worker, uint32_t slot, bool *any_out)
{
    const tl_nav_visibility_graph *graph = m->changes.graph;
    const tl_nav_corner_cones *cones = &graph->tiles[slot].cones;
    if (worker->dropped_capacity < cones->count) {
        bool *grown = tl_allocate_array(m->changes.allocator, 2 * (uint64_t)cones->count, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        tl_release_array(m->changes.allocator, worker->is_dropped, worker->dropped_capacity, sizeof *grown);
        worker->is_dropped = grown;
        worker->dropped_capacity = 2 * (uint64_t)cones->count;
    }
    *any_out = false;
    for (uint32_t i = 0; i < cones->count; i++) {
        worker->is_dropped[i] = graph->marks[tl_nav_cone_vertex(cones, i)] > TL_NAV_MARK_LOOKS;
        *any_out = *any_out || worker->is_dropped[i];
    }
    const tl_nav_pair_list *dropped = &m->sectors.dropped;
    for (uint64_t i = tl_nav_find_pair(dropped, slot); i < dropped->count && dropped->items[i].key >> 32 == slot; i++) {
        worker->is_dropped[(uint32_t)dropped->items[i].key] = true;
        *any_out = true;
    }
    return TL_OK;
}

static tl_result remake_tile_cones(const graph_mend *m, cone_worker *worker, uint32_t slot)
{
    const tl_navmesh *navmesh = m->changes.navmesh;
    tl_nav_corner_cones *cones = &m->changes.graph->tiles[slot].cones;
    const uint32_t first = m->looks.first_cones[slot], count = m->looks.first_cones[slot + 1] - first;
    const tl_nav_corner_cone *fresh = count > 0 ? m->looks.cones + first : NULL;
    const bool is_other = (m->changes.slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0;
    bool drops = false;
    worker->bytes_before += tl_nav_cones_size(cones);
    if (is_other) {
        tl_nav_free_cones(m->changes.allocator, cones);
    }
    if (!is_other || (slot < navmesh->slot_count && navmesh->slots[slot].tile != NULL)) {
        TL_TRY(find_dropped(m, worker, slot, &drops));
        const uint32_t *old_polygons = tl_nav_old_polygons(&m->changes, slot);
        if (is_other || drops || count > 0 || old_polygons != NULL) {
            TL_TRY(tl_nav_remake_cones(m->changes.allocator, m->changes.graph, slot,
                                       navmesh->slots[slot].rings.polygon_count, old_polygons, worker->is_dropped,
                                       fresh, count));
        }
    }
    worker->bytes += tl_nav_cones_size(cones);
    return TL_OK;
}

static void remake_cones_of_slot(uint32_t index, uint32_t worker, void *user)
{
    const graph_mend *m = user;
    const uint32_t slot = m->changes.slots.numbers[index];
    cone_worker *w = &m->workers[worker];
    if (w->result == TL_OK && (m->changes.slot_bits[slot] & TL_NAV_SLOT_CONES) != 0) {
        w->result = remake_tile_cones(m, w, slot);
    }
}

static tl_result remake_cones_of_all(graph_mend *m)
{
    tl_nav_visibility_graph *graph = m->changes.graph;
    TL_TRY(tl_stage_run(&m->stage, remake_cones_of_slot, (uint32_t)m->changes.slots.count, m, TILES_A_CALL, 0));
    for (uint32_t w = 0; w < m->worker_count; w++) {
        TL_TRY(m->workers[w].result);
        graph->tile_bytes += m->workers[w].bytes;
        graph->tile_bytes -= m->workers[w].bytes_before;
    }
    return TL_OK;
}

static tl_result remake_cones(graph_mend *m)
{
    tl_nav_graph_changes *c = &m->changes;
    for (uint64_t i = 0; i < m->looks.seen.reaches.count; i++) {
        TL_TRY(tl_nav_note_slot(c, (uint32_t)m->looks.seen.reaches.items[i].key, TL_NAV_SLOT_CONES));
    }
    TL_TRY(tl_nav_sort_pairs(c->allocator, &m->sectors.dropped, &m->stage));
    for (uint64_t i = 0; i < m->sectors.dropped.count; i++) {
        TL_TRY(tl_nav_note_slot(c, (uint32_t)(m->sectors.dropped.items[i].key >> 32), TL_NAV_SLOT_CONES));
    }
    m->worker_count = tl_worker_count(m->stage.host);
    m->workers = tl_allocate_array(c->allocator, m->worker_count, sizeof *m->workers);
    if (m->workers == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(m->workers, 0, m->worker_count * sizeof *m->workers);
    const tl_result result = remake_cones_of_all(m);
    for (uint32_t w = 0; w < m->worker_count; w++) {
        tl_release_array(c->allocator, m->workers[w].is_dropped, m->workers[w].dropped_capacity, sizeof(bool));
    }
    tl_release_array(c->allocator, m->workers, m->worker_count, sizeof *m->workers);
    return result;
}

static tl_result mend(graph_mend *m, const tl_navmesh *navmesh, tl_nav_visibility_graph *graph)
{
    TL_TRY(tl_nav_find_changes(navmesh, graph, &m->changes));
    TL_TRY(tl_nav_find_change_sectors(&m->changes, m->stage.host, &m->sectors));
    const tl_nav_number_list *lookers = &m->changes.lookers;
    m->stage.total = lookers->count;
    TL_TRY(tl_nav_look_from_all(&m->sectors, &m->stage, &m->looks));
    TL_TRY(tl_nav_remake_sights(&m->sectors, &m->looks.seen, &m->stage));
    TL_TRY(remake_cones(m));
    TL_TRY(tl_stage_end(&m->stage));
    graph->looked = (uint32_t)lookers->count;
    graph->last_fan = navmesh->last_fan;
    TL_TRY(tl_nav_mend_landmarks(&m->changes, &m->looks.seen.edges, m->stage.host));
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
    m.sectors.changes = &m.changes;
    const tl_result result = mend(&m, navmesh, graph);
    tl_nav_free_all_looks(&m.changes, &m.looks);
    tl_nav_free_change_sectors(&m.sectors);
    tl_nav_free_changes(&m.changes);
    return result;
}
