// SPDX-License-Identifier: MIT
//
// Filter and merge: examples of each rule, and the fixed point on random partitions.

#include "nav_region_checks.h"

#include "nav_bake/regions/region_rings.h"
#include "nav_bake/regions/regions.h"

// Makes regions from letters: same letter, same region. Only for maps of one storey.
static void regions_from_rows(const char *const *rows, const tl_nav_compact *compact, uint32_t *region)
{
    for (uint32_t c = 0; c < compact->width * compact->height; c++) {
        char letter = rows[c / compact->width][c % compact->width];
        for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
            region[i] = letter == '|' ? TL_NAV_BORDER_REGION | 1 : (uint32_t)(letter - 'A' + 1);
        }
    }
}

typedef struct merge_case {
    tl_nav_compact compact;
    uint32_t region[1024];
    tl_region_work work;
    tl_arena arena;
} merge_case;

// `rows` has a capital letter for each floor; all floors have one area.
static void run_case(merge_case *m, const char *const *rows, uint32_t row_count, uint32_t min_area, uint32_t merge_area)
{
    char plain[32][64];
    const char *plain_rows[32] = { "" };
    uint32_t largest = 0;
    for (uint32_t z = 0; z < row_count; z++) {
        for (uint32_t x = 0; x <= strlen(rows[z]); x++) {
            char letter = rows[z][x];
            plain[z][x] = (char)(letter == '|' || (letter >= 'A' && letter <= 'Z') ? '0' : letter);
            largest = letter >= 'A' && letter <= 'Z' && (uint32_t)(letter - 'A' + 1) > largest
                          ? (uint32_t)(letter - 'A' + 1)
                          : largest;
        }
        plain_rows[z] = plain[z];
    }
    m->compact = fixture_from_rows(plain_rows, row_count, 0);
    regions_from_rows(rows, &m->compact, m->region);
    tl_arena_init(&m->arena, NULL);
    tl_region_work work = {
        .compact = &m->compact, .arena = &m->arena, .region = m->region, .region_count = largest + 1
    };
    m->work = work;
    TEST_RESULT(tl_regions_filter_and_merge(&m->work, min_area, merge_area), TL_OK);
}

static void end_case(merge_case *m)
{
    tl_arena_free(&m->arena);
    fixture_compact_free(&m->compact);
}

static void small_joins_smallest(void **state)
{
    (void)state;
    static const char *const rows[] = { "AAAAABBCCC", "AAAAABBCCC", "AAAAABBCCC" };
    merge_case m;
    run_case(&m, rows, 3, 0, 6);
    TEST_CHECK(m.work.region_count == 3 && m.work.stats.merged == 1);
    TEST_CHECK(m.region[5] == m.region[7] && m.region[0] != m.region[5]); // B joined C, the smaller neighbour
    end_case(&m);
}

static void two_shared_stretches_do_not_merge(void **state)
{
    (void)state;
    // B touches A twice, with a hole between: the union would have the hole inside its outline.
    static const char *const rows[] = { "AAAAAAAA", "AABBBBAA", "AA    AA" };
    static const char *const rings[] = { "AAAAA", "A   A", "ABBBA" };
    merge_case m;
    run_case(&m, rows, 3, 0, 4);
    TEST_CHECK(m.work.region_count == 2); // one stretch: three sides of B
    end_case(&m);
    run_case(&m, rings, 3, 0, 4);
    TEST_CHECK(m.work.region_count == 3 && m.work.stats.merged == 0);
    end_case(&m);
}

static void region_inside_another_is_merged(void **state)
{
    (void)state;
    static const char *const rows[] = { "AAAAAA", "AAAAAA", "AABBAA", "AABBAA", "AAAAAA", "AAAAAA" };
    merge_case m;
    run_case(&m, rows, 6, 10, 0); // B is smaller than min_area, but no island; it touches no wall
    TEST_CHECK(m.work.region_count == 2 && m.work.stats.filtered_regions == 0);
    for (uint32_t i = 0; i < 36; i++) {
        TEST_CHECK(m.region[i] == 1);
    }
    end_case(&m);
}

static void islands_go_unless_at_the_border(void **state)
{
    (void)state;
    static const char *const rows[] = { "AA  BBC  |DD", "AA  BBC  |DD", "         |  " };
    merge_case m;
    run_case(&m, rows, 3, 5, 0);
    TEST_CHECK(m.work.stats.filtered_regions == 1 && m.work.stats.filtered_spans == 4);
    TEST_CHECK(m.region[0] == 0);                           // A: 4 floors
    TEST_CHECK(m.region[2] != 0 && m.region[4] != 0);       // B and C: 6 together
    TEST_CHECK(m.region[6] != 0 && m.region[7] != 0);       // D: 4, but the border is beside it
    TEST_CHECK(m.region[5] == (TL_NAV_BORDER_REGION | 1u)); // and the border stays as it was
    end_case(&m);
}

static void merged_chain(void **state)
{
    (void)state;
    static const char *const rows[] = { "ABCDEFGHIJ", "ABCDEFGHIJ" };
    merge_case m;
    run_case(&m, rows, 2, 0, 100);
    TEST_CHECK(m.work.region_count == 2 && m.work.stats.merged == 9);
    end_case(&m);
    run_case(&m, rows, 2, 0, TL_REGIONS_NO_MERGE);
    TEST_CHECK(m.work.region_count == 11 && m.work.stats.merged == 0);
    end_case(&m);
}

static void links_that_are_not_mutual_are_refused(void **state)
{
    (void)state;
    static const char *const rows[] = { "000", "000", "000" };
    tl_nav_compact compact = fixture_from_rows(rows, 3, 0);
    compact.neighbour[4 * 4 + 2] = 4; // the middle is its own neighbour
    compact.neighbour[4 * 4 + 1] = 4;
    compact.neighbour[4 * 1 + 1] = TL_NAV_NO_SPAN;
    compact.neighbour[4 * 0 + 0] = 8; // and the first floor has one before it
    tl_nav_config config = region_config(TL_NAV_MONOTONE, 0, 0);
    tl_report report;
    TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, &report), TL_ERR_CORRUPT);
    TEST_CHECK(report.advice != NULL && compact.region == NULL);
    fixture_compact_free(&compact);
}

static bool share_column(const tl_nav_compact *compact, uint32_t a, uint32_t b)
{
    for (uint32_t c = 0; c < compact->width * compact->height; c++) {
        uint32_t found = 0;
        for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
            found |= (compact->region[i] == a ? 1u : 0) | (compact->region[i] == b ? 2u : 0);
        }
        if (found == 3) {
            return true;
        }
    }
    return false;
}

static uint32_t ring_count(const tl_region_rings *rings, uint32_t region, uint32_t wanted)
{
    uint32_t e = rings->head[region], count = 0;
    do {
        count += rings->entries[e].region == wanted;
        e = rings->entries[e].next;
    } while (e != rings->head[region]);
    return count;
}

// After the merge no two regions are left that the rules would merge.
static void fixed_point(void **state)
{
    (void)state;
    test_random random = { 99 };
    uint32_t small_left = 0, blocked_by_overlap = 0, blocked_by_ring = 0;
    for (int round = 0; round < 90; round++) {
        uint32_t merge_area = 20 + test_random_below(&random, 150);
        tl_nav_compact compact =
            round % 3 == 0 ? fixture_spiral(8 + test_random_below(&random, 20), 2, 4)
                           : fixture_random(&random, 40, 40, 1 + round % 4, test_random_below(&random, 30), 0);
        tl_nav_config config = region_config(round % 2 == 0 ? TL_NAV_WATERSHED : TL_NAV_MONOTONE, 5, merge_area);
        TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
        TEST_RESULT(tl_nav_bake_regions(&config, NULL, &compact, NULL), TL_OK);
        check_regions(&compact, compact.region, compact.region_count);
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        tl_region_work work = {
            .compact = &compact, .arena = &arena, .region = compact.region, .region_count = compact.region_count
        };
        tl_region_rings rings;
        TEST_RESULT(tl_region_rings_make(&work, &rings), TL_OK);
        for (uint32_t r = 1; r < compact.region_count; r++) {
            if (rings.span_count[r] > merge_area && ring_count(&rings, r, 0) > 0) {
                continue;
            }
            small_left++;
            uint32_t e = rings.head[r];
            do {
                uint32_t other = rings.entries[e].region;
                if (other != 0 && rings.area[other] == rings.area[r]) {
                    bool ring_allows = ring_count(&rings, r, other) == 1 && ring_count(&rings, other, r) <= 1;
                    bool overlap = share_column(&compact, r, other);
                    TEST_CHECK(!ring_allows || overlap);
                    blocked_by_overlap += overlap;
                    blocked_by_ring += !ring_allows;
                }
                e = rings.entries[e].next;
            } while (e != rings.head[r]);
        }
        tl_arena_free(&arena);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(small_left > 100 && blocked_by_overlap > 5 && blocked_by_ring > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_joins_smallest),
        cmocka_unit_test(two_shared_stretches_do_not_merge),
        cmocka_unit_test(region_inside_another_is_merged),
        cmocka_unit_test(islands_go_unless_at_the_border),
        cmocka_unit_test(merged_chain),
        cmocka_unit_test(links_that_are_not_mutual_are_refused),
        cmocka_unit_test(fixed_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
