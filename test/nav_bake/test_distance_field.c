// SPDX-License-Identifier: MIT
//
// Distance field against a twin by relaxation: the chamfer distance is the fixed point of its steps; and its update
// after marks against a whole field.

#include "nav_compact_fixture.h"

#include "nav_bake/regions/distance_update.h"

static bool twin_is_border(const tl_nav_compact *compact, uint32_t i)
{
    for (uint32_t d = 0; d < 4; d++) {
        uint32_t beside = tl_nav_compact_neighbour(compact, i, d);
        if (beside == TL_NAV_NO_SPAN || compact->area[beside] != compact->area[i]) {
            return true;
        }
    }
    return compact->area[i] == TL_NAV_NULL_AREA;
}

// The four diagonals as the sweeps take them: straight in d, then round the corner.
static const uint32_t corner_of[4] = { 3, 0, 1, 2 };

static void twin_distance(const tl_nav_compact *compact, uint32_t *distance)
{
    for (uint32_t i = 0; i < compact->span_count; i++) {
        distance[i] = twin_is_border(compact, i) ? 0 : 1u << 20;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t i = 0; i < compact->span_count; i++) {
            for (uint32_t d = 0; distance[i] != 0 && d < 4; d++) {
                uint32_t beside = tl_nav_compact_neighbour(compact, i, d);
                uint32_t diagonal = tl_nav_compact_neighbour(compact, beside, corner_of[d]);
                uint32_t best = distance[beside] + 2;
                if (diagonal != TL_NAV_NO_SPAN && distance[diagonal] + 3 < best) {
                    best = distance[diagonal] + 3;
                }
                if (best < distance[i]) {
                    distance[i] = best;
                    changed = true;
                }
            }
        }
    }
}

static uint32_t twin_blur(const tl_nav_compact *compact, const uint32_t *distance, uint32_t i)
{
    uint32_t own = distance[i];
    if (own <= 2) {
        return own;
    }
    uint32_t sum = own;
    for (uint32_t d = 0; d < 4; d++) {
        uint32_t beside = tl_nav_compact_neighbour(compact, i, d);
        uint32_t diagonal = tl_nav_compact_neighbour(compact, beside, ((d + 1) & 3));
        sum += distance[beside] + (diagonal == TL_NAV_NO_SPAN ? own : distance[diagonal]);
    }
    return (sum + 5) / 9;
}

static void example_corridor(void **state)
{
    (void)state;
    static const char *const rows[] = {
        "000000000", "000000000", "000000000", "000000000", "000000000", "000000000", "000000000",
    };
    tl_nav_compact compact = fixture_from_rows(rows, 7, 0);
    tl_report report;
    TEST_RESULT(tl_nav_distance_field(NULL, &compact, &report), TL_OK);
    static const uint16_t middle_row[9] = { 0, 2, 4, 5, 6, 5, 4, 2, 0 };
    for (uint32_t x = 0; x < 9; x++) {
        TEST_CHECK(compact.distance[3 * 9 + x] <= middle_row[x]);
        TEST_CHECK(compact.distance[x] == 0);
        TEST_CHECK(compact.distance[9 + x] == (x == 0 || x == 8 ? 0 : 2)); // walls stay sharp
    }
    TEST_CHECK(compact.max_distance == 6);
    TEST_CHECK(report.peak_bytes >= 4 * 63);
    fixture_compact_free(&compact);
}

static void twin_by_relaxation(void **state)
{
    (void)state;
    test_random random = { 11 };
    uint32_t inner = 0, multi = 0;
    for (int round = 0; round < 60; round++) {
        int storeys = 1 + round % 3;
        uint32_t width = 1 + test_random_below(&random, 40), height = 1 + test_random_below(&random, 40);
        tl_nav_compact compact = fixture_random(&random, width, height, storeys, (uint32_t)(round % 4), 0);
        TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
        uint32_t *twin = calloc(compact.span_count + 1, sizeof *twin);
        twin_distance(&compact, twin);
        for (uint32_t i = 0; i < compact.span_count; i++) {
            uint32_t expected = twin_blur(&compact, twin, i);
            TEST_CHECK(compact.distance[i] == expected);
            TEST_CHECK(compact.distance[i] <= compact.max_distance);
            inner += expected > 4;
        }
        multi += storeys > 1;
        free(twin);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(inner > 500 && multi > 20);
}

// Marks discs and lone floors, as obstacles do, with areas new or known; some of them not walkable.
static void mark_some(test_random *random, tl_nav_compact *compact)
{
    for (uint32_t marks = 1 + test_random_below(random, 4); marks > 0; marks--) {
        const uint32_t x = test_random_below(random, compact->width), z = test_random_below(random, compact->height);
        const uint32_t size = test_random_below(random, 5);
        static const uint8_t areas[3] = { TL_NAV_NULL_AREA, 7, TL_NAV_WALKABLE_AREA };
        const uint8_t area = areas[test_random_below(random, 3)];
        for (uint32_t row = z; row < compact->height && row <= z + size; row++) {
            for (uint32_t column = x; column < compact->width && column <= x + size; column++) {
                const uint32_t *first = compact->first_span + (size_t)row * compact->width + column;
                for (uint32_t i = first[0]; i < first[1]; i++) {
                    compact->area[i] = area;
                }
            }
        }
    }
}

// Distances from its sides do not fit in 8 bits.
static tl_nav_compact open_ground(uint32_t width, uint32_t height)
{
    fixture_map map = fixture_map_make(width, height);
    for (uint32_t i = 0; i < width * height; i++) {
        fixture_add_floor(&map, i % width, i / width, 0, TL_NAV_WALKABLE_AREA);
    }
    const tl_nav_compact compact = fixture_compact_make(&map, 0);
    fixture_map_free(&map);
    return compact;
}

// The field after marks, from that before them, is a whole field made anew: on maps and where a stair winds round.
static void update_is_a_whole_field(void **state)
{
    (void)state;
    test_random random = { 29 };
    uint32_t nearer = 0, farther = 0, spirals = 0, wide = 0;
    for (int round = 0; round < 120; round++) {
        const uint32_t width = 1 + test_random_below(&random, 60), height = 1 + test_random_below(&random, 60);
        const bool spiral = round % 4 == 3;
        tl_nav_compact compact = round == 0 ? open_ground(270, 260)
                                 : spiral
                                     ? fixture_spiral(12 + (uint32_t)round / 8, 2, 1 + round % 3)
                                     : fixture_random(&random, width, height, 1 + round % 3, (uint32_t)(round % 4), 0);
        spirals += spiral;
        uint8_t *before = calloc(compact.span_count + 1, 1);
        memcpy(before, compact.area, compact.span_count);
        tl_distance_stages stages;
        TEST_RESULT(tl_distance_stages_make(&compact, NULL, &stages), TL_OK);
        wide += stages.value_size == 2;
        TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
        uint16_t *whole = compact.distance;
        compact.distance = NULL;
        for (int edit = 0; edit < 6; edit++) {
            memcpy(compact.area, before, compact.span_count);
            mark_some(&random, &compact);
            TEST_RESULT(tl_distance_field_update(before, &stages, NULL, &compact), TL_OK);
            uint16_t *updated = compact.distance, most = compact.max_distance;
            compact.distance = NULL;
            TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
            TEST_CHECK(memcmp(updated, compact.distance, compact.span_count * sizeof *updated) == 0);
            TEST_CHECK(most == compact.max_distance);
            for (uint32_t i = 0; i < compact.span_count; i++) {
                nearer += updated[i] < whole[i];
                farther += updated[i] > whole[i];
            }
            tl_release_array(NULL, updated, compact.span_count, sizeof *updated);
            tl_release_array(NULL, compact.distance, compact.span_count, sizeof *updated);
            compact.distance = NULL;
        }
        tl_distance_stages_free(&stages, compact.span_count, NULL);
        tl_release_array(NULL, whole, compact.span_count, sizeof *whole);
        free(before);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(nearer > 5000 && farther > 500 && spirals == 30 && wide == 1);
}

static void fails_at_each_allocation(void **state)
{
    (void)state;
    test_random random = { 3 };
    tl_nav_compact compact = fixture_random(&random, 12, 12, 2, 1, 0);
    test_allocator test;
    uint64_t k = 1;
    for (;; k++) {
        test_allocator_init(&test, k);
        tl_host host = { &test.allocator, NULL, NULL };
        compact.allocator = test.allocator;
        tl_result result = tl_nav_distance_field(&host, &compact, NULL);
        if (result == TL_OK) {
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(test.live_blocks == 0 && compact.distance == NULL);
    }
    TEST_CHECK(k == 4 && test.live_blocks == 1);
    // Once more on top of the old field: it is replaced.
    tl_host host = { &test.allocator, NULL, NULL };
    test.fail_at = 0;
    TEST_RESULT(tl_nav_distance_field(&host, &compact, NULL), TL_OK);
    TEST_CHECK(test.live_blocks == 1);
    tl_release_array(&test.allocator, compact.distance, compact.span_count, sizeof(uint16_t));
    compact.distance = NULL;
    compact.allocator = tl_allocator_or_default(NULL);
    TEST_CHECK(test.live_blocks == 0 && test.live_bytes == 0);
    fixture_compact_free(&compact);
}

static void empty_field(void **state)
{
    (void)state;
    fixture_map map = fixture_map_make(3, 2);
    tl_nav_compact compact = fixture_compact_make(&map, 0);
    TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
    TEST_CHECK(compact.max_distance == 0 && compact.distance != NULL);
    fixture_compact_free(&compact);
    fixture_map_free(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(example_corridor),
        cmocka_unit_test(twin_by_relaxation),
        cmocka_unit_test(update_is_a_whole_field),
        cmocka_unit_test(fails_at_each_allocation),
        cmocka_unit_test(empty_field),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
