// SPDX-License-Identifier: MIT
//
// soup_bake.c: bad input by name, failing memory, cancelling, and the same bytes for any number of threads.

#include "soup_models.h"

#include <pthread.h>

static tl_result build(const tl_mesh_view *view, const tl_soup_def *def, tl_soup_report *report)
{
    tl_soup *soup = (tl_soup *)(uintptr_t)64;
    tl_result result = tl_soup_bake(view, def, &soup, report);
    TEST_CHECK((soup != NULL) == (result == TL_OK));
    tl_blob_free(soup);
    return result;
}

static void test_bad_input_is_named(void **state)
{
    (void)state;
    model m = model_random(20, 5, 1, 1);
    tl_mesh_view view = model_view(&m);
    tl_soup_report report;
    view.triangle_count = 0;
    TEST_RESULT(build(&view, NULL, &report), TL_ERR_EMPTY);
    view.triangle_count = TL_MAX_SOUP_TRIANGLES + 1;
    TEST_RESULT(build(&view, NULL, &report), TL_ERR_LIMIT);
    view = model_view(&m);
    tl_vec3 kept = m.vertices[7];
    m.vertices[7].y = NAN;
    TEST_RESULT(build(&view, NULL, &report), TL_ERR_NOT_FINITE);
    TEST_CHECK(report.base.element_index == 7 && strcmp(report.base.element, "vertex") == 0);
    m.vertices[7].y = -INFINITY;
    TEST_RESULT(build(&view, NULL, &report), TL_ERR_NOT_FINITE);
    m.vertices[7].y = 2 * TL_MAX_COORDINATE;
    TEST_RESULT(build(&view, NULL, &report), TL_ERR_RANGE);
    TEST_CHECK(report.base.element_index == 7);
    m.vertices[7] = kept;
    m.indices[3 * 4 + 1] = m.vertex_count;
    TEST_RESULT(build(&view, NULL, &report), TL_ERR_INDEX);
    TEST_CHECK(report.base.element_index == 4 && strcmp(report.base.element, "triangle") == 0);
    m.indices[3 * 4 + 1] = m.indices[3 * 4];
    TEST_RESULT(build(&view, NULL, &report), TL_OK);
    TEST_CHECK(report.degenerate_triangles == 1 && report.triangle_count == 19);
    tl_soup_def def = tl_default_soup_def();
    static const float bad[] = { -0.1f, 1.1f, NAN, INFINITY };
    for (uint32_t i = 0; i < 4; i++) {
        def.split_budget = bad[i];
        TEST_RESULT(build(&view, &def, &report), TL_ERR_ARGUMENT);
        TEST_CHECK(strcmp(report.base.field, "split_budget") == 0);
    }
    def = tl_default_soup_def();
    def.partition = (tl_soup_partition)2;
    TEST_RESULT(build(&view, &def, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.base.field, "partition") == 0);
    def = tl_default_soup_def();
    def.quality = (tl_soup_quality)3;
    TEST_RESULT(build(&view, &def, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.base.field, "quality") == 0);
    model_free(&m);
}

static void test_degenerate_input(void **state)
{
    (void)state;
    tl_vec3 line[6] = { { 0, 0, 0 }, { 1, 2, 3 }, { 2, 4, 6 }, { 5, 5, 5 }, { 5, 5, 5 }, { 5, 5, 5 } };
    uint32_t indices[9] = { 0, 1, 2, 3, 4, 5, 0, 0, 1 };
    tl_mesh_view view = { line, 6, indices, 3, NULL };
    tl_soup_report report;
    TEST_RESULT(build(&view, NULL, &report), TL_ERR_DEGENERATE);
    TEST_CHECK(report.degenerate_triangles == 3 && report.base.advice != NULL);
    // All in one plane is fine.
    tl_vec3 flat[4] = { { 0, 3, 0 }, { 1, 3, 0 }, { 1, 3, 1 }, { 0, 3, 1 } };
    uint32_t quad[6] = { 0, 1, 2, 0, 2, 3 };
    tl_mesh_view plane = { flat, 4, quad, 2, NULL };
    TEST_RESULT(build(&plane, NULL, &report), TL_OK);
    TEST_CHECK(report.pair_count == 1 && report.single_count == 0);
    // A thousand copies of one triangle cannot be parted by any plane.
    model m = { 0 };
    for (uint32_t i = 0; i < 1000; i++) {
        uint32_t a = model_vertex(&m, 0, 0, 0);
        model_vertex(&m, 1, 0, 0);
        model_vertex(&m, 0, 1, 0);
        model_triangle(&m, a, a + 1, a + 2);
    }
    tl_mesh_view same = model_view(&m);
    TEST_RESULT(build(&same, NULL, &report), TL_OK);
    TEST_CHECK(report.triangle_count == 1000 && report.coincident_count == 875);
    model_free(&m);
}

static void test_memory_fails_anywhere(void **state)
{
    (void)state;
    model m = model_terrain(12, 2, tl_vec3_make(0, 0, 0), 1);
    uint16_t *materials = calloc(m.triangle_count, sizeof *materials);
    TEST_CHECK(materials != NULL);
    materials[3] = 9;
    tl_mesh_view view = model_view(&m);
    view.materials = materials;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        tl_soup_def def = model_soup_def(storage);
        uint32_t failures = 0;
        for (uint64_t k = 1;; k++) {
            test_allocator allocator;
            test_allocator_init(&allocator, k);
            def.host.allocator = &allocator.allocator;
            tl_soup_report report;
            tl_result result = build(&view, &def, &report);
            TEST_CHECK(allocator.live_blocks == 0 && allocator.live_bytes == 0);
            if (result == TL_OK) {
                break;
            }
            TEST_RESULT(result, TL_ERR_MEMORY);
            failures++;
        }
        TEST_CHECK(failures >= 4);
    }
    free(materials);
    model_free(&m);
}

typedef struct patience {
    uint32_t calls, limit;
} patience;

static bool be_patient(const char *stage, uint64_t done, uint64_t total, void *user)
{
    patience *p = user;
    TEST_CHECK(stage != NULL && done <= total);
    return ++p->calls <= p->limit;
}

static void test_cancel_at_every_call(void **state)
{
    (void)state;
    model m = model_random(100, 5, 1, 3);
    tl_mesh_view view = model_view(&m);
    tl_soup_def def = tl_default_soup_def();
    test_allocator allocator;
    test_allocator_init(&allocator, 0);
    uint32_t cancelled = 0;
    for (uint32_t limit = 0;; limit++) {
        patience p = { 0, limit };
        tl_progress progress = { be_patient, &p };
        def.host.progress = &progress;
        def.host.allocator = &allocator.allocator;
        tl_result result = build(&view, &def, NULL);
        TEST_CHECK(allocator.live_blocks == 0);
        if (result == TL_OK) {
            break;
        }
        TEST_RESULT(result, TL_ERR_CANCELLED);
        cancelled++;
    }
    TEST_CHECK(cancelled >= 6);
    model_free(&m);
}

// What a bake holds at its peak, the soup included: the level's own arrays are not counted.
static double bytes_a_triangle(const model *m, tl_soup_def def)
{
    tl_mesh_view view = model_view(m);
    test_allocator memory;
    test_allocator_init(&memory, 0);
    def.host.allocator = &memory.allocator;
    tl_soup_report report;
    TEST_RESULT(build(&view, &def, &report), TL_OK);
    TEST_CHECK(report.base.peak_bytes == memory.peak_bytes && memory.live_blocks == 0);
    return (double)memory.peak_bytes / (double)m->triangle_count;
}

static void shuffle_triangles(model *m)
{
    test_random random = { 5 };
    for (uint32_t i = m->triangle_count - 1; i > 0; i--) {
        uint32_t other = test_random_below(&random, i + 1);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t swap = m->indices[3 * i + k];
            m->indices[3 * i + k] = m->indices[3 * other + k];
            m->indices[3 * other + k] = swap;
        }
    }
}

static void test_memory_of_a_bake(void **state)
{
    (void)state;
    model m = model_terrain(250, 3, tl_vec3_make(0, 0, 0), 9);
    tl_soup_def compact = tl_default_soup_def();
    compact.layout = TL_SOUP_COMPACT;
    const double ordered = bytes_a_triangle(&m, tl_default_soup_def()), small = bytes_a_triangle(&m, compact);
    shuffle_triangles(&m);
    const double shuffled = bytes_a_triangle(&m, tl_default_soup_def());
    print_message("%.1f bytes a triangle, compact %.1f, in no order %.1f\n", ordered, small, shuffled);
    TEST_CHECK(ordered <= 90 && small <= 90 && shuffled <= 110);
    model_free(&m);
}

// Between two progress calls lies a bounded amount of work: so many tasks of a bounded size, or a step of a loop. Twice
// the triangles bring twice the calls.
typedef struct pace {
    uint32_t calls, tasks_since, max_tasks;
    uint64_t done;
    const char *stage;
} pace;

static bool note_pace(const char *stage, uint64_t done, uint64_t total, void *user)
{
    pace *p = user;
    TEST_CHECK(done <= total && (stage != p->stage || done >= p->done));
    p->max_tasks = p->tasks_since > p->max_tasks ? p->tasks_since : p->max_tasks;
    p->tasks_since = 0;
    p->calls++;
    p->stage = stage;
    p->done = done;
    return true;
}

static void run_counted(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    pace *p = user;
    p->tasks_since += count;
    for (uint32_t i = 0; i < count; i++) {
        task(i, 0, task_user);
    }
}

static void test_progress_is_called_often(void **state)
{
    (void)state;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        for (uint32_t shuffled = 0; shuffled < 2; shuffled++) {
            uint32_t calls[2];
            for (uint32_t size = 0; size < 2; size++) {
                model m = model_terrain(size == 0 ? 96 : 288, 3, tl_vec3_make(0, 0, 0), 9);
                if (shuffled) {
                    shuffle_triangles(&m);
                }
                tl_mesh_view view = model_view(&m);
                pace p = { .calls = 0 };
                const tl_progress progress = { note_pace, &p };
                const tl_tasks tasks = { run_counted, 1, &p };
                tl_soup_def def = model_soup_def(storage);
                def.host.progress = &progress;
                def.host.tasks = &tasks;
                TEST_RESULT(build(&view, &def, NULL), TL_OK);
                TEST_CHECK(p.max_tasks <= 64);
                calls[size] = p.calls;
                TEST_CHECK(p.calls >= m.triangle_count / 32768 * 5);
                model_free(&m);
            }
            TEST_CHECK(calls[1] > calls[0]);
        }
    }
}

// The second part of the top of the tree, and all of its tasks.
static void test_large_soups_do_not_depend_on_tasks(void **state)
{
    (void)state;
    model m = model_terrain(760, 3, tl_vec3_make(0, 0, 0), 9);
    tl_mesh_view view = model_view(&m);
    pace p = { .calls = 0 };
    const tl_progress progress = { note_pace, &p };
    const tl_tasks tasks = { run_counted, 3, &p };
    tl_soup_def def = tl_default_soup_def();
    tl_soup *alone = NULL, *together = NULL;
    TEST_RESULT(tl_soup_bake(&view, &def, &alone, NULL), TL_OK);
    def.host.progress = &progress;
    def.host.tasks = &tasks;
    TEST_RESULT(tl_soup_bake(&view, &def, &together, NULL), TL_OK);
    print_message("%u calls, %u tasks between two of them at most\n", p.calls, p.max_tasks);
    TEST_CHECK(p.max_tasks <= 3 * 64 && p.calls > 60);
    TEST_CHECK(tl_soup_size(alone) == tl_soup_size(together));
    TEST_CHECK(memcmp(alone, together, tl_soup_size(alone)) == 0);
    TEST_RESULT(tl_soup_check(alone, tl_soup_size(alone), NULL), TL_OK);
    tl_blob_free(alone);
    tl_blob_free(together);
    model_free(&m);
}

// A job system of a few threads that take items in an order of its own: from the far end, or as a seed has it.
typedef struct pool {
    tl_task_fn *task;
    void *task_user;
    uint32_t count, left, step;
    uint32_t workers, seed;
    pthread_mutex_t lock;
} pool;

typedef struct pool_worker {
    pool *p;
    uint32_t index;
} pool_worker;

static void *pool_run(void *argument)
{
    pool_worker *worker = argument;
    pool *p = worker->p;
    for (;;) {
        pthread_mutex_lock(&p->lock);
        uint32_t left = p->left;
        p->left -= left > 0;
        pthread_mutex_unlock(&p->lock);
        if (left == 0) {
            return NULL;
        }
        p->task((uint32_t)((uint64_t)left * p->step % p->count), worker->index, p->task_user);
    }
}

static uint32_t common_divisor(uint32_t a, uint32_t b)
{
    return b == 0 ? a : common_divisor(b, a % b);
}

static void run_on_threads(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    pool *p = user;
    p->task = task;
    p->task_user = task_user;
    p->count = count;
    p->left = count;
    // Any step without a common divisor takes all items once.
    p->seed = p->seed * 1664525u + 1013904223u;
    for (p->step = 1 + p->seed % count; common_divisor(p->step, count) != 1; p->step++) {
    }
    pthread_t threads[8];
    pool_worker workers[8];
    for (uint32_t i = 0; i < p->workers; i++) {
        workers[i].p = p;
        workers[i].index = i;
        TEST_CHECK(pthread_create(&threads[i], NULL, pool_run, &workers[i]) == 0);
    }
    for (uint32_t i = 0; i < p->workers; i++) {
        pthread_join(threads[i], NULL);
    }
}

static void check_threads(const model *m, tl_soup_def def)
{
    tl_mesh_view view = model_view(m);
    tl_soup *alone = NULL;
    TEST_RESULT(tl_soup_bake(&view, &def, &alone, NULL), TL_OK);
    for (uint32_t workers = 1; workers <= 4; workers++) {
        pool p = { .workers = workers, .seed = workers };
        pthread_mutex_init(&p.lock, NULL);
        tl_tasks tasks = { run_on_threads, workers, &p };
        def.host.tasks = &tasks;
        tl_soup *together = NULL;
        TEST_RESULT(tl_soup_bake(&view, &def, &together, NULL), TL_OK);
        TEST_CHECK(tl_soup_size(alone) == tl_soup_size(together));
        TEST_CHECK(memcmp(alone, together, tl_soup_size(alone)) == 0);
        tl_blob_free(together);
        pthread_mutex_destroy(&p.lock);
    }
    tl_blob_free(alone);
}

static void test_threads_give_the_same_bytes(void **state)
{
    (void)state;
    // Some 30,000 triangles: many subtrees, several chunks of pairs.
    model terrain = model_terrain(120, 3, tl_vec3_make(0, 0, 0), 9);
    for (uint32_t layout = 0; layout < 2; layout++) {
        for (uint32_t budget = 0; budget < 2; budget++) {
            tl_soup_def def = tl_default_soup_def();
            def.layout = (tl_soup_layout)layout;
            def.split_budget = budget == 0 ? 0.0f : 0.3f;
            check_threads(&terrain, def);
        }
    }
    // In no order: most pairs lie over the borders of chunks.
    shuffle_triangles(&terrain);
    tl_soup_def planes = tl_default_soup_def();
    planes.partition = TL_SOUP_KD_TREE;
    check_threads(&terrain, planes);
    check_threads(&terrain, tl_default_soup_def());
    tl_soup_report report;
    tl_mesh_view view = model_view(&terrain);
    TEST_RESULT(build(&view, NULL, &report), TL_OK);
    TEST_CHECK(report.single_count < report.triangle_count / 50);
    model_free(&terrain);
}

// Input that is never read must not matter: unused vertices, and the padding of nothing.
static void test_unused_vertices_may_hold_anything(void **state)
{
    (void)state;
    model m = model_random(10, 5, 1, 5);
    tl_soup *clean = model_soup(&m, NULL);
    model_vertex(&m, NAN, INFINITY, 3e38f);
    tl_soup *dirty = model_soup(&m, NULL);
    TEST_CHECK(tl_soup_size(clean) == tl_soup_size(dirty) && memcmp(clean, dirty, tl_soup_size(clean)) == 0);
    tl_blob_free(clean);
    tl_blob_free(dirty);
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bad_input_is_named),
        cmocka_unit_test(test_degenerate_input),
        cmocka_unit_test(test_memory_fails_anywhere),
        cmocka_unit_test(test_cancel_at_every_call),
        cmocka_unit_test(test_memory_of_a_bake),
        cmocka_unit_test(test_progress_is_called_often),
        cmocka_unit_test(test_large_soups_do_not_depend_on_tasks),
        cmocka_unit_test(test_threads_give_the_same_bytes),
        cmocka_unit_test(test_unused_vertices_may_hold_anything),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
