// SPDX-License-Identifier: MIT
//
// The functions of polygon.h under the contract.

#include "contract.h"

#include <talus/polygon.h>

#include <string.h>

// An L, wound as outer contours are.
static const tl_contour_vertex L_VERTICES[] = {
    { 0, 0, 0, 0 }, { 0, 0, 8, 0 }, { 4, 0, 8, 0 }, { 4, 0, 4, 0 }, { 8, 0, 4, 0 }, { 8, 0, 0, 0 },
};
static const tl_contour L_CONTOUR = { 0, 6, 1, 1 };

static tl_contour_set l_shape(void)
{
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = L_VERTICES;
    set.vertex_count = 6;
    set.contours = &L_CONTOUR;
    set.contour_count = 1;
    set.bounds.max = tl_vec3_make(8, 1, 8);
    set.cell_size = set.cell_height = 1.0f;
    set.width = set.height = 8;
    return set;
}

static uint64_t mesh_hash(const tl_polygon_mesh *mesh)
{
    return contract_hash(mesh->indices, mesh->index_count * sizeof *mesh->indices, mesh->polygon_count);
}

static const char *const POLYGON_FIELDS[] = { "max_verts_per_poly", "method", NULL };

static tl_result polygon_mesh_bake(contract_run *run)
{
    const tl_contour_set set = l_shape();
    tl_polygon_def def = tl_default_polygon_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD && run->variant == 0) {
        def.max_verts_per_poly = 2;
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.method = (tl_partition_method)77;
    }
    def.host = *run->host;
    tl_polygon_mesh mesh;
    memset(&mesh, 0x55, sizeof mesh);
    tl_polygon_report report = { 0 };
    const tl_result result = tl_polygon_mesh_bake(
        run->what == CONTRACT_NULL_INPUT ? NULL : &set, run->what == CONTRACT_NULL_DEF ? NULL : &def,
        run->what == CONTRACT_NULL_OUTPUT ? NULL : &mesh, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&mesh, sizeof mesh);
    if (result == TL_OK) {
        run->answer = mesh_hash(&mesh);
        tl_polygon_mesh_free(&mesh);
    }
    return result;
}

static tl_result polygon_mesh_free(contract_run *run)
{
    tl_polygon_mesh zeroed;
    (void)run;
    memset(&zeroed, 0, sizeof zeroed);
    tl_polygon_mesh_free(NULL);
    tl_polygon_mesh_free(&zeroed);
    return TL_OK;
}

static tl_result polygon_mesh_check(contract_run *run)
{
    const tl_contour_set set = l_shape();
    tl_polygon_mesh mesh;
    TEST_RESULT(tl_polygon_mesh_bake(&set, NULL, &mesh, NULL), TL_OK);
    if (run->what == CONTRACT_BAD_BYTES) {
        mesh.indices[1] = mesh.indices[0];
    }
    tl_polygon_check_report report;
    memset(&report, 0, sizeof report);
    const tl_result result = tl_polygon_mesh_check(run->what == CONTRACT_NULL_INPUT ? NULL : &mesh, &set,
                                                   run->host->allocator, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = true;
    tl_polygon_mesh_free(&mesh);
    return result;
}

static tl_result polygon_mesh_measure(contract_run *run)
{
    const tl_contour_set set = l_shape();
    tl_polygon_mesh mesh;
    TEST_RESULT(tl_polygon_mesh_bake(&set, NULL, &mesh, NULL), TL_OK);
    const tl_polygon_quality quality = tl_polygon_mesh_measure(&mesh);
    run->answer = quality.polygon_count;
    TEST_CHECK(quality.polygon_count == mesh.polygon_count && quality.max_corners >= 3);
    tl_polygon_mesh_free(&mesh);
    return TL_OK;
}

static tl_result polygon_fault_text(contract_run *run)
{
    (void)run;
    for (int fault = -1; fault <= (int)TL_POLYGON_FAULT_COUNT; fault++) {
        TEST_CHECK(tl_polygon_fault_text((tl_polygon_fault)fault) != NULL);
    }
    return TL_OK;
}

const contract_entry CONTRACT_TABLE_polygon[] = {
    { "tl_default_polygon_def", 0, 0, 0, NULL, NULL, "returns the defaults" },
    { "tl_polygon_mesh_bake",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY) |
          CONTRACT_BIT(CANCELLED),
      1, 1, POLYGON_FIELDS, polygon_mesh_bake, NULL },
    { "tl_polygon_mesh_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, polygon_mesh_free, NULL },
    { "tl_polygon_mesh_measure", CONTRACT_BIT(GOOD), 0, 0, NULL, polygon_mesh_measure, NULL },
    { "tl_polygon_fault_text", CONTRACT_BIT(GOOD), 0, 0, NULL, polygon_fault_text, NULL },
    { "tl_polygon_mesh_check",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(BAD_BYTES) |
          CONTRACT_BIT(NO_MEMORY),
      1, 0, NULL, polygon_mesh_check, NULL },
    { 0 },
};
