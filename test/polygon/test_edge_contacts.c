// SPDX-License-Identifier: MIT
//
// After splitting, edges meet only in nodes: proved pair by pair, for scribbles of all sizes up to the limits.

#include "polygon/outline/outline.h"
#include "polygon_oracle.h"

#include <talus/polygon.h>

enum { MAX_POINTS = 64, MAX_NODES = 1 << 14 };

static bool meet_outside_ends(const tl_outline_nodes *nodes, tl_outline_edge e, tl_outline_edge f)
{
    const uint32_t ends[4] = { e.from, e.to, f.from, f.to };
    oracle_point p[4];
    for (uint32_t k = 0; k < 4; k++) {
        p[k].x = nodes->points[ends[k]].x;
        p[k].z = nodes->points[ends[k]].z;
    }
    if ((e.from == f.from && e.to == f.to) || (e.from == f.to && e.to == f.from)) {
        return false;
    }
    for (uint32_t k = 0; k < 4; k++) {
        uint32_t other = k < 2 ? 2 : 0;
        if (ends[k] != ends[other] && ends[k] != ends[other + 1] && oracle_between(p[other], p[other + 1], p[k])) {
            return true;
        }
    }
    bool shares = e.from == f.from || e.from == f.to || e.to == f.from || e.to == f.to;
    return !shares && oracle_segments_meet(p[0], p[1], p[2], p[3]);
}

// Splits a closed walk; returns the fault bits.
static uint32_t split(const tl_lattice_point *points, uint32_t n, tl_arena *arena, tl_outline_nodes *nodes,
                      tl_outline_edge **edges, uint32_t *count)
{
    nodes->points = TL_PUSH(arena, tl_lattice_point, n);
    nodes->heights = TL_PUSH(arena, int32_t, n);
    nodes->is_border = TL_PUSH_ZERO(arena, uint8_t, n);
    nodes->count = 0;
    nodes->capacity = n;
    *edges = TL_PUSH(arena, tl_outline_edge, n);
    *count = 0;
    uint32_t places[MAX_POINTS];
    for (uint32_t i = 0; i < n; i++) {
        places[i] = 0;
        while (places[i] < nodes->count && !tl_same_point(nodes->points[places[i]], points[i])) {
            places[i]++;
        }
        if (places[i] == nodes->count) {
            nodes->heights[nodes->count] = (int32_t)i;
            nodes->points[nodes->count++] = points[i];
        }
    }
    for (uint32_t i = 0; i < n; i++) {
        tl_outline_edge edge = { places[i], places[(i + 1) % n] };
        if (edge.from != edge.to) {
            (*edges)[(*count)++] = edge;
        }
    }
    uint32_t faults = 0, fault_edge = 0;
    tl_outline_sweep sweep;
    TEST_RESULT(tl_outline_split_contacts(arena, nodes, edges, count, &faults, &fault_edge, &sweep), TL_OK);
    return faults;
}

static void edges_meet_only_in_nodes_afterwards(void **state)
{
    (void)state;
    test_random random = { 61 };
    uint32_t crossed = 0, touched = 0, clean = 0, at_the_limit = 0;
    for (uint32_t round = 0; round < 6000; round++) {
        uint32_t n = 3 + test_random_below(&random, round % 20 == 0 ? 30 : 8);
        uint32_t shift = test_random_below(&random, 30);
        tl_lattice_point points[MAX_POINTS];
        for (uint32_t i = 0; i < n; i++) {
            points[i].x = (int32_t)test_random_below(&random, (2u << shift) + 1) - (1 << shift);
            points[i].z = (int32_t)test_random_below(&random, (2u << shift) + 1) - (1 << shift);
        }
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        tl_outline_nodes nodes;
        tl_outline_edge *edges;
        uint32_t count;
        uint32_t faults = split(points, n, &arena, &nodes, &edges, &count);
        TEST_CHECK((faults & TL_CONTOUR_FAULT_REFUSED) == 0);
        for (uint32_t i = 0; i < count; i++) {
            // Still one closed walk.
            TEST_CHECK(edges[i].to == edges[i + 1 < count ? i + 1 : 0].from && edges[i].from != edges[i].to);
            for (uint32_t j = 0; j < i; j++) {
                TEST_CHECK(!meet_outside_ends(&nodes, edges[i], edges[j]));
            }
        }
        crossed += (faults & TL_CONTOUR_FAULT_CROSSING) != 0;
        touched += (faults & TL_CONTOUR_FAULT_TOUCH) != 0;
        clean += faults == 0;
        at_the_limit += shift == 29 && (faults & TL_CONTOUR_FAULT_CROSSING) != 0;
        tl_arena_free(&arena);
    }
    TEST_CHECK(crossed > 2000 && touched > 200 && clean > 1000 && at_the_limit > 50);
}

static void crossings_are_rounded_to_the_nearest(void **state)
{
    (void)state;
    // (0, 0) to (10, 7) and (0, 7) to (10, 0) cross in (5, 3.5); halves go up. Heights follow the first edge.
    const tl_lattice_point points[4] = { { 0, 0 }, { 10, 7 }, { 10, 0 }, { 0, 7 } };
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_outline_nodes nodes;
    tl_outline_edge *edges;
    uint32_t count;
    TEST_CHECK(split(points, 4, &arena, &nodes, &edges, &count) == TL_CONTOUR_FAULT_CROSSING);
    TEST_CHECK(nodes.count == 5 && nodes.points[4].x == 5 && nodes.points[4].z == 4 && count == 6);
    TEST_CHECK(edges[0].to == 4 && edges[3].to == 4);
    tl_arena_free(&arena);
    // Across the whole range: the exact crossing is (0, 0).
    const int32_t limit = TL_MAX_CONTOUR_COORDINATE;
    const tl_lattice_point wide[4] = { { -limit, -limit }, { limit, limit }, { limit, -limit }, { -limit, limit } };
    tl_arena_init(&arena, NULL);
    TEST_CHECK(split(wide, 4, &arena, &nodes, &edges, &count) == TL_CONTOUR_FAULT_CROSSING);
    TEST_CHECK(nodes.count == 5 && nodes.points[4].x == 0 && nodes.points[4].z == 0);
    tl_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_meet_only_in_nodes_afterwards),
        cmocka_unit_test(crossings_are_rounded_to_the_nearest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
