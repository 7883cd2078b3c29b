// SPDX-License-Identifier: MIT
#include "talus_test.h"

#include "cli/shared/thread_pool.h"

#include <stdatomic.h>

enum { ITEMS = 20000 };

typedef struct probe {
    atomic_uint calls[ITEMS];
    atomic_uint busy[64]; // by worker: how many items it is inside of
    atomic_uint clashes;
    atomic_uint workers_seen;
    uint32_t worker_count;
} probe;

static void visit(uint32_t index, uint32_t worker, void *user)
{
    probe *p = user;
    if (worker >= p->worker_count || atomic_fetch_add(&p->busy[worker], 1) != 0) {
        atomic_fetch_add(&p->clashes, 1);
    }
    atomic_fetch_add(&p->calls[index], 1);
    atomic_fetch_or(&p->workers_seen, 1u << worker);
    atomic_fetch_sub(&p->busy[worker], 1);
}

static void check_pool(uint32_t worker_count)
{
    tl_thread_pool *pool = tl_thread_pool_create(worker_count);
    assert_non_null(pool);
    const tl_tasks *tasks = tl_thread_pool_tasks(pool);
    assert_int_equal(tasks->worker_count, worker_count);
    static probe p; // too large for the stack
    for (uint32_t round = 0; round < 40; ++round) {
        uint32_t count = round % 4 == 0 ? round % 3 : ITEMS - round;
        for (uint32_t i = 0; i < ITEMS; ++i) {
            atomic_store(&p.calls[i], 0);
        }
        atomic_store(&p.clashes, 0);
        p.worker_count = worker_count;
        tasks->run(visit, count, &p, tasks->user);
        for (uint32_t i = 0; i < ITEMS; ++i) {
            assert_int_equal(atomic_load(&p.calls[i]), i < count);
        }
        assert_int_equal(atomic_load(&p.clashes), 0);
    }
    assert_int_equal(atomic_load(&p.workers_seen) & 1u, 1u);
    tl_thread_pool_free(pool);
}

static void test_every_item_once(void **state)
{
    (void)state;
    check_pool(1);
    check_pool(2);
    check_pool(7);
}

// Items that wait for one another prove that the workers really run at the same time.
static void meet(uint32_t index, uint32_t worker, void *user)
{
    (void)index;
    (void)worker;
    atomic_uint *arrived = user;
    atomic_fetch_add(arrived, 1);
    while (atomic_load(arrived) < 3) {
    }
}

static void test_workers_run_together(void **state)
{
    (void)state;
    tl_thread_pool *pool = tl_thread_pool_create(3);
    assert_non_null(pool);
    const tl_tasks *tasks = tl_thread_pool_tasks(pool);
    atomic_uint arrived;
    atomic_init(&arrived, 0);
    tasks->run(meet, 3, &arrived, tasks->user);
    assert_int_equal(atomic_load(&arrived), 3);
    tl_thread_pool_free(pool);
}

static void test_create_and_free(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 50; ++i) {
        tl_thread_pool_free(tl_thread_pool_create(1 + i % 5));
    }
    tl_thread_pool_free(NULL);
    TEST_CHECK(tl_online_processors() >= 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_item_once),
        cmocka_unit_test(test_workers_run_together),
        cmocka_unit_test(test_create_and_free),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
