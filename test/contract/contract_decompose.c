// SPDX-License-Identifier: MIT
//
// decompose.h.

#include "contract.h"

#include <string.h>

// A long bar with a short leg: two parts, and few cells.
static const tl_mesh_view *bar_with_leg(const contract_run *run, tl_mesh_view *view)
{
    static const tl_vec3 vertices[16] = { { 0, 0, 0 },         { 1, 0, 0 },         { 1, 0.02f, 0 },
                                          { 0, 0.02f, 0 },     { 0, 0, 0.02f },     { 1, 0, 0.02f },
                                          { 1, 0.02f, 0.02f }, { 0, 0.02f, 0.02f }, { 0, 0, 0 },
                                          { 0.02f, 0, 0 },     { 0.02f, 0.12f, 0 }, { 0, 0.12f, 0 },
                                          { 0, 0, 0.02f },     { 0.02f, 0, 0.02f }, { 0.02f, 0.12f, 0.02f },
                                          { 0, 0.12f, 0.02f } };
    static const uint32_t box[36] = { 0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                      1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7 };
    static uint32_t indices[72];
    for (uint32_t i = 0; i < 36; i++) {
        indices[i] = box[i];
        indices[36 + i] = box[i] + 8;
    }
    const tl_mesh_view bar = { vertices, 16, indices, 24, NULL };
    *view = bar;
    if (run->what == CONTRACT_NULL_INPUT && run->variant == 1) {
        view->indices = NULL;
    } else if (run->what == CONTRACT_NULL_INPUT && run->variant == 2) {
        view->vertices = NULL;
    }
    return run->what == CONTRACT_NULL_INPUT && run->variant == 0 ? NULL : view;
}

static void spoil_decompose_def(tl_decompose_def *def, uint32_t variant)
{
    def->tolerance = variant == 0 ? -1.0f : 0.0f;
    def->relative_tolerance = variant == 1 ? 0.0f : 0.025f;
    def->max_vertices = variant == 2 ? 3 : 0;
    def->thickness = variant == 3 ? NAN : 0.0f;
    def->solid = variant == 4 ? (tl_solid_rule)7 : TL_SOLID_ENCLOSED;
    def->max_cells = variant == 5 ? 1 : 4096;
}

static tl_result decomposition_bake(contract_run *run)
{
    tl_decompose_def def = tl_default_decompose_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        spoil_decompose_def(&def, run->variant);
    }
    def.host = *run->host;
    tl_mesh_view view;
    tl_decomposition decomposition;
    memset(&decomposition, 0, sizeof decomposition);
    tl_decompose_report report;
    memset(&report, 0, sizeof report);
    const tl_result result = tl_decomposition_bake(
        bar_with_leg(run, &view), run->what == CONTRACT_NULL_DEF ? NULL : &def,
        run->what == CONTRACT_NULL_OUTPUT ? NULL : &decomposition, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = contract_is_zero(&decomposition, sizeof decomposition);
    for (uint32_t i = 0; i < decomposition.part_count; i++) {
        const tl_hull *hull = decomposition.parts[i].hull;
        run->answer = contract_hash(hull, hull->blob.size, run->answer);
    }
    tl_decomposition_free(&decomposition);
    return result;
}

CONTRACT_DEFINE_FREE(decomposition_free, tl_decomposition, tl_decomposition_free)

static const char *const DECOMPOSE_FIELDS[] = {
    "tolerance", "relative_tolerance", "max_vertices", "thickness", "solid", "max_cells", NULL
};

const contract_entry CONTRACT_TABLE_decompose[] = {
    { "tl_default_decompose_def", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_decomposition_bake",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(NULL_INPUT) |
          CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD) |
          CONTRACT_BIT(CANCELLED),
      3, 1, DECOMPOSE_FIELDS, decomposition_bake, NULL },
    { "tl_decomposition_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, decomposition_free, NULL },
    { 0 },
};
