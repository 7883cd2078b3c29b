// SPDX-License-Identifier: MIT
//
// Preparing a navmesh for shortest paths: its visibility graph, and a table of distances if it fits.

#include "nav_query/mending/distance_table.h"
#include "nav_query/mending/graph_mend.h"
#include "nav_query/prepared/corner_distances.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <string.h>

tl_nav_prepare_def tl_default_nav_prepare_def(void)
{
    tl_nav_prepare_def def = { 32u << 20, NULL, NULL, TL_DEF_COOKIE };
    return def;
}

const char *tl_nav_prepared_kind_name(tl_nav_prepared_kind kind)
{
    static const char *const NAMES[] = { "none", "graph", "table" };
    return (unsigned)kind < TL_COUNT_OF(NAMES) ? NAMES[kind] : "unknown";
}

static bool floors_fork(const tl_navmesh *navmesh)
{
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        if (navmesh->slots[slot].tile != NULL && navmesh->slots[slot].rings.has_back) {
            return true;
        }
    }
    return false;
}

static void free_graph(tl_navmesh *navmesh)
{
    tl_nav_free_visibility_graph(&navmesh->allocator, navmesh->graph);
    navmesh->graph = NULL;
}

// Corner vertices and what they see depend on no flags and no areas.
static void outlive_state(tl_navmesh *navmesh, uint64_t edit_before)
{
    if (navmesh->graph != NULL && navmesh->graph_edit == edit_before) {
        navmesh->graph_edit = navmesh->edit.number;
    }
}

// Where older versions have the graph: a head of its own for this one, so that it may get and lose a table.
static tl_result own_graph(tl_navmesh *navmesh)
{
    if (!tl_nav_is_shared(navmesh->history, navmesh->graph)) {
        return TL_OK;
    }
    tl_nav_visibility_graph *head = tl_allocate_array(&navmesh->allocator, 1, sizeof *head);
    if (head == NULL) {
        return TL_ERR_MEMORY;
    }
    *head = *navmesh->graph;
    tl_release_array(&navmesh->allocator, navmesh->graph, 1, sizeof *head);
    navmesh->graph = head;
    return TL_OK;
}

// Brings the graph up to date, or makes one.
static tl_result update_graph(tl_navmesh *navmesh, const tl_host *host)
{
    if (!tl_nav_can_mend_graph(navmesh, navmesh->graph)) {
        free_graph(navmesh);
        navmesh->graph = tl_nav_create_visibility_graph(&navmesh->allocator);
        if (navmesh->graph == NULL) {
            return TL_ERR_MEMORY;
        }
    }
    TL_TRY(own_graph(navmesh));
    tl_nav_free_corner_distances(&navmesh->allocator, navmesh->graph);
    tl_nav_free_legs(&navmesh->allocator, navmesh->graph);
    TL_TRY(tl_nav_mend_graph(navmesh, host, navmesh->graph));
    navmesh->graph_edit = navmesh->edit.number;
    return TL_OK;
}

static tl_result prepare_graph(tl_navmesh *navmesh, const tl_nav_prepare_def *def, uint32_t *renewed_out)
{
    static const tl_nav_derived derived = { NULL, free_graph, outlive_state };
    const tl_host host = { NULL, def->tasks, def->progress };
    navmesh->derived[TL_NAV_DERIVED_GRAPH] = &derived;
    if (!tl_nav_has_current_graph(navmesh)) {
        if (floors_fork(navmesh)) {
            return TL_OK; // what there is of before is mended when they do no more
        }
        TL_TRY(update_graph(navmesh, &host));
        *renewed_out = navmesh->graph->looked;
    }
    TL_TRY(own_graph(navmesh));
    const tl_allocator *allocator = &navmesh->allocator;
    tl_nav_visibility_graph *graph = navmesh->graph;
    if (tl_nav_corner_distances_size(graph) <= def->table_bytes) {
        if (graph->table != NULL) {
            return TL_OK;
        }
        TL_TRY(tl_nav_bake_corner_distances(allocator, &host, graph));
        const tl_result kept = tl_nav_keep_legs(navmesh, graph);
        return kept == TL_ERR_LIMIT ? TL_OK : kept; // the table serves without
    }
    tl_nav_free_corner_distances(allocator, graph);
    tl_nav_free_legs(allocator, graph);
    return TL_OK;
}

static void note_prepared(const tl_navmesh *navmesh, tl_nav_prepared *made)
{
    const tl_nav_visibility_graph *graph = navmesh->graph;
    made->bytes = tl_nav_visibility_graph_size(graph) + tl_nav_kept_legs_size(graph);
    if (tl_nav_has_current_graph(navmesh)) {
        made->kind = graph->table != NULL ? TL_NAV_PREPARED_TABLE : TL_NAV_PREPARED_GRAPH;
        made->corner_vertex_count = graph->vertex_count;
        made->edge_count = graph->edge_count;
        made->table_bytes = tl_nav_corner_distances_size(graph);
    }
    made->bytes += graph->table != NULL ? tl_nav_corner_distances_size(graph) : 0;
}

tl_result tl_navmesh_prepare(tl_navmesh *navmesh, const tl_nav_prepare_def *def, tl_nav_prepared *prepared_out)
{
    const tl_nav_prepare_def used = def != NULL ? *def : tl_default_nav_prepare_def();
    tl_nav_prepared unread;
    tl_nav_prepared *made = prepared_out != NULL ? prepared_out : &unread;
    memset(made, 0, sizeof *made);
    tl_report_begin(&made->base, "visibility graph");
    if (navmesh == NULL) {
        return tl_report_field(&made->base, TL_ERR_ARGUMENT, "navmesh", "pass a navmesh");
    }
    TL_TRY(tl_def_check(used.cookie, "begin with tl_default_nav_prepare_def()", &made->base));
    const tl_result result = prepare_graph(navmesh, &used, &made->renewed_count);
    if (result != TL_OK) {
        free_graph(navmesh);
    } else if (navmesh->graph != NULL) {
        note_prepared(navmesh, made);
    }
    return result;
}

bool tl_navmesh_is_prepared(const tl_navmesh *navmesh)
{
    return tl_nav_has_current_graph(navmesh) && navmesh->offmesh.count == 0;
}
