// SPDX-License-Identifier: MIT
//
// Monotone partition: what its name promises, on maps and on random storeys.

#include "nav_region_checks.h"

#include "nav_bake/regions/regions.h"

static void partition_only(const tl_nav_compact *compact, tl_arena *arena, tl_region_work *work)
{
    tl_arena_init(arena, NULL);
    uint32_t *region = calloc(compact->span_count + 1, sizeof *region);
    for (uint32_t c = 0; c < compact->width * compact->height; c++) {
        uint32_t x = c % compact->width, z = c / compact->width, border = compact->border_size;
        bool inside = x >= border && z >= border && x + border < compact->width && z + border < compact->height;
        for (uint32_t i = compact->first_span[c]; !inside && i < compact->first_span[c + 1]; i++) {
            region[i] = compact->area[i] != TL_NAV_NULL_AREA ? TL_NAV_BORDER_REGION | 1 : 0;
        }
    }
    tl_region_work made = { .compact = compact, .arena = arena, .region = region };
    TEST_RESULT(tl_regions_monotone(&made), TL_OK);
    *work = made;
}

// Before the merge a region has one run a row, of floors that are linked along x, and its rows follow one another.
static void one_run_a_row(void **state)
{
    (void)state;
    test_random random = { 77 };
    uint32_t regions = 0, long_regions = 0;
    for (int round = 0; round < 80; round++) {
        uint32_t border = round % 4 == 1 ? 2 : 0;
        uint32_t width = 5 + test_random_below(&random, 50);
        tl_nav_compact compact =
            fixture_random(&random, width, 40, 1 + round % 4, test_random_below(&random, 20), border);
        tl_arena arena;
        tl_region_work work;
        partition_only(&compact, &arena, &work);
        check_regions(&compact, work.region, work.region_count);
        uint32_t *last_row = calloc(work.region_count, sizeof *last_row), *first_row = calloc(work.region_count, 4);
        for (uint32_t c = 0; c < compact.width * compact.height; c++) {
            uint32_t row = 1 + c / compact.width;
            for (uint32_t i = compact.first_span[c]; i < compact.first_span[c + 1]; i++) {
                uint32_t r = work.region[i], left = tl_nav_compact_neighbour(&compact, i, 0);
                if (compact.area[i] != TL_NAV_NULL_AREA && r < work.region_count) {
                    TEST_CHECK(r != 0); // every inner walkable floor has one
                    bool run_begins = left == TL_NAV_NO_SPAN || work.region[left] != r;
                    TEST_CHECK(!run_begins || last_row[r] == 0 || last_row[r] == row - 1);
                    TEST_CHECK(run_begins || last_row[r] == row);
                    first_row[r] = first_row[r] == 0 ? row : first_row[r];
                    last_row[r] = row;
                }
            }
        }
        for (uint32_t r = 1; r < work.region_count; r++) {
            long_regions += last_row[r] - first_row[r] > 5;
        }
        regions += work.region_count;
        free(last_row);
        free(first_row);
        free(work.region);
        tl_arena_free(&arena);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(regions > 2000 && long_regions > 60);
}

static void example_fork(void **state)
{
    (void)state;
    static const char *const rows[] = {
        "0000000", // one run
        "0000000", // goes on
        "000 000", // forks: two new regions
        "000 000", // both go on
        "0000000", // touches both: a new one
        "aaa0000", // another area ends the run; the other goes on
    };
    tl_nav_compact compact = fixture_from_rows(rows, 6, 0);
    tl_arena arena;
    tl_region_work work;
    partition_only(&compact, &arena, &work);
    static const uint32_t expected[] = { 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 3, 3, 3,
                                         2, 2, 2, 3, 3, 3, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4, 4, 4 };
    TEST_CHECK(compact.span_count == 40 && work.region_count == 6);
    assert_memory_equal(work.region, expected, sizeof expected);
    free(work.region);
    tl_arena_free(&arena);
    fixture_compact_free(&compact);
}

static void whole_build(void **state)
{
    (void)state;
    test_random random = { 9 };
    uint32_t merged = 0;
    for (int round = 0; round < 40; round++) {
        tl_nav_compact compact =
            fixture_random(&random, 40, 40, 1 + round % 4, test_random_below(&random, 20), round % 2 == 0 ? 0 : 3);
        tl_nav_config config = region_config(TL_NAV_MONOTONE, 20, 60);
        TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK); // needs no distance field
        check_regions(&compact, compact.region, compact.region_count);
        TEST_CHECK(check_islands(&compact, 20) == compact.region_stats.filtered_spans);
        merged += compact.region_stats.merged;
        // Again: the old regions are replaced by the same.
        uint32_t *before = calloc(compact.span_count + 1, sizeof *before);
        memcpy(before, compact.region, compact.span_count * sizeof *before);
        TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
        assert_memory_equal(before, compact.region, compact.span_count * sizeof *before);
        free(before);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(merged > 200);
}

// A border that leaves nothing inside.
static void border_takes_all(void **state)
{
    (void)state;
    static const char *const rows[] = { "0000", "0000", "0000" };
    tl_nav_compact compact = fixture_from_rows(rows, 3, 2);
    for (int partition = 0; partition < 3; partition++) {
        tl_nav_config config = region_config((tl_nav_partition)partition, 20, 60);
        TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
        TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
        TEST_CHECK(compact.region_count == 1);
        for (uint32_t i = 0; i < compact.span_count; i++) {
            TEST_CHECK(tl_region_is_border(compact.region[i]));
        }
    }
    fixture_compact_free(&compact);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_run_a_row),
        cmocka_unit_test(example_fork),
        cmocka_unit_test(whole_build),
        cmocka_unit_test(border_takes_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
