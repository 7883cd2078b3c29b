// SPDX-License-Identifier: MIT
//
// Watershed against a naive twin that looks at every floor in every step, and its invariants on random storeys.

#include "nav_fields.h"
#include "nav_region_checks.h"

#include "nav_bake/regions/regions.h"

// ---------------------------------------------------------------------------------------------------------
// The twin: the same rules, without buckets, frontiers or early ends.

typedef struct twin {
    const tl_nav_compact *compact;
    uint32_t *region, *reach, *next_region, *next_reach;
    uint32_t *order; // by level, then index
    uint32_t order_count, region_count;
} twin;

static bool twin_same_area(const twin *t, uint32_t a, uint32_t b)
{
    return b != TL_NAV_NO_SPAN && t->compact->area[a] == t->compact->area[b];
}

static bool twin_is_region(uint32_t region)
{
    return region != 0 && (region & TL_NAV_BORDER_REGION) == 0;
}

static bool twin_step(twin *t, uint32_t level)
{
    uint32_t count = t->compact->span_count;
    bool changed = false;
    memcpy(t->next_region, t->region, count * sizeof *t->region);
    memcpy(t->next_reach, t->reach, count * sizeof *t->reach);
    for (uint32_t i = 0; i < count; i++) {
        if (t->region[i] != 0 || t->compact->area[i] == TL_NAV_NULL_AREA || t->compact->distance[i] < level) {
            continue;
        }
        uint32_t best = UINT32_MAX;
        for (uint32_t d = 0; d < 4; d++) {
            uint32_t beside = tl_nav_compact_neighbour(t->compact, i, d);
            if (twin_same_area(t, i, beside) && twin_is_region(t->region[beside]) && t->reach[beside] < best) {
                best = t->reach[beside];
                t->next_region[i] = t->region[beside];
                t->next_reach[i] = best + 1;
                changed = true;
            }
        }
    }
    memcpy(t->region, t->next_region, count * sizeof *t->region);
    memcpy(t->reach, t->next_reach, count * sizeof *t->reach);
    return changed;
}

static bool twin_meets_other(const twin *t, uint32_t i, uint32_t own)
{
    for (uint32_t d = 0; d < 4; d++) {
        uint32_t beside = tl_nav_compact_neighbour(t->compact, i, d);
        if (!twin_same_area(t, i, beside) || (t->region[beside] & TL_NAV_BORDER_REGION) != 0) {
            continue;
        }
        uint32_t diagonal = tl_nav_compact_neighbour(t->compact, beside, ((d + 1) & 3));
        uint32_t straight = t->region[beside], corner = twin_same_area(t, i, diagonal) ? t->region[diagonal] : 0;
        if ((twin_is_region(straight) && straight != own) || (twin_is_region(corner) && corner != own)) {
            return true;
        }
    }
    return false;
}

static uint32_t twin_flood(twin *t, uint32_t seed, uint32_t level)
{
    uint32_t own = t->region_count, taken = 0, count = 0;
    uint32_t *stack = malloc((t->compact->span_count + 1) * sizeof *stack);
    stack[count++] = seed;
    t->region[seed] = own;
    t->reach[seed] = 0;
    while (count > 0) {
        uint32_t i = stack[--count];
        if (twin_meets_other(t, i, own)) {
            t->region[i] = 0;
            continue;
        }
        taken++;
        for (uint32_t d = 0; d < 4; d++) {
            uint32_t beside = tl_nav_compact_neighbour(t->compact, i, d);
            if (twin_same_area(t, i, beside) && t->region[beside] == 0 && t->compact->distance[beside] >= level) {
                t->region[beside] = own;
                t->reach[beside] = 0;
                stack[count++] = beside;
            }
        }
    }
    free(stack);
    return taken;
}

static void twin_order(twin *t)
{
    uint32_t top = (t->compact->max_distance + 1u) / 2;
    for (uint32_t level = top; level-- > 0 || (top == 0 && level == UINT32_MAX);) {
        for (uint32_t i = 0; i < t->compact->span_count; i++) {
            uint32_t own = t->compact->distance[i] / 2u;
            own = own >= top && top > 0 ? top - 1 : own;
            if (t->compact->area[i] != TL_NAV_NULL_AREA && t->region[i] == 0 && own == (top == 0 ? 0 : level)) {
                t->order[t->order_count++] = i;
            }
        }
        if (top == 0) {
            break;
        }
    }
}

static void twin_watershed(twin *t)
{
    twin_order(t);
    uint32_t top = (t->compact->max_distance + 1u) / 2;
    top = top > 0 ? top : 1;
    t->region_count = 1;
    for (uint32_t k = top; k-- > 0;) {
        uint32_t level = 2 * k;
        for (int step = 0; (step < 8 || level == 0) && twin_step(t, level); step++) {
        }
        for (uint32_t j = 0; j < t->order_count; j++) {
            uint32_t i = t->order[j];
            bool above = t->compact->distance[i] >= level;
            if (above && t->region[i] == 0 && twin_flood(t, i, level >= 2 ? level - 2 : 0) > 0) {
                t->region_count++;
            }
        }
    }
    while (twin_step(t, 0)) {
    }
}

// ---------------------------------------------------------------------------------------------------------

// The border as the driver paints it.
static void paint(const tl_nav_compact *compact, uint32_t *region)
{
    for (uint32_t c = 0; c < compact->width * compact->height; c++) {
        uint32_t x = c % compact->width, z = c / compact->width, border = compact->border_size;
        bool inside = x >= border && z >= border && x + border < compact->width && z + border < compact->height;
        for (uint32_t i = compact->first_span[c]; !inside && i < compact->first_span[c + 1]; i++) {
            region[i] = compact->area[i] != TL_NAV_NULL_AREA ? TL_NAV_BORDER_REGION | 1 : 0;
        }
    }
}

static void against_twin(void **state)
{
    (void)state;
    test_random random = { 21 };
    uint32_t several = 0, bordered = 0, storeys_seen = 0, flat = 0;
    for (int round = 0; round < 120; round++) {
        int storeys = 1 + round % 3;
        uint32_t width = 2 + test_random_below(&random, 60), height = 2 + test_random_below(&random, 60);
        uint32_t border = round % 4 == 3 ? 3 : 0;
        width += 2 * border;
        height += 2 * border;
        tl_nav_compact compact = fixture_random(&random, width, height, storeys,
                                                test_random_below(&random, 8) * (uint32_t)(round % 2), border);
        TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
        uint32_t count = compact.span_count;
        twin t = { &compact,
                   calloc(count + 1, 4),
                   calloc(count + 1, 4),
                   calloc(count + 1, 4),
                   calloc(count + 1, 4),
                   calloc(count + 1, 4),
                   0,
                   0 };
        uint32_t *region = calloc(count + 1, sizeof *region);
        paint(&compact, region);
        paint(&compact, t.region);
        twin_watershed(&t);
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        tl_region_work work = { .compact = &compact, .arena = &arena, .region = region, .region_count = 1 };
        TEST_RESULT(tl_regions_watershed(&work), TL_OK);
        TEST_CHECK(work.region_count == t.region_count);
        assert_memory_equal(region, t.region, count * sizeof *region);
        several += work.region_count > 5;
        bordered += border > 0 && work.region_count > 2;
        storeys_seen += storeys > 1 && work.region_count > 4;
        flat += compact.max_distance <= 2;
        tl_arena_free(&arena);
        free(region);
        free(t.region);
        free(t.reach);
        free(t.next_region);
        free(t.next_reach);
        free(t.order);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(several > 30 && bordered > 10 && storeys_seen > 30 && flat > 0);
}

static void invariants(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t dropped = 0, merged = 0;
    for (int round = 0; round < 60; round++) {
        uint32_t border = round % 3 == 2 ? 4 : 0;
        uint32_t width = 30 + test_random_below(&random, 60);
        tl_nav_compact compact =
            fixture_random(&random, width, 50, 1 + round % 4, test_random_below(&random, 25), border);
        tl_nav_config config = region_config(TL_NAV_WATERSHED, 30, 80);
        TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
        TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
        check_regions(&compact, compact.region, compact.region_count);
        uint32_t lost = check_islands(&compact, 30);
        TEST_CHECK(lost == compact.region_stats.filtered_spans);
        dropped += lost > 0;
        merged += compact.region_stats.merged > 0;
        fixture_compact_free(&compact);
    }
    TEST_CHECK(dropped > 10 && merged > 20);
}

// A ramp that winds over itself: without the split, regions would hold two floors of a column.
static void spirals_are_split(void **state)
{
    (void)state;
    uint32_t split = 0;
    for (uint32_t size = 10; size < 40; size += 3) {
        for (uint32_t inner = 1; inner < 5; inner++) {
            tl_nav_compact compact = fixture_spiral(size, inner, 4);
            tl_nav_config config = region_config(TL_NAV_WATERSHED, 0, 400);
            TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
            TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
            check_regions(&compact, compact.region, compact.region_count);
            TEST_CHECK(check_islands(&compact, 0) == 0);
            split += compact.region_stats.split;
            fixture_compact_free(&compact);
        }
    }
    TEST_CHECK(split > 3);
}

static void example_two_rooms(void **state)
{
    (void)state;
    static const char *const rows[] = {
        "0000000000          0000000000", "0000000000          0000000000", "0000000000          0000000000",
        "0000000000          0000000000", "000000000000000000000000000000", "000000000000000000000000000000",
        "0000000000          0000000000", "0000000000          0000000000", "0000000000          0000000000",
        "0000000000          0000000000",
    };
    tl_nav_compact compact = fixture_from_rows(rows, 10, 0);
    tl_nav_config config = region_config(TL_NAV_WATERSHED, 8, 10);
    TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
    uint32_t left = compact.region[0], right = compact.region[compact.span_count - 1];
    TEST_CHECK(left != 0 && right != 0 && left != right);
    fixture_compact_free(&compact);
}

// A corridor of two columns has no inner floor. It is walkable all the same.
static void narrow_corridor_is_kept(void **state)
{
    (void)state;
    static const char *const rows[] = { "000000000000", "000000000000" };
    tl_nav_compact compact = fixture_from_rows(rows, 2, 0);
    tl_nav_config config = region_config(TL_NAV_WATERSHED, 8, 20);
    TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
    TEST_CHECK(compact.region_count == 2 && compact.region[0] == 1 && compact.region[23] == 1);
    fixture_compact_free(&compact);
}

// Large enough for blocks of the field and of the floors that wait.
static void tasks_give_the_same_regions(void **state)
{
    (void)state;
    test_random random = { 31 };
    tl_tasks tasks;
    tasks = test_backward_tasks(&tasks, 3);
    const tl_host many = { NULL, &tasks, NULL };
    for (uint32_t round = 0; round < 4; round++) {
        tl_nav_compact compact = fixture_random(&random, 260, 240, 1 + (int)round, 0, round % 2 * 4);
        const size_t bytes = compact.span_count * sizeof *compact.region;
        tl_nav_config config = region_config(TL_NAV_WATERSHED, 30, 80);
        TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
        TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
        uint32_t *alone = (uint32_t *)malloc(bytes);
        memcpy(alone, compact.region, bytes);
        const uint32_t count = compact.region_count;
        TEST_RESULT(tl_nav_bake_regions(&config, &many, &compact, NULL), TL_OK);
        TEST_CHECK(count > 10 && compact.region_count == count && memcmp(alone, compact.region, bytes) == 0);
        free(alone);
        fixture_compact_free(&compact);
    }
}

static void needs_distance(void **state)
{
    (void)state;
    static const char *const rows[] = { "00", "00" };
    tl_nav_compact compact = fixture_from_rows(rows, 2, 0);
    tl_nav_config config = region_config(TL_NAV_WATERSHED, 8, 20);
    tl_report report;
    TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(report.advice != NULL && compact.region == NULL);
    fixture_compact_free(&compact);
}

static void fails_at_each_allocation(void **state)
{
    (void)state;
    test_random random = { 8 };
    tl_nav_compact compact = fixture_random(&random, 40, 40, 3, 10, 2);
    TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
    for (int partition = 0; partition < 3; partition++) {
        tl_nav_config config = region_config((tl_nav_partition)partition, 10, 40);
        test_allocator test;
        uint64_t k = 1;
        for (;; k++) {
            test_allocator_init(&test, k);
            tl_host host = { &test.allocator, NULL, NULL };
            tl_result result = tl_nav_bake_regions(&config, &host, &compact, NULL);
            TEST_CHECK(test.live_blocks == 0);
            if (result == TL_OK) {
                break;
            }
            TEST_RESULT(result, TL_ERR_MEMORY);
            TEST_CHECK(compact.region == NULL);
        }
        TEST_CHECK(k > 1);
        tl_release_array(NULL, compact.region, compact.span_count, sizeof(uint32_t));
        compact.region = NULL;
    }
    fixture_compact_free(&compact);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_twin),
        cmocka_unit_test(invariants),
        cmocka_unit_test(spirals_are_split),
        cmocka_unit_test(example_two_rooms),
        cmocka_unit_test(narrow_corridor_is_kept),
        cmocka_unit_test(tasks_give_the_same_regions),
        cmocka_unit_test(needs_distance),
        cmocka_unit_test(fails_at_each_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
