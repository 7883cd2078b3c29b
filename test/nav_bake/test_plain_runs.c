// SPDX-License-Identifier: MIT
//
// Plain runs say the truth about neighbours; and erosion and the distance field, which take runs by rows, give what
// they give floor by floor: a compact heightfield with 32-bit neighbours instead of steps has no runs.

#include "nav_compact_fixture.h"
#include "nav_fields.h"

#include "nav_bake/floors/floor_bands.h"

// The fixture's neighbours as steps.
static int16_t *steps_of(const tl_nav_compact *compact)
{
    const size_t count = 4 * (size_t)compact->span_count;
    int16_t *step = (int16_t *)tl_allocate_array(NULL, count, sizeof *step);
    for (size_t i = 0; i < count; i++) {
        const uint32_t to = compact->neighbour[i];
        step[i] = to == TL_NAV_NO_SPAN ? (int16_t)0 : (int16_t)((int32_t)to - (int32_t)(i / 4));
    }
    return step;
}

// Wide enough for runs; some floors are not walkable, or of another area.
static tl_nav_compact random_ground(test_random *random, int storeys)
{
    const uint32_t holes = test_random_below(random, 3);
    tl_nav_compact compact = fixture_random(random, 30 + test_random_below(random, 60),
                                            20 + test_random_below(random, 20), storeys, holes, 0);
    const uint32_t odd = test_random_below(random, 3) * 100;
    for (uint32_t i = 0; i < compact.span_count && odd > 0; i++) {
        if (test_random_below(random, odd) == 0) {
            compact.area[i] = test_random_below(random, 2) == 0 ? TL_NAV_NULL_AREA : 7;
        }
    }
    return compact;
}

static void check_run(const tl_nav_compact *compact, const tl_plain_run *run)
{
    for (uint32_t i = run->first; i < run->first + run->count; i++) {
        const uint32_t left = i - run->stride, right = i + run->stride;
        const uint32_t before = i + (uint32_t)run->before, after = i + (uint32_t)run->after;
        const uint32_t beside[4] = { left, after, right, before };
        for (uint32_t d = 0; d < 4; d++) {
            TEST_CHECK(tl_nav_compact_neighbour(compact, i, d) == beside[d]);
        }
        TEST_CHECK(tl_nav_compact_neighbour(compact, left, 3) == before - run->stride);
        TEST_CHECK(tl_nav_compact_neighbour(compact, before, 0) == before - run->stride);
        TEST_CHECK(tl_nav_compact_neighbour(compact, right, 3) == before + run->stride);
        TEST_CHECK(tl_nav_compact_neighbour(compact, before, 2) == before + run->stride);
        TEST_CHECK(tl_nav_compact_neighbour(compact, left, 1) == after - run->stride);
        TEST_CHECK(tl_nav_compact_neighbour(compact, after, 0) == after - run->stride);
        TEST_CHECK(tl_nav_compact_neighbour(compact, right, 1) == after + run->stride);
        TEST_CHECK(tl_nav_compact_neighbour(compact, after, 2) == after + run->stride);
    }
}

static void runs_are_plain(void **state)
{
    (void)state;
    test_random random = { 3 };
    uint32_t in_runs = 0, interleaved = 0, all = 0;
    for (uint32_t round = 0; round < 60; round++) {
        tl_nav_compact compact = random_ground(&random, 1 + (int)(round % 3));
        tl_plain_runs runs;
        TEST_RESULT(tl_plain_runs_find(&compact, 0, compact.span_count, NULL, &runs), TL_OK);
        TEST_CHECK(runs.count == 0); // without steps
        uint32_t *neighbour = compact.neighbour;
        compact.step = steps_of(&compact);
        compact.neighbour = NULL;
        TEST_RESULT(tl_plain_runs_find(&compact, 0, compact.span_count, NULL, &runs), TL_OK);
        uint32_t end = 0;
        for (uint32_t k = 0; k < runs.count; k++) {
            TEST_CHECK(runs.runs[k].first >= end && runs.runs[k].count > 0);
            check_run(&compact, &runs.runs[k]);
            end = runs.runs[k].first + runs.runs[k].count;
            in_runs += runs.runs[k].count;
            interleaved += runs.runs[k].stride > 1 ? runs.runs[k].count : 0;
        }
        TEST_CHECK(end <= compact.span_count);
        all += compact.span_count;
        tl_plain_runs_free(&runs);
        compact.neighbour = neighbour;
        tl_release_array(NULL, compact.step, 4 * (uint64_t)compact.span_count, sizeof(int16_t));
        compact.step = NULL;
        fixture_compact_free(&compact);
    }
    TEST_CHECK(in_runs > all / 10 && interleaved > 1000);
}

static void sweeps_are_those_without_runs(void **state)
{
    (void)state;
    test_random random = { 8 };
    uint32_t eroded = 0, kept = 0, far = 0;
    for (uint32_t round = 0; round < 120; round++) {
        tl_nav_compact plain = random_ground(&random, 1 + (int)(round % 3));
        tl_nav_compact linked = plain;
        const uint32_t count = plain.span_count;
        uint8_t *area = (uint8_t *)tl_allocate_array(NULL, count, 1);
        memcpy(area, plain.area, count);
        linked.area = area;
        plain.step = steps_of(&plain);
        plain.neighbour = NULL;
        tl_nav_config config;
        memset(&config, 0, sizeof config);
        config.walkable_radius = round % 5;
        TEST_RESULT(tl_nav_erode(&config, NULL, &plain, NULL), TL_OK);
        TEST_RESULT(tl_nav_erode(&config, NULL, &linked, NULL), TL_OK);
        TEST_CHECK(memcmp(plain.area, linked.area, count) == 0);
        TEST_RESULT(tl_nav_distance_field(NULL, &plain, NULL), TL_OK);
        TEST_RESULT(tl_nav_distance_field(NULL, &linked, NULL), TL_OK);
        TEST_CHECK(plain.max_distance == linked.max_distance);
        TEST_CHECK(memcmp(plain.distance, linked.distance, count * sizeof *plain.distance) == 0);
        for (uint32_t i = 0; i < count; i++) {
            eroded += plain.area[i] == TL_NAV_NULL_AREA;
            kept += plain.area[i] != TL_NAV_NULL_AREA;
            far += plain.distance[i] > 8;
        }
        tl_release_array(NULL, linked.distance, count, sizeof *linked.distance);
        tl_release_array(NULL, area, count, 1);
        tl_release_array(NULL, plain.step, 4 * (uint64_t)count, sizeof(int16_t));
        plain.step = NULL;
        plain.neighbour = linked.neighbour;
        fixture_compact_free(&plain);
    }
    TEST_CHECK(eroded > 1000 && kept > 1000 && far > 1000);
}

// Tall enough for bands: the same as on one thread, with and without runs, where distances reach over several seams.
static void bands_are_those_of_one_sweep(void **state)
{
    (void)state;
    test_random random = { 21 };
    tl_tasks tasks;
    tasks = test_backward_tasks(&tasks, 7);
    const tl_host many = { NULL, &tasks, NULL };
    uint32_t over_seams = 0, most_bands = 0;
    for (uint32_t round = 0; round < 40; round++) {
        const int storeys = 1 + (int)(round % 3);
        tl_nav_compact one = fixture_random(&random, 100 + test_random_below(&random, 60),
                                            40 + test_random_below(&random, 90), storeys, round % 4, 0);
        const uint32_t count = one.span_count;
        if (round % 2 == 0) {
            one.step = steps_of(&one);
        }
        uint32_t *neighbour = one.neighbour;
        one.neighbour = one.step != NULL ? NULL : neighbour;
        tl_nav_compact shared = one;
        shared.area = (uint8_t *)tl_allocate_array(NULL, count, 1);
        memcpy(shared.area, one.area, count);
        tl_floor_bands bands;
        TEST_RESULT(tl_floor_bands_make(&one, &many, &bands), TL_OK);
        most_bands = bands.count > most_bands ? bands.count : most_bands;
        tl_nav_config config;
        memset(&config, 0, sizeof config);
        config.walkable_radius = round % 5;
        TEST_RESULT(tl_nav_erode(&config, NULL, &one, NULL), TL_OK);
        TEST_RESULT(tl_nav_erode(&config, &many, &shared, NULL), TL_OK);
        TEST_CHECK(memcmp(one.area, shared.area, count) == 0);
        TEST_RESULT(tl_nav_distance_field(NULL, &one, NULL), TL_OK);
        TEST_RESULT(tl_nav_distance_field(&many, &shared, NULL), TL_OK);
        TEST_CHECK(one.max_distance == shared.max_distance);
        TEST_CHECK(memcmp(one.distance, shared.distance, count * sizeof *one.distance) == 0);
        for (uint32_t k = 1; k < bands.count; k++) {
            over_seams += one.distance[bands.bands[k].begin + 50] > 2; // of a row that follows a seam
        }
        tl_floor_bands_free(&bands);
        tl_release_array(NULL, shared.distance, count, sizeof *shared.distance);
        tl_release_array(NULL, shared.area, count, 1);
        tl_release_array(NULL, one.step, 4 * (uint64_t)count, sizeof(int16_t));
        one.step = NULL;
        one.neighbour = neighbour;
        fixture_compact_free(&one);
    }
    TEST_CHECK(over_seams > 10 && most_bands >= 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(runs_are_plain),
                                        cmocka_unit_test(sweeps_are_those_without_runs),
                                        cmocka_unit_test(bands_are_those_of_one_sweep) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
