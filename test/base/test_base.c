// SPDX-License-Identifier: MIT
//
// The small parts of base: result.c, host.c, range_fits.h, hash.c (against published vectors), radix_sort.c.

#include "talus_test.h"

#include "base/hash.h"
#include "base/host.h"
#include "base/radix_sort.h"
#include "base/range_fits.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void every_result_has_words(void **state)
{
    (void)state;
    for (int i = 0; i < TL_RESULT_COUNT; i++) {
        const char *name = tl_result_name((tl_result)i);
        TEST_CHECK(strncmp(name, "TL_", 3) == 0 && strlen(tl_result_text((tl_result)i)) > 5);
        for (int j = 0; j < i; j++) {
            TEST_CHECK(strcmp(name, tl_result_name((tl_result)j)) != 0);
            TEST_CHECK(strcmp(tl_result_text((tl_result)i), tl_result_text((tl_result)j)) != 0);
        }
    }
    TEST_CHECK(tl_result_name(TL_RESULT_COUNT) != NULL && tl_result_text((tl_result)-1) != NULL);
    char version[32];
    snprintf(version, sizeof version, "%d.%d.%d", TL_VERSION_MAJOR, TL_VERSION_MINOR, TL_VERSION_PATCH);
    assert_string_equal(tl_version(), version);
}

static void add_index(uint32_t index, uint32_t worker, void *user)
{
    uint32_t *sum = user;
    *sum += index + worker;
}

static void run_backwards(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    (*(uint32_t *)user)++;
    for (uint32_t i = count; i > 0; i--) {
        task(i - 1, 0, task_user);
    }
}

static bool count_updates(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)stage;
    (*(int *)user)++;
    return done < total;
}

static void host_defaults_and_hooks(void **state)
{
    (void)state;
    uint32_t sum = 0;
    tl_run_tasks(NULL, add_index, 10, &sum);
    assert_int_equal(sum, 45);
    TEST_CHECK(tl_worker_count(NULL) == 1);
    TEST_RESULT(tl_progress_update(NULL, "x", 0, 1), TL_OK);

    uint32_t runs = 0;
    int updates = 0;
    tl_tasks tasks = { run_backwards, 3, &runs };
    tl_progress progress = { count_updates, &updates };
    tl_host host = { NULL, &tasks, &progress };
    tl_run_tasks(&host, add_index, 10, &sum);
    assert_int_equal(sum, 90);
    assert_int_equal(runs, 1);
    TEST_CHECK(tl_worker_count(&host) == 3);
    TEST_RESULT(tl_progress_update(&host, "x", 0, 1), TL_OK);
    TEST_RESULT(tl_progress_update(&host, "x", 1, 1), TL_ERR_CANCELLED);
    assert_int_equal(updates, 2);

    tl_report report;
    tl_report_begin(&report, "stage");
    TEST_CHECK(report.element == NULL && report.element_index == TL_NO_ELEMENT);
    TEST_RESULT(tl_report_fail(&report, TL_ERR_INDEX, "triangle", 7, "advice"), TL_ERR_INDEX);
    TEST_CHECK(report.element_index == 7 && strcmp(report.element, "triangle") == 0);
    TEST_RESULT(tl_report_fail(NULL, TL_ERR_INDEX, "triangle", 7, "advice"), TL_ERR_INDEX);
}

static void ranges_fit_without_overflow(void **state)
{
    (void)state;
    TEST_CHECK(tl_range_fits(0, 0, 0, 0) && tl_range_fits(8, 2, 4, 16) && !tl_range_fits(8, 3, 4, 16));
    TEST_CHECK(!tl_range_fits(UINT64_MAX, 1, 1, 16) && !tl_range_fits(1, UINT64_MAX, UINT64_MAX, UINT64_MAX));
    TEST_CHECK(tl_range_fits(16, 0, 4, 16) && !tl_range_fits(17, 0, 4, 16));
}

// Vectors of the xxHash specification's reference: empty input, and the test that other implementations print.
static void hash_equals_published_vectors(void **state)
{
    (void)state;
    TEST_CHECK(tl_hash_bytes("", 0, 0) == 0xef46db3751d8e999u);
    TEST_CHECK(tl_hash_bytes("a", 1, 0) == 0xd24ec4f1a98c6e5bu);
    TEST_CHECK(tl_hash_bytes("abc", 3, 0) == 0x44bc2cf5ad770999u);
    const char *sentence = "Nobody inspects the spammish repetition";
    TEST_CHECK(tl_hash_bytes(sentence, strlen(sentence), 0) == 0xfbcea83c8a378bf1u);
}

static void mix_is_a_bijection_on_samples(void **state)
{
    (void)state;
    tl_sort_item items[4096];
    tl_sort_item scratch[4096];
    for (uint32_t i = 0; i < 4096; i++) {
        tl_sort_item item = { tl_hash_mix(i), i, 0 };
        items[i] = item;
    }
    tl_radix_sort(items, scratch, 4096);
    for (uint32_t i = 1; i < 4096; i++) {
        TEST_CHECK(items[i - 1].key < items[i].key);
    }
}

static int compare_items(const void *a, const void *b)
{
    const tl_sort_item *x = a;
    const tl_sort_item *y = b;
    if (x->key != y->key) {
        return x->key < y->key ? -1 : 1;
    }
    return x->value < y->value ? -1 : x->value > y->value;
}

static void radix_sort_is_stable_and_right(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t equal_neighbours = 0;
    for (uint32_t round = 0; round < 60; round++) {
        uint32_t count = round < 50 ? round * 3 : 20000;
        tl_sort_item *items = calloc(count + 1, sizeof *items);
        tl_sort_item *expected = calloc(count + 1, sizeof *items);
        tl_sort_item *scratch = calloc(count + 1, sizeof *items);
        uint64_t mask = round % 3 == 0 ? 0xf : round % 3 == 1 ? 0xff00ff0000000000u : UINT64_MAX;
        for (uint32_t i = 0; i < count; i++) {
            tl_sort_item item = { test_random_u64(&random) & mask, i, ~i };
            items[i] = expected[i] = item;
        }
        qsort(expected, count, sizeof *expected, compare_items);
        tl_radix_sort(items, scratch, count);
        for (uint32_t i = 0; i < count; i++) {
            TEST_CHECK(items[i].key == expected[i].key && items[i].value == expected[i].value);
            TEST_CHECK(items[i].extra == ~items[i].value);
            equal_neighbours += i > 0 && items[i].key == items[i - 1].key;
        }
        free(items);
        free(expected);
        free(scratch);
    }
    TEST_CHECK(equal_neighbours > 1000);
}

static void float_keys_keep_order(void **state)
{
    (void)state;
    const float ascending[] = { -INFINITY, -1e30f, -1.0f, -1e-40f, -0.0f, 0.0f, 1e-40f, 1.0f, 1e30f, INFINITY };
    for (size_t i = 1; i < sizeof ascending / sizeof *ascending; i++) {
        TEST_CHECK(tl_float_sort_key(ascending[i - 1]) < tl_float_sort_key(ascending[i]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_result_has_words),        cmocka_unit_test(host_defaults_and_hooks),
        cmocka_unit_test(ranges_fit_without_overflow),   cmocka_unit_test(hash_equals_published_vectors),
        cmocka_unit_test(mix_is_a_bijection_on_samples), cmocka_unit_test(radix_sort_is_stable_and_right),
        cmocka_unit_test(float_keys_keep_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
