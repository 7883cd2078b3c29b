// SPDX-License-Identifier: MIT
//
// stage.c: every task runs once, no batch is larger than asked for, progress runs from 0 to the total, and a stage ends
// where it is cancelled.

#include "base/stage.h"

#include "talus_test.h"

#include <string.h>

typedef struct record {
    uint32_t runs[1000];
    uint32_t since_update, max_between; // tasks
    uint32_t updates, cancel_at;
    uint64_t done, total;
} record;

static void count_task(uint32_t index, uint32_t worker, void *user)
{
    record *r = user;
    TEST_CHECK(worker == 0);
    r->runs[index]++;
    r->since_update++;
}

static bool note(const char *stage, uint64_t done, uint64_t total, void *user)
{
    record *r = user;
    TEST_CHECK(strcmp(stage, "dig") == 0 && done >= r->done && done <= total);
    r->done = done;
    r->total = total;
    r->max_between = r->since_update > r->max_between ? r->since_update : r->max_between;
    r->since_update = 0;
    return ++r->updates != r->cancel_at;
}

static void test_batches_are_bounded(void **state)
{
    (void)state;
    for (uint32_t count = 0; count <= 1000; count = 3 * count + 1) {
        for (uint32_t batch = 1; batch <= 64; batch *= 8) {
            record r = { .cancel_at = 0 };
            const tl_progress progress = { note, &r };
            const tl_host host = { .progress = &progress };
            tl_stage stage;
            TEST_RESULT(tl_stage_begin(&stage, &host, "dig", 500), TL_OK);
            TEST_RESULT(tl_stage_run(&stage, count_task, count, &r, batch, 300), TL_OK);
            TEST_CHECK(r.done == (count > 0 ? 300 : 0) && r.total == 500);
            for (uint32_t i = 0; i < 1000; i++) {
                TEST_CHECK(r.runs[i] == (i < count));
            }
            TEST_CHECK(r.max_between <= batch && r.since_update == 0);
            TEST_RESULT(tl_stage_add(&stage, 1000), TL_OK);
            TEST_CHECK(r.done == 500);
            TEST_RESULT(tl_stage_end(&stage), TL_OK);
        }
    }
}

static void test_cancelling_ends_the_stage(void **state)
{
    (void)state;
    for (uint32_t cancel_at = 1; cancel_at <= 6; cancel_at++) {
        record r = { .cancel_at = cancel_at };
        const tl_progress progress = { note, &r };
        const tl_host host = { .progress = &progress };
        tl_stage stage;
        tl_result result = tl_stage_begin(&stage, &host, "dig", 10);
        result = result == TL_OK ? tl_stage_run(&stage, count_task, 40, &r, 10, 10) : result;
        result = result == TL_OK ? tl_stage_end(&stage) : result;
        TEST_RESULT(result, TL_ERR_CANCELLED);
        TEST_CHECK(r.updates == cancel_at && r.runs[0] == (cancel_at > 1) && r.runs[39] == (cancel_at >= 5));
    }
}

static void test_steps_of_loops(void **state)
{
    (void)state;
    record r = { .cancel_at = 0 };
    const tl_progress progress = { note, &r };
    const tl_host host = { .progress = &progress };
    tl_stage stage;
    TEST_RESULT(tl_stage_begin(&stage, &host, "dig", 10), TL_OK);
    for (uint64_t i = 0; i < 4 * (uint64_t)TL_STAGE_STEP; i++) {
        TEST_RESULT(tl_stage_tick(&stage, i), TL_OK);
    }
    TEST_CHECK(r.updates == 5 && r.done == 0);
    TEST_CHECK(tl_stage_step_end(0, 5) == 5 && tl_stage_step_end(0, 2 * TL_STAGE_STEP) == TL_STAGE_STEP);
    TEST_CHECK(tl_stage_step_end(0xffff0000u, UINT32_MAX) == UINT32_MAX);
    // Nobody listens.
    TEST_RESULT(tl_stage_add(NULL, 5), TL_OK);
    TEST_RESULT(tl_stage_run(NULL, count_task, 1000, &r, 1, 0), TL_OK);
    TEST_CHECK(r.runs[999] == 1);
}

static void test_copy(void **state)
{
    (void)state;
    enum { BYTES = 5 * (1 << 20) + 77 };
    uint8_t *from = malloc(BYTES), *to = calloc(BYTES, 1);
    TEST_CHECK(from != NULL && to != NULL);
    for (uint32_t i = 0; i < BYTES; i++) {
        from[i] = (uint8_t)(i * 2654435761u >> 24);
    }
    TEST_RESULT(tl_stage_copy(NULL, to, from, BYTES), TL_OK);
    TEST_CHECK(memcmp(from, to, BYTES) == 0);
    TEST_RESULT(tl_stage_copy(NULL, to, from, 0), TL_OK);
    free(from);
    free(to);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_batches_are_bounded),
        cmocka_unit_test(test_cancelling_ends_the_stage),
        cmocka_unit_test(test_steps_of_loops),
        cmocka_unit_test(test_copy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
