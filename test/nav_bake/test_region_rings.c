// SPDX-License-Identifier: MIT
//
// Rings name the neighbours round a region, and columns those that lie over one another: both against a full scan.

#include "nav_region_checks.h"

#include "nav_bake/regions/region_columns.h"
#include "nav_bake/regions/region_rings.h"

static void example(void **state)
{
    (void)state;
    static const char *const rows[] = { "aab", "aab", "ccc" };
    tl_nav_compact compact = fixture_from_rows(rows, 3, 0);
    uint32_t region[9] = { 1, 1, 2, 1, 1, 2, 3, 3, 3 };
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_region_work work = { .compact = &compact, .arena = &arena, .region = region, .region_count = 4 };
    tl_region_rings rings;
    TEST_RESULT(tl_region_rings_make(&work, &rings), TL_OK);
    // From the first floor's x- edge, clockwise: wall, then 3 below, 2 to the right; the wall above is the first again.
    uint32_t e = rings.head[1];
    TEST_CHECK(rings.entries[e].region == 0);
    e = rings.entries[e].next;
    TEST_CHECK(rings.entries[e].region == 3);
    e = rings.entries[e].next;
    TEST_CHECK(rings.entries[e].region == 2 && rings.entries[e].next == rings.head[1]);
    TEST_CHECK(rings.span_count[1] == 4 && rings.span_count[2] == 2 && rings.span_count[3] == 3);
    TEST_CHECK(rings.area[1] == 1 && rings.area[2] == 2 && rings.area[3] == 3 && rings.head[0] == TL_NO_REGION_RING);
    tl_arena_free(&arena);
    fixture_compact_free(&compact);
}

// Who touches whom, from every link; in a ring of a region without a hole the same must stand.
static void against_scan(void **state)
{
    (void)state;
    test_random random = { 23 };
    uint32_t pairs = 0, several = 0;
    for (int round = 0; round < 40; round++) {
        tl_nav_compact compact = fixture_random(&random, 30, 30, 1 + round % 4, test_random_below(&random, 15), 0);
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        uint32_t *region = calloc(compact.span_count + 1, sizeof *region);
        tl_region_work work = { .compact = &compact, .arena = &arena, .region = region, .region_count = 1 };
        TEST_RESULT(tl_regions_monotone(&work), TL_OK); // no region has a hole
        uint32_t count = work.region_count;
        uint8_t *touches = calloc((size_t)count * count, 1), *named = calloc((size_t)count * count, 1);
        for (uint32_t i = 0; i < compact.span_count; i++) {
            for (uint32_t d = 0; region[i] != 0 && d < 4; d++) {
                uint32_t beside = tl_nav_compact_neighbour(&compact, i, d);
                touches[(size_t)region[i] * count + (beside != TL_NAV_NO_SPAN ? region[beside] : 0)] = 1;
            }
        }
        tl_region_rings rings;
        TEST_RESULT(tl_region_rings_make(&work, &rings), TL_OK);
        for (uint32_t r = 1; r < count; r++) {
            uint32_t e = rings.head[r];
            do {
                uint32_t next = rings.entries[e].next;
                TEST_CHECK(next == e || rings.entries[next].region != rings.entries[e].region);
                named[(size_t)r * count + rings.entries[e].region] = 1;
                e = next;
            } while (e != rings.head[r]);
            touches[(size_t)r * count + r] = 0;
            for (uint32_t other = 0; other < count; other++) {
                TEST_CHECK(named[(size_t)r * count + other] == touches[(size_t)r * count + other]);
                pairs += named[(size_t)r * count + other];
            }
        }
        tl_region_columns columns;
        TEST_RESULT(tl_region_columns_make(&work, &columns), TL_OK);
        uint32_t listed = 0;
        uint8_t *found = calloc((size_t)count * count, 1), *expected = calloc((size_t)count * count, 1);
        for (uint32_t r = 1; r < count; r++) {
            for (uint32_t k = columns.first[r]; k < columns.first[r + 1]; k++, listed++) {
                uint32_t c = columns.column[k];
                bool holds = false;
                for (uint32_t i = compact.first_span[c]; i < compact.first_span[c + 1]; i++) {
                    holds |= region[i] == r;
                    found[(size_t)r * count + region[i]] = 1;
                }
                TEST_CHECK(holds && compact.first_span[c + 1] - compact.first_span[c] > 1);
            }
        }
        for (uint32_t c = 0; c < 900; c++) {
            uint32_t begin = compact.first_span[c], end = compact.first_span[c + 1];
            for (uint32_t i = begin; end - begin > 1 && i < end; i++) {
                for (uint32_t k = begin; k < end && region[i] != 0; k++) {
                    expected[(size_t)region[i] * count + region[k]] = 1;
                }
            }
        }
        TEST_CHECK(memcmp(found, expected, (size_t)count * count) == 0);
        free(found);
        free(expected);
        several += listed;
        free(touches);
        free(named);
        free(region);
        tl_arena_free(&arena);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(pairs > 5000 && several > 5000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(example),
        cmocka_unit_test(against_scan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
