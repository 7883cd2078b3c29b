// SPDX-License-Identifier: MIT
//
// A path search over many frames: the run of find_path.c, kept in the query between steps.
//
// Tiles may be added and removed between two steps. Every edit of the navmesh has a number, and each slot keeps the
// number of the last edit that changed what a search sees there: its polygons, links and rings. A search whose nodes
// all lie in slots without a later edit has seen none of the changes, so it continues as if the tiles had always been
// as they are now. Otherwise it is stale: nodes may lie in polygons that are gone. While nothing is edited the check is
// one comparison.

#include "base/assert.h"
#include "nav_query/path/path_run.h"

#include <string.h>

// Whether the run's nodes are still the query's latest.
static bool is_under_way(const tl_nav_query *query)
{
    const tl_nav_path_run *run = query->run;
    return run->stage != TL_NAV_RUN_NONE && run->generation == query->generation &&
           run->pool_generation == query->pool_generation;
}

static void note_generations(tl_nav_query *query)
{
    query->run->generation = query->generation;
    query->run->pool_generation = query->pool_generation;
}

// The slot of a node, or of the goal behind the last one.
static uint32_t slot_of_node(const tl_nav_path_run *run, uint32_t node, uint32_t node_count)
{
    const tl_nav_query *query = run->ways.query;
    return node == node_count               ? run->exact.goal_slot
           : run->stage == TL_NAV_RUN_EXACT ? query->wedges[node].slot
                                            : query->nodes[node].slot;
}

static uint32_t count_nodes(const tl_nav_path_run *run)
{
    const tl_nav_query *query = run->ways.query;
    return run->stage == TL_NAV_RUN_EXACT ? query->wedge_count : run->stage == TL_NAV_RUN_WAYS ? query->node_count : 0;
}

// Whether an edit since the last look has touched the search; the slot is the first such.
static bool find_stale_slot(const tl_nav_path_run *run, uint32_t *slot_out)
{
    const tl_navmesh *navmesh = run->ways.navmesh;
    uint32_t count = count_nodes(run);
    for (uint32_t i = 0; i <= count; i++) {
        uint32_t slot = slot_of_node(run, i, count);
        if (navmesh->slots[slot].last_edit.number > run->edits) {
            *slot_out = slot;
            return true;
        }
    }
    *slot_out = run->exact.start_slot;
    return navmesh->slots[*slot_out].last_edit.number > run->edits;
}

// Looks for changes, and remembers the one that ends the search.
static void look_for_edits(tl_nav_path_run *run)
{
    const tl_navmesh *navmesh = run->ways.navmesh;
    uint32_t slot = 0;
    if (run->status == TL_NAV_PATH_STALE || navmesh->edit.number == run->edits) {
        return;
    }
    if (find_stale_slot(run, &slot)) {
        run->status = TL_NAV_PATH_STALE;
        run->stale_x = navmesh->slots[slot].last_edit.tile_x;
        run->stale_z = navmesh->slots[slot].last_edit.tile_z;
    }
    run->edits = navmesh->edit.number;
}

tl_result tl_nav_query_begin_path(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_path_request *request)
{
    if (query == NULL || navmesh == NULL || request == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_path_run *run = query->run;
    tl_nav_path_request kept = *request;
    if (request->filter != NULL) {
        run->filter = *request->filter;
        kept.filter = &run->filter;
    }
    TL_TRY(tl_nav_run_begin(query, navmesh, &kept, run));
    note_generations(query);
    return TL_OK;
}

tl_result tl_nav_query_step_path(tl_nav_query *query, uint32_t max_steps, tl_nav_path_progress *progress_out)
{
    if (query == NULL || progress_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    tl_nav_path_run *run = query->run;
    memset(progress_out, 0, sizeof *progress_out);
    if (!is_under_way(query)) {
        return TL_ERR_STALE;
    }
    uint64_t steps = max_steps;
    look_for_edits(run);
    tl_nav_run_step(run, &steps);
    note_generations(query);
    progress_out->status = run->status;
    progress_out->node_count = count_nodes(run);
    if (run->status == TL_NAV_PATH_STALE) {
        progress_out->tile_x = run->stale_x;
        progress_out->tile_z = run->stale_z;
    }
    return TL_OK;
}

tl_result tl_nav_query_write_path(tl_nav_query *query, tl_nav_ref *polygons_out, uint32_t capacity,
                                  tl_nav_path *path_out)
{
    if (query == NULL || path_out == NULL || (polygons_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    memset(path_out, 0, sizeof *path_out);
    if (!is_under_way(query)) {
        return TL_ERR_STALE;
    }
    look_for_edits(query->run);
    if (query->run->status == TL_NAV_PATH_STALE) {
        path_out->status = TL_NAV_PATH_STALE;
        return TL_OK;
    }
    return tl_nav_run_write(query->run, polygons_out, capacity, path_out);
}
