// SPDX-License-Identifier: MIT
//
// mesh_bake.c with weld.c and clean.c: examples, a quadratic oracle of the weld, bad input by name, failing memory.

#include "talus_test.h"

#include <talus/mesh.h>

#include <math.h>
#include <string.h>

static tl_mesh_view view_of(const tl_vec3 *vertices, uint32_t vertex_count, const uint32_t *indices, uint32_t triangles)
{
    tl_mesh_view view = { vertices, vertex_count, indices, triangles, NULL };
    return view;
}

static void a_loose_square_becomes_two_joined_triangles(void **state)
{
    (void)state;
    const tl_vec3 v[7] = { { 0, 0, 0 },     { 0, 0, 1 }, { 1, 0, 1 }, { NAN, 9, 9 },
                           { -0.0f, 0, 0 }, { 1, 0, 1 }, { 1, 0, 0 } };
    const uint32_t t[] = { 0, 1, 2, 4, 5, 6, 0, 1, 2, 2, 0, 1, 2, 1, 0, 1, 1, 2, 0, 4, 6 };
    const uint16_t materials[] = { 5, 6, 7, 8, 9, 10, 11 };
    tl_mesh_view view = view_of(v, 7, t, 7);
    view.materials = materials;
    tl_mesh_def def = tl_default_mesh_def();
    tl_mesh mesh;
    tl_mesh_report report;
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_OK);
    assert_int_equal(mesh.vertex_count, 4);
    assert_int_equal(mesh.triangle_count, 3); // the flipped twin of the first is another triangle
    assert_int_equal(report.duplicate_triangles, 2);
    assert_int_equal(report.degenerate_triangles, 2);
    assert_int_equal(report.welded_vertices, 2);
    assert_int_equal(report.unused_vertices, 1);
    const uint32_t sources[] = { 0, 1, 4 };
    const uint32_t expected[] = { 0, 1, 2, 0, 2, 3, 2, 1, 0 };
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(mesh.source_triangles[i], sources[i]);
        assert_int_equal(mesh.materials[i], materials[sources[i]]);
    }
    assert_memory_equal(mesh.indices, expected, sizeof expected);
    TEST_CHECK(mesh.bounds.min.x == 0 && mesh.bounds.max.z == 1);
    TEST_CHECK(report.base.peak_bytes >= mesh.block_size);
    tl_mesh_free(&mesh);
    TEST_CHECK(mesh.vertices == NULL);

    def.keep_duplicates = true;
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, NULL), TL_OK);
    assert_int_equal(mesh.triangle_count, 5);
    tl_mesh_free(&mesh);
}

// A triangle whose corners lie on one line in exact arithmetic has no area; one float aside it has some, and stays.
static void area_is_decided_exactly(void **state)
{
    (void)state;
    const float tiny = ldexpf(1.0f, -149);
    const tl_vec3 v[] = { { 1e6f, 1e6f, 1e6f },
                          { 1e6f + 1.0f, 1e6f + 1.0f, 1e6f + 1.0f },
                          { 1e6f + 2.0f, 1e6f + 2.0f, 1e6f + 2.0f },
                          { 1e6f + 2.0f, 1e6f + 2.0625f, 1e6f + 2.0f },
                          { 0, 0, 0 },
                          { tiny, 0, 0 },
                          { 0, 0, tiny } };
    const uint32_t t[] = { 0, 1, 2, 0, 1, 3, 4, 5, 6 };
    tl_mesh_view view = view_of(v, 7, t, 3);
    tl_mesh_def def = tl_default_mesh_def();
    tl_mesh mesh;
    tl_mesh_report report;
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_OK);
    assert_int_equal(report.degenerate_triangles, 1);
    assert_int_equal(mesh.triangle_count, 2);
    assert_int_equal(mesh.source_triangles[0], 1);
    assert_int_equal(mesh.source_triangles[1], 2);
    tl_mesh_free(&mesh);
}

// The documented rule, by a quadratic scan.
static uint32_t oracle_weld(const tl_vec3 *v, uint32_t vertex, double tolerance, const bool *kept)
{
    for (uint32_t other = 0; other < vertex; other++) {
        double x = (double)v[other].x - (double)v[vertex].x;
        double y = (double)v[other].y - (double)v[vertex].y;
        double z = (double)v[other].z - (double)v[vertex].z;
        if (kept[other] && x * x + y * y + z * z <= tolerance * tolerance) {
            return other;
        }
    }
    return vertex;
}

static void weld_equals_a_quadratic_scan(void **state)
{
    (void)state;
    enum { COUNT = 900 };
    test_random random = { 3 };
    uint32_t welded = 0;
    uint32_t kept_count = 0;
    for (int round = 0; round < 24; round++) {
        float scale = round % 3 == 0 ? 1.0f : round % 3 == 1 ? 1e7f : 1e-7f;
        float tolerance = round % 4 == 0 ? 0.0f : 0.05f * scale;
        tl_vec3 offset =
            round % 2 == 0 ? tl_vec3_make(0, 0, 0) : tl_vec3_make(-5e3f * scale, 3e2f * scale, 1e3f * scale);
        tl_vec3 v[COUNT];
        uint32_t t[COUNT];
        uint32_t expected[COUNT];
        bool kept[COUNT];
        for (uint32_t i = 0; i < COUNT; i++) {
            v[i] = tl_add(tl_scale(test_random_point(&random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1)), scale),
                          offset);
            if (i > 0 && test_random_below(&random, 4) == 0) {
                v[i] = v[test_random_below(&random, i)];
            }
            t[i] = i;
            expected[i] = oracle_weld(v, i, (double)tolerance, kept);
            kept[i] = expected[i] == i;
        }
        tl_mesh_view view = view_of(v, COUNT, t, COUNT / 3);
        tl_mesh_def def = tl_default_mesh_def();
        def.weld_tolerance = tolerance;
        def.keep_duplicates = true;
        tl_mesh mesh;
        TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, NULL), TL_OK);
        for (uint32_t i = 0; i < mesh.triangle_count; i++) {
            for (uint32_t k = 0; k < 3; k++) {
                tl_vec3 is = mesh.vertices[mesh.indices[3 * i + k]];
                tl_vec3 should = v[expected[3 * mesh.source_triangles[i] + k]];
                TEST_CHECK(is.x == should.x && is.y == should.y && is.z == should.z);
            }
        }
        for (uint32_t i = 0; i < COUNT; i++) {
            welded += expected[i] != i;
            kept_count += expected[i] == i;
        }
        tl_mesh_free(&mesh);
    }
    TEST_CHECK(welded > 5000 && kept_count > 5000);
}

static void bad_input_is_named(void **state)
{
    (void)state;
    tl_vec3 v[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 } };
    uint32_t t[6] = { 0, 1, 2, 2, 1, 0 };
    tl_mesh_def def = tl_default_mesh_def();
    tl_mesh mesh;
    tl_mesh_report report;
    tl_mesh_view view = view_of(v, 3, t, 0);
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_ERR_EMPTY);
    view = view_of(NULL, 0, t, 1);
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_ERR_EMPTY);
    view = view_of(v, 3, t, 2);
    t[4] = 3;
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_ERR_INDEX);
    TEST_CHECK(report.base.element_index == 1 && strcmp(report.base.element, "triangle") == 0);
    t[4] = 1;
    const float bad[] = { NAN, INFINITY, -INFINITY, 1.1e12f };
    for (int i = 0; i < 4; i++) {
        v[1].z = bad[i];
        TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), i < 3 ? TL_ERR_NOT_FINITE : TL_ERR_RANGE);
        TEST_CHECK(report.base.element_index == 1 && strcmp(report.base.element, "vertex") == 0);
        TEST_CHECK(report.base.advice != NULL && mesh.block == NULL);
    }
    v[1] = tl_vec3_make(0, 0, 2);
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_ERR_EMPTY);
    assert_int_equal(report.degenerate_triangles, 2);
    v[1].x = 1.0f;
    const float tolerances[] = { -1.0f, NAN, INFINITY };
    for (int i = 0; i < 3; i++) {
        def.weld_tolerance = tolerances[i];
        TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_ERR_ARGUMENT);
    }
    def.weld_tolerance = 10.0f;
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_ERR_EMPTY);
    def.weld_tolerance = 0.0f;
    view = view_of(v, TL_MAX_MESH_VERTICES + 1u, t, 2);
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, &report), TL_ERR_LIMIT);
}

static bool cancel_at_clean(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)total;
    (*(int *)user)++;
    return !(strcmp(stage, "clean") == 0 && done > 0);
}

static void failing_memory_and_cancellation_leak_nothing(void **state)
{
    (void)state;
    const tl_vec3 v[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 } };
    const uint32_t t[6] = { 0, 1, 2, 2, 1, 3 };
    tl_mesh_view view = view_of(v, 4, t, 2);
    uint64_t failures = 0;
    for (uint64_t fail_at = 1;; fail_at++) {
        test_allocator test;
        test_allocator_init(&test, fail_at);
        tl_mesh_def def = tl_default_mesh_def();
        def.host.allocator = &test.allocator;
        tl_mesh mesh;
        tl_result result = tl_mesh_bake(&view, &def, &mesh, NULL);
        if (result == TL_OK) {
            TEST_CHECK(test.live_blocks == 1);
            tl_mesh_free(&mesh);
            TEST_CHECK(test.live_blocks == 0 && test.live_bytes == 0);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(test.live_blocks == 0 && mesh.block == NULL);
        failures++;
    }
    TEST_CHECK(failures >= 2);

    int updates = 0;
    test_allocator test;
    test_allocator_init(&test, 0);
    tl_progress progress = { cancel_at_clean, &updates };
    tl_mesh_def def = tl_default_mesh_def();
    def.host.allocator = &test.allocator;
    def.host.progress = &progress;
    tl_mesh mesh;
    TEST_RESULT(tl_mesh_bake(&view, &def, &mesh, NULL), TL_ERR_CANCELLED);
    TEST_CHECK(updates >= 4 && test.live_blocks == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_loose_square_becomes_two_joined_triangles),
        cmocka_unit_test(area_is_decided_exactly),
        cmocka_unit_test(weld_equals_a_quadratic_scan),
        cmocka_unit_test(bad_input_is_named),
        cmocka_unit_test(failing_memory_and_cancellation_leak_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
