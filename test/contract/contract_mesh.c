// SPDX-License-Identifier: MIT
//
// mesh.h.

#include "contract.h"

#include <string.h>

// The level's mesh, or what is missing of it in the cases of CONTRACT_NULL_INPUT: all, an array, the other one.
static const tl_mesh_view *view_of(const contract_run *run, tl_mesh_view *view)
{
    *view = contract_level_get()->view;
    if (run->what == CONTRACT_NULL_INPUT && run->variant == 1) {
        view->indices = NULL;
    } else if (run->what == CONTRACT_NULL_INPUT && run->variant == 2) {
        view->vertices = NULL;
    }
    return run->what == CONTRACT_NULL_INPUT && run->variant == 0 ? NULL : view;
}

static tl_result mesh_bake(contract_run *run)
{
    tl_mesh_def def = tl_default_mesh_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    }
    def.host = *run->host;
    if (run->what == CONTRACT_BAD_FIELD) {
        def.weld_tolerance = -1.0f;
    }
    tl_mesh_view view;
    tl_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    tl_mesh_report report;
    memset(&report, 0, sizeof report);
    const tl_result result =
        tl_mesh_bake(view_of(run, &view), run->what == CONTRACT_NULL_DEF ? NULL : &def,
                     run->what == CONTRACT_NULL_OUTPUT ? NULL : &mesh, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = contract_is_zero(&mesh, sizeof mesh);
    if (result == TL_OK) {
        run->answer = contract_hash(mesh.vertices, mesh.vertex_count * sizeof *mesh.vertices, mesh.triangle_count);
    }
    tl_mesh_free(&mesh);
    return result;
}

CONTRACT_DEFINE_FREE(mesh_free, tl_mesh, tl_mesh_free)

static tl_result adjacency_bake(contract_run *run)
{
    tl_mesh_view view;
    tl_adjacency adjacency;
    memset(&adjacency, 0, sizeof adjacency);
    const tl_result result = tl_adjacency_bake(view_of(run, &view), run->what == CONTRACT_NULL_DEF ? NULL : run->host,
                                               run->what == CONTRACT_NULL_OUTPUT ? NULL : &adjacency, run->report);
    run->is_clear = contract_is_zero(&adjacency, sizeof adjacency);
    if (result == TL_OK) {
        run->answer = contract_hash(adjacency.across, 3 * adjacency.triangle_count * sizeof *adjacency.across, 0);
    }
    tl_adjacency_free(&adjacency);
    return result;
}

CONTRACT_DEFINE_FREE(adjacency_free, tl_adjacency, tl_adjacency_free)

static tl_result closed_parts_find(contract_run *run)
{
    tl_mesh_view view;
    tl_closed_parts parts;
    memset(&parts, 0, sizeof parts);
    const tl_result result =
        tl_closed_parts_find(view_of(run, &view), run->what == CONTRACT_NULL_DEF ? NULL : run->host,
                             run->what == CONTRACT_NULL_OUTPUT ? NULL : &parts, run->report);
    run->is_clear = contract_is_zero(&parts, sizeof parts);
    if (result == TL_OK) {
        run->answer = contract_hash(parts.part_of, parts.triangle_count * sizeof *parts.part_of, parts.part_count);
    }
    tl_closed_parts_free(&parts);
    return result;
}

CONTRACT_DEFINE_FREE(closed_parts_free, tl_closed_parts, tl_closed_parts_free)

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
    { "tl_adjacency_bake", HOST_CASES | CONTRACT_BIT(CANCELLED), 2, 1, NULL, adjacency_bake, NULL },
    { "tl_adjacency_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, adjacency_free, NULL },
    { "tl_closed_parts_find", HOST_CASES | CONTRACT_BIT(CANCELLED), 3, 1, NULL, closed_parts_find, NULL },
    { "tl_closed_parts_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, closed_parts_free, NULL },
    { 0 },
};
