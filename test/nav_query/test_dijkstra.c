// SPDX-License-Identifier: MIT
//
// Distances over a graph: the bits, and the vertices before, of the plainest form of the algorithm.

#include "nav_query/mending/dijkstra.h"
#include "talus_test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VERTICES = 300, MAX_EDGES = 24 };

typedef struct random_graph {
    tl_nav_visibility_graph graph;
    tl_nav_corner_vertex vertices[MAX_VERTICES];
    tl_nav_visibility_edge edges[MAX_VERTICES][MAX_EDGES];
} random_graph;

// By kind: in a square; on a coarse lattice, with many ties; two heaps of dust far apart; a line of growing steps; all
// at one place.
static void place_vertex(tl_nav_corner_vertex *vertex, uint32_t kind, uint32_t i, test_random *random)
{
    const float x = test_random_unit(random), z = test_random_unit(random);
    switch (kind) {
    case 0:
        vertex->x = 100.0f * x, vertex->z = 100.0f * z;
        break;
    case 1:
        vertex->x = floorf(4.0f * x), vertex->z = floorf(4.0f * z);
        break;
    case 2:
        vertex->x = 1e-30f * x + (i % 2 != 0 ? 1e18f : 0.0f), vertex->z = 1e-30f * z;
        break;
    case 3:
        vertex->x = ldexpf(1.0f, (int)(i % 60)), vertex->z = z;
        break;
    default:
        vertex->x = vertex->z = 7.0f;
        break;
    }
}

static void make_graph(random_graph *g, uint32_t kind, test_random *random)
{
    memset(g, 0, sizeof *g);
    const uint32_t count = 1 + test_random_below(random, MAX_VERTICES);
    g->graph.vertices = g->vertices;
    g->graph.vertex_room = g->graph.vertex_count = count;
    for (uint32_t i = 0; i < count; i++) {
        place_vertex(&g->vertices[i], kind, i, random);
        g->vertices[i].edges = g->edges[i];
    }
    const uint32_t wanted = test_random_below(random, 6 * count);
    for (uint32_t k = 0; k < wanted; k++) {
        const uint32_t ends[2] = { test_random_below(random, count), test_random_below(random, count) };
        for (int i = 0; i < 2; i++) {
            tl_nav_corner_vertex *from = &g->vertices[ends[i]];
            const tl_nav_corner_vertex *to = &g->vertices[ends[1 - i]];
            if (from->edge_count < MAX_EDGES) {
                const tl_nav_visibility_edge edge = { ends[1 - i], to->x, to->z };
                g->edges[ends[i]][from->edge_count++] = edge;
                g->graph.edge_count++;
            }
        }
    }
}

// The nearest that is left, the lowest of equal ones, one after another.
static void measure_plainly(const random_graph *g, const uint32_t *sources, uint32_t source_count, double *length,
                            uint32_t *before)
{
    bool is_done[MAX_VERTICES] = { false };
    for (uint32_t i = 0; i < g->graph.vertex_room; i++) {
        length[i] = (double)INFINITY;
    }
    for (uint32_t i = 0; i < source_count; i++) {
        length[sources[i]] = 0.0;
        before[sources[i]] = sources[i];
    }
    for (;;) {
        uint32_t next = UINT32_MAX;
        for (uint32_t i = 0; i < g->graph.vertex_room; i++) {
            if (!is_done[i] && length[i] < (double)INFINITY && (next == UINT32_MAX || length[i] < length[next])) {
                next = i;
            }
        }
        if (next == UINT32_MAX) {
            return;
        }
        is_done[next] = true;
        for (uint32_t e = 0; e < g->vertices[next].edge_count; e++) {
            const tl_nav_visibility_edge *edge = &g->edges[next][e];
            const double through = length[next] + tl_nav_visibility_edge_length(&g->vertices[next], edge);
            if (through < length[edge->to]) {
                length[edge->to] = through;
                before[edge->to] = next;
            }
        }
    }
}

static void compare_runs(random_graph *g, test_random *random, tl_nav_dijkstra_team *team)
{
    static double length[MAX_VERTICES];
    static uint32_t before[MAX_VERTICES];
    for (uint32_t run = 0; run < 4; run++) {
        uint32_t sources[3];
        const uint32_t count = 1 + test_random_below(random, 3);
        for (uint32_t i = 0; i < count; i++) {
            sources[i] = test_random_below(random, g->graph.vertex_room);
        }
        const tl_nav_dijkstra *search = tl_nav_dijkstra_run(team, 0, sources, count);
        TEST_CHECK(search != NULL && tl_nav_dijkstra_result(team) == TL_OK);
        measure_plainly(g, sources, count, length, before);
        for (uint32_t i = 0; i < g->graph.vertex_room; i++) {
            TEST_CHECK(search->length[i] == length[i]);
            TEST_CHECK(length[i] == (double)INFINITY || search->before[i] == before[i]);
        }
    }
}

static void test_plain_form(void **state)
{
    (void)state;
    static random_graph g;
    test_random random = { 1 };
    const tl_host host = { NULL, NULL, NULL };
    for (uint32_t round = 0; round < 400; round++) {
        tl_stage stage;
        tl_nav_dijkstra_team team;
        make_graph(&g, round % 5, &random);
        TEST_RESULT(tl_stage_begin(&stage, &host, "lengths", 1), TL_OK);
        TEST_RESULT(tl_nav_dijkstra_begin(NULL, &g.graph, &stage, &team), TL_OK);
        compare_runs(&g, &random, &team);
        tl_nav_dijkstra_end(&team);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_plain_form) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
