// SPDX-License-Identifier: MIT
//
// Preparing by tasks: the same graph, bit for bit, for any number of workers, after edits too; cancelled, and out of
// memory.

#include "backward_tasks.h"
#include "nav_fixture.h"
#include "nav_query/prepared/visibility_graph.h"
#include "task_threads.h"

#include <talus/nav_prepare.h>

static void check_bytes(const void *a, const void *b, size_t bytes)
{
    TEST_CHECK(bytes == 0 || memcmp(a, b, bytes) == 0);
}

static void check_vertices(const tl_nav_visibility_graph *a, const tl_nav_visibility_graph *b)
{
    TEST_CHECK(a->vertex_room == b->vertex_room && a->vertex_count == b->vertex_count);
    TEST_CHECK(a->edge_count == b->edge_count && a->tile_bytes == b->tile_bytes && a->looked == b->looked);
    check_bytes(a->landmarks, b->landmarks, a->vertex_room * sizeof *a->landmarks);
    check_bytes(&a->landmark_error, &b->landmark_error, sizeof a->landmark_error);
    for (uint32_t v = 0; v < a->vertex_room; v++) {
        const tl_nav_corner_vertex *x = &a->vertices[v], *y = &b->vertices[v];
        TEST_CHECK(x->turn == y->turn && x->edge_count == y->edge_count && x->reach_count == y->reach_count);
        if (x->turn != 0) {
            check_bytes(x->edges, y->edges, x->edge_count * sizeof *x->edges);
            check_bytes(tl_nav_reach_of(x), tl_nav_reach_of(y), x->reach_count * sizeof *tl_nav_reach_of(x));
        }
    }
}

static void check_cones(const tl_nav_visibility_graph *a, const tl_nav_visibility_graph *b)
{
    TEST_CHECK(a->slot_count == b->slot_count);
    for (uint32_t slot = 0; slot < a->slot_count; slot++) {
        const tl_nav_corner_cones *x = &a->tiles[slot].cones, *y = &b->tiles[slot].cones;
        TEST_CHECK((x->first == NULL) == (y->first == NULL) && x->polygon_count == y->polygon_count);
        TEST_CHECK(x->count == y->count);
        if (x->first != NULL) {
            check_bytes(x->first, y->first, (x->polygon_count + 1) * sizeof *x->first);
            check_bytes(x->left_x, y->left_x, 4 * x->count * sizeof *x->left_x); // and the others, behind them
            check_bytes(x->vertex, y->vertex, x->count * sizeof *x->vertex);
        }
    }
}

static void check_tables(const tl_nav_visibility_graph *a, const tl_nav_visibility_graph *b)
{
    const size_t pairs = (size_t)a->vertex_room * a->vertex_room;
    TEST_CHECK((a->table == NULL) == (b->table == NULL));
    for (size_t i = 0; a->table != NULL && i < pairs; i++) {
        check_bytes(&a->table[i], &b->table[i], sizeof a->table[i]);
        TEST_CHECK(a->table[i] == INFINITY || a->table_next[i] == b->table_next[i]);
    }
}

// The first is prepared by this thread, the second by tasks.
static void prepare_both(tl_navmesh *const both[2], const tl_tasks *tasks, bool has_table)
{
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    tl_nav_prepared one, many;
    def.table_bytes = has_table ? UINT64_MAX - 1 : 0;
    TEST_RESULT(tl_navmesh_prepare(both[0], &def, &one), TL_OK);
    def.tasks = tasks;
    TEST_RESULT(tl_navmesh_prepare(both[1], &def, &many), TL_OK);
    TEST_CHECK(one.kind == many.kind && one.bytes == many.bytes && one.renewed_count == many.renewed_count);
    if (one.kind != TL_NAV_PREPARED_NONE) {
        check_vertices(both[0]->graph, both[1]->graph);
        check_cones(both[0]->graph, both[1]->graph);
        check_tables(both[0]->graph, both[1]->graph);
    }
}

static void compare_workers(const tl_tasks *tasks, uint64_t seed, uint32_t edits)
{
    test_random random = { seed };
    uint32_t graphs = 0;
    for (uint32_t round = 0; round < 5; round++) {
        fixture_level level = fixture_random(&random, round, 24);
        level.tile_cells = 4;
        tl_navmesh *const both[2] = { fixture_build(&level, NULL), fixture_build(&level, NULL) };
        for (uint32_t edit = 0; edit < edits; edit++) {
            prepare_both(both, tasks, edit % 4 == 3);
            graphs += tl_navmesh_is_prepared(both[1]);
            for (uint32_t i = 0; i < 1 + edit % 3; i++) {
                fixture_change_cell(&level, both, &random);
            }
        }
        tl_navmesh_destroy(both[0]);
        tl_navmesh_destroy(both[1]);
    }
    TEST_CHECK(graphs > 2 * edits);
}

static void test_any_order(void **state)
{
    (void)state;
    for (uint32_t workers = 1; workers <= 9; workers += 4) {
        tl_tasks tasks;
        test_backward_tasks(&tasks, workers);
        compare_workers(&tasks, workers, 12);
    }
}

static void test_threads(void **state)
{
    (void)state;
    uint32_t workers = 3;
    const tl_tasks tasks = { run_on_threads, workers, &workers };
    compare_workers(&tasks, 20, 8);
}

// Calls progress only between tasks, and stops where it says so.
typedef struct calls {
    uint32_t running, count, last;
} calls;

static void run_noted(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    calls *c = user;
    c->running++;
    for (uint32_t i = 0; i < count; i++) {
        task(i, i % 2, task_user);
    }
    c->running--;
}

static bool note_call(const char *stage, uint64_t done, uint64_t total, void *user)
{
    calls *c = user;
    (void)stage;
    TEST_CHECK(c->running == 0 && done <= total);
    return ++c->count != c->last;
}

static void test_cancel(void **state)
{
    (void)state;
    test_random random = { 30 };
    fixture_level level = fixture_random(&random, 1, 24);
    level.tile_cells = 4;
    uint32_t cancelled = 0;
    for (uint32_t last = 1;; last++) {
        calls c = { 0, 0, last };
        const tl_tasks tasks = { run_noted, 2, &c };
        const tl_progress progress = { note_call, &c };
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        tl_nav_prepare_def def = tl_default_nav_prepare_def();
        def.tasks = &tasks;
        def.progress = &progress;
        const tl_result result = tl_navmesh_prepare(navmesh, &def, NULL);
        TEST_CHECK(tl_navmesh_is_prepared(navmesh) == (result == TL_OK));
        tl_navmesh_destroy(navmesh);
        if (result == TL_OK) {
            break;
        }
        TEST_RESULT(result, TL_ERR_CANCELLED);
        cancelled++;
    }
    TEST_CHECK(cancelled > 10);
}

// Memory that fails, of any worker: nothing is left of the graph, and none of its memory. Returns how often it did.
static uint32_t fail_at_each(const fixture_level *level, const tl_nav_prepare_def *def, bool mends)
{
    fixture_level changed = *level;
    changed.cells[6][6] = level->cells[6][6] == '#' ? '0' : '#';
    tl_result result = TL_ERR_MEMORY;
    uint32_t failures = 0;
    while (result != TL_OK) {
        test_allocator failing;
        test_allocator_init(&failing, 0);
        tl_navmesh *navmesh = fixture_build(level, &failing.allocator);
        if (mends) {
            TEST_RESULT(tl_navmesh_prepare(navmesh, def, NULL), TL_OK);
            TEST_RESULT(tl_navmesh_remove_tile(navmesh, 1, 1), TL_OK);
            tl_nav_tile *tile = fixture_build_tile(&changed, 1, 1, &failing.allocator);
            TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
        }
        failing.calls = 0;
        failing.fail_at = failures + 1;
        result = tl_navmesh_prepare(navmesh, def, NULL);
        TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
        TEST_CHECK(tl_navmesh_is_prepared(navmesh) == (result == TL_OK));
        failures += result != TL_OK;
        tl_navmesh_destroy(navmesh);
        TEST_CHECK(failing.live_blocks == 0);
    }
    return failures;
}

static void test_memory(void **state)
{
    (void)state;
    test_random random = { 31 };
    fixture_level level = fixture_random(&random, 1, 16);
    level.tile_cells = 4;
    for (uint32_t workers = 1; workers <= 3; workers += 2) {
        tl_tasks tasks;
        test_backward_tasks(&tasks, workers);
        tl_nav_prepare_def def = tl_default_nav_prepare_def();
        def.tasks = &tasks;
        TEST_CHECK(fail_at_each(&level, &def, false) > 100);
        TEST_CHECK(fail_at_each(&level, &def, true) > 60);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_any_order),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_cancel),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
