// SPDX-License-Identifier: MIT
//
// mesh.h.

#include "contract.h"

#include <string.h>

static tl_result mesh_bake(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_mesh_def def = tl_default_mesh_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    }
    def.host = *run->host;
    tl_mesh_view view = level->view;
    if (run->what == CONTRACT_BAD_FIELD) {
        def.weld_tolerance = -1.0f;
    } else if (run->what == CONTRACT_NULL_INPUT && run->variant == 1) {
        view.vertices = NULL;
    } else if (run->what == CONTRACT_NULL_INPUT && run->variant == 2) {
        view.indices = NULL;
    }
    const bool no_view = run->what == CONTRACT_NULL_INPUT && run->variant == 0;
    tl_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    tl_mesh_report report;
    memset(&report, 0, sizeof report);
    const tl_result result =
        tl_mesh_bake(no_view ? NULL : &view, run->what == CONTRACT_NULL_DEF ? NULL : &def,
                     run->what == CONTRACT_NULL_OUTPUT ? NULL : &mesh, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = contract_is_zero(&mesh, sizeof mesh);
    if (result == TL_OK) {
        run->answer = contract_hash(mesh.vertices, mesh.vertex_count * sizeof *mesh.vertices, mesh.triangle_count);
    }
    tl_mesh_free(&mesh);
    return result;
}

static tl_result mesh_free(contract_run *run)
{
    (void)run;
    tl_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    tl_mesh_free(NULL);
    tl_mesh_free(&mesh);
    return TL_OK;
}

static tl_result adjacency_bake(contract_run *run)
{
    tl_mesh_view view = contract_level_get()->view;
    if (run->what == CONTRACT_NULL_INPUT && run->variant == 1) {
        view.indices = NULL;
    }
    const bool no_view = run->what == CONTRACT_NULL_INPUT && run->variant == 0;
    tl_adjacency adjacency;
    memset(&adjacency, 0, sizeof adjacency);
    const tl_result result =
        tl_adjacency_bake(no_view ? NULL : &view, run->what == CONTRACT_NULL_DEF ? NULL : run->host,
                          run->what == CONTRACT_NULL_OUTPUT ? NULL : &adjacency, run->report);
    run->is_clear = contract_is_zero(&adjacency, sizeof adjacency);
    if (result == TL_OK) {
        run->answer = contract_hash(adjacency.across, 3 * adjacency.triangle_count * sizeof *adjacency.across, 0);
    }
    tl_adjacency_free(&adjacency);
    return result;
}

static tl_result adjacency_free(contract_run *run)
{
    (void)run;
    tl_adjacency adjacency;
    memset(&adjacency, 0, sizeof adjacency);
    tl_adjacency_free(NULL);
    tl_adjacency_free(&adjacency);
    return TL_OK;
}

static tl_result closed_parts_find(contract_run *run)
{
    tl_mesh_view view = contract_level_get()->view;
    if (run->what == CONTRACT_NULL_INPUT && run->variant == 1) {
        view.indices = NULL;
    } else if (run->what == CONTRACT_NULL_INPUT && run->variant == 2) {
        view.vertices = NULL;
    }
    const bool no_view = run->what == CONTRACT_NULL_INPUT && run->variant == 0;
    tl_closed_parts parts;
    memset(&parts, 0, sizeof parts);
    const tl_result result =
        tl_closed_parts_find(no_view ? NULL : &view, run->what == CONTRACT_NULL_DEF ? NULL : run->host,
                             run->what == CONTRACT_NULL_OUTPUT ? NULL : &parts, run->report);
    run->is_clear = contract_is_zero(&parts, sizeof parts);
    if (result == TL_OK) {
        run->answer = contract_hash(parts.part_of, parts.triangle_count * sizeof *parts.part_of, parts.part_count);
    }
    tl_closed_parts_free(&parts);
    return result;
}

static tl_result closed_parts_free(contract_run *run)
{
    (void)run;
    tl_closed_parts parts;
    memset(&parts, 0, sizeof parts);
    tl_closed_parts_free(NULL);
    tl_closed_parts_free(&parts);
    return TL_OK;
}

static const char *const MESH_FIELDS[] = { "weld_tolerance", NULL };

enum {
    HOST_CASES = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(NULL_INPUT) |
                 CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY),
    DEF_CASES = HOST_CASES | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(CANCELLED)
};

const contract_entry CONTRACT_TABLE_mesh[] = {
    { "tl_default_mesh_def", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_mesh_bake", DEF_CASES, 3, 1, MESH_FIELDS, mesh_bake, NULL },
    { "tl_mesh_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, mesh_free, NULL },
    { "tl_mesh_as_view", 0, 0, 0, NULL, NULL, "returns a value; the mesh is the caller's duty" },
    { "tl_adjacency_bake", HOST_CASES, 2, 1, NULL, adjacency_bake, NULL },
    { "tl_adjacency_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, adjacency_free, NULL },
    { "tl_closed_parts_find", HOST_CASES, 3, 1, NULL, closed_parts_find, NULL },
    { "tl_closed_parts_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, closed_parts_free, NULL },
    { 0 },
};
