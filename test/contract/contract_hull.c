// SPDX-License-Identifier: MIT
//
// hull.h.

#include "contract.h"

#include <stdlib.h>
#include <string.h>

enum { POINTS = 24 };

// Two rings of points and two tips: a hull that takes some steps to bake.
static const tl_vec3 *hull_points(void)
{
    static tl_vec3 points[POINTS];
    test_random random = { 5 };
    for (int i = 0; i < POINTS; i++) {
        points[i] = test_random_direction(&random);
    }
    return points;
}

static void answer_hull(contract_run *run, tl_result result, tl_hull *hull)
{
    run->is_clear = hull == NULL;
    if (result == TL_OK) {
        run->answer = contract_hash(hull, hull->blob.size, 0);
        tl_blob_free(hull);
    }
}

static tl_result hull_bake(contract_run *run)
{
    tl_hull_def def = tl_default_hull_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.max_vertices = run->variant == 0 ? 3 : 0;
        def.tolerance = run->variant == 1 ? -1.0f : 0.0f;
        def.thickness = run->variant == 2 ? -1.0f : 0.0f;
        def.flatness = run->variant == 3 ? NAN : 8.0f;
        def.weld_distance = run->variant == 4 ? -1.0f : 0.0f;
        def.merge_distance = run->variant == 5 ? INFINITY : 0.0f;
    }
    def.host = *run->host;
    tl_hull *hull = NULL;
    tl_hull_report report;
    memset(&report, 0, sizeof report);
    const tl_result result = tl_hull_bake(
        run->what == CONTRACT_NULL_INPUT ? NULL : hull_points(), POINTS, run->what == CONTRACT_NULL_DEF ? NULL : &def,
        run->what == CONTRACT_NULL_OUTPUT ? NULL : &hull, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    answer_hull(run, result, hull);
    return result;
}

static tl_result hull_transform(contract_run *run)
{
    tl_hull *hull = NULL;
    TEST_RESULT(tl_hull_bake(hull_points(), POINTS, NULL, &hull, NULL), TL_OK);
    tl_transform pose = { tl_quat_identity(), { 1.0f, 2.0f, 3.0f } };
    if (run->what == CONTRACT_ZERO_ROTATION) {
        memset(&pose.rotation, 0, sizeof pose.rotation);
    }
    tl_hull *moved = NULL;
    tl_hull_report report;
    memset(&report, 0, sizeof report);
    const tl_result result =
        tl_hull_transform(run->what == CONTRACT_NULL_INPUT ? NULL : hull, tl_vec3_make(2.0f, 1.0f, 1.0f), pose,
                          run->what == CONTRACT_NULL_DEF ? NULL : run->host,
                          run->what == CONTRACT_NULL_OUTPUT ? NULL : &moved, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    answer_hull(run, result, moved);
    tl_blob_free(hull);
    return result;
}

static tl_result hull_to_halfedge(contract_run *run)
{
    const tl_hull *hull = contract_level_get()->hull;
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, run->host->allocator);
    const tl_result result = tl_hull_to_halfedge(run->what == CONTRACT_NULL_INPUT ? NULL : hull,
                                                 run->what == CONTRACT_NULL_OUTPUT ? NULL : &mesh);
    run->is_clear = mesh.vertex_count == 0 && mesh.face_count == 0;
    run->answer = mesh.half_edge_count;
    tl_halfedge_mesh_destroy(&mesh);
    return result;
}

static tl_result hull_check(contract_run *run)
{
    const tl_hull *hull = contract_level_get()->hull;
    void *bytes = test_blob_alloc(hull->blob.size);
    TEST_CHECK(bytes != NULL);
    memcpy(bytes, hull, hull->blob.size);
    if (run->what == CONTRACT_BAD_BYTES) {
        ((tl_hull *)bytes)->face_count++;
    }
    const tl_result result =
        tl_hull_check(run->what == CONTRACT_NULL_INPUT ? NULL : bytes, hull->blob.size, run->report);
    run->is_clear = true;
    test_blob_free(bytes);
    return result;
}

static tl_result hull_validate(contract_run *run)
{
    const tl_hull *hull = contract_level_get()->hull;
    tl_hull *copy = test_blob_alloc(hull->blob.size);
    TEST_CHECK(copy != NULL);
    memcpy(copy, hull, hull->blob.size);
    if (run->what == CONTRACT_BAD_BYTES) {
        ((tl_vec3 *)(void *)((char *)copy + copy->vertices))->y += 0.5f;
    }
    const bool no_hull = run->what == CONTRACT_NULL_INPUT && run->variant == 0;
    const bool no_points = run->what == CONTRACT_NULL_INPUT && run->variant == 1;
    tl_hull_validation validation;
    memset(&validation, 0, sizeof validation);
    const tl_result result = tl_hull_validate(no_hull ? NULL : copy, no_points ? NULL : tl_hull_vertices(hull),
                                              hull->vertex_count, run->wants_report ? &validation : NULL);
    run->own_report = validation.base;
    run->is_clear = true;
    test_blob_free(copy);
    return result;
}

static const char *const HULL_FIELDS[] = { "max_vertices",  "tolerance",      "thickness", "flatness",
                                           "weld_distance", "merge_distance", NULL };

enum {
    HULL_CASES = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(NULL_INPUT) |
                 CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY) | CONTRACT_BIT(CANCELLED),
    CHECK_CASES = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(BAD_BYTES)
};

#define VALUE "returns a value; the hull is the caller's duty"

const contract_entry CONTRACT_TABLE_hull[] = {
    { "tl_default_hull_def", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_hull_bake", HULL_CASES | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD), 1, 1, HULL_FIELDS, hull_bake,
      NULL },
    { "tl_hull_transform", HULL_CASES | CONTRACT_BIT(ZERO_ROTATION), 1, 1, NULL, hull_transform, NULL },
    { "tl_hull_to_halfedge",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY), 1, 1, NULL,
      hull_to_halfedge, NULL },
    { "tl_hull_check", CHECK_CASES, 1, 0, NULL, hull_check, NULL },
    { "tl_hull_validate", CHECK_CASES, 2, 0, NULL, hull_validate, NULL },
    { "tl_hull_support", 0, 0, 0, NULL, NULL, VALUE },
    { "tl_hull_cast_ray", 0, 0, 0, NULL, NULL, VALUE },
    { "tl_hull_clip_ray", 0, 0, 0, NULL, NULL, VALUE },
    { "tl_hull_contains", 0, 0, 0, NULL, NULL, VALUE },
    { 0 },
};
