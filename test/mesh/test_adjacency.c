// SPDX-License-Identifier: MIT

#include "talus_test.h"

#include <talus/mesh.h>

static void edge_of(const uint32_t *indices, uint32_t edge, uint32_t *from, uint32_t *to)
{
    *from = indices[edge];
    *to = indices[edge / 3 * 3 + (edge + 1) % 3];
}

// Every answer against a scan over all edges, on random soups dense enough to have every kind of edge.
static void equals_a_scan_over_all_edges(void **state)
{
    (void)state;
    enum { TRIANGLES = 120, EDGES = 3 * TRIANGLES };
    test_random random = { 11 };
    tl_vec3 vertices[64] = { { 0, 0, 0 } };
    uint32_t borders = 0;
    uint32_t pairs = 0;
    uint32_t knots = 0;
    for (uint32_t vertex_count = 4; vertex_count < 60; vertex_count++) {
        uint32_t indices[EDGES];
        for (uint32_t i = 0; i < TRIANGLES; i++) {
            indices[3 * i] = test_random_below(&random, vertex_count);
            for (uint32_t k = 1; k < 3; k++) {
                do {
                    indices[3 * i + k] = test_random_below(&random, vertex_count);
                } while (indices[3 * i + k] == indices[3 * i] || (k == 2 && indices[3 * i + 2] == indices[3 * i + 1]));
            }
        }
        tl_mesh_view view = { vertices, vertex_count, indices, TRIANGLES, NULL };
        tl_adjacency adjacency;
        TEST_RESULT(tl_adjacency_bake(&view, NULL, &adjacency, NULL), TL_OK);
        uint32_t counted[2] = { 0, 0 };
        for (uint32_t edge = 0; edge < EDGES; edge++) {
            uint32_t from;
            uint32_t to;
            edge_of(indices, edge, &from, &to);
            uint32_t same = 0;
            uint32_t opposite = 0;
            uint32_t partner = 0;
            for (uint32_t other = 0; other < EDGES; other++) {
                uint32_t other_from;
                uint32_t other_to;
                edge_of(indices, other, &other_from, &other_to);
                same += other_from == from && other_to == to;
                if (other_from == to && other_to == from) {
                    opposite++;
                    partner = other;
                }
            }
            uint32_t expected = same == 1 && opposite == 1   ? partner
                                : same == 1 && opposite == 0 ? TL_EDGE_BORDER
                                                             : TL_EDGE_NON_MANIFOLD;
            assert_int_equal(adjacency.across[edge], expected);
            borders += expected == TL_EDGE_BORDER;
            knots += expected == TL_EDGE_NON_MANIFOLD;
            counted[0] += expected == TL_EDGE_BORDER;
            counted[1] += expected < EDGES;
        }
        assert_int_equal(adjacency.border_edges, counted[0]);
        assert_int_equal(adjacency.paired_edges * 2, counted[1]);
        pairs += adjacency.paired_edges;
        tl_adjacency_free(&adjacency);
    }
    TEST_CHECK(borders > 1000 && pairs > 300 && knots > 1000);
}

static void a_fan_of_many_triangles_is_linear(void **state)
{
    (void)state;
    enum { TRIANGLES = 200000 };
    uint32_t *indices = malloc(sizeof *indices * 3 * TRIANGLES);
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        indices[3 * i] = 0;
        indices[3 * i + 1] = i + 1;
        indices[3 * i + 2] = (i + 1) % TRIANGLES + 1;
    }
    tl_mesh_view view = { NULL, TRIANGLES + 1, indices, TRIANGLES, NULL };
    tl_adjacency adjacency;
    TEST_RESULT(tl_adjacency_bake(&view, NULL, &adjacency, NULL), TL_OK);
    assert_int_equal(adjacency.border_edges, TRIANGLES);
    assert_int_equal(adjacency.paired_edges, TRIANGLES);
    assert_int_equal(adjacency.across[2], 3);
    tl_adjacency_free(&adjacency);
    free(indices);
}

static void failing_memory_leaks_nothing(void **state)
{
    (void)state;
    const uint32_t indices[6] = { 0, 1, 2, 2, 1, 3 };
    tl_mesh_view view = { NULL, 4, indices, 2, NULL };
    uint64_t fail_at = 1;
    for (;; fail_at++) {
        test_allocator test;
        test_allocator_init(&test, fail_at);
        tl_host host = { &test.allocator, NULL, NULL };
        tl_adjacency adjacency;
        tl_result result = tl_adjacency_bake(&view, &host, &adjacency, NULL);
        if (result == TL_OK) {
            tl_adjacency_free(&adjacency);
            TEST_CHECK(test.live_blocks == 0);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(test.live_blocks == 0 && adjacency.across == NULL);
    }
    TEST_CHECK(fail_at >= 3);
    tl_mesh_view huge = { NULL, 4, indices, TL_MAX_MESH_TRIANGLES + 1u, NULL };
    tl_adjacency adjacency;
    TEST_RESULT(tl_adjacency_bake(&huge, NULL, &adjacency, NULL), TL_ERR_LIMIT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equals_a_scan_over_all_edges),
        cmocka_unit_test(a_fan_of_many_triangles_is_linear),
        cmocka_unit_test(failing_memory_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
