// SPDX-License-Identifier: MIT
//
// Random points: every square of the lattice is met exactly once in as many steps, whatever tiles came and went; points
// lie in their triangle evenly.

#include "nav_fixture.h"

#include <math.h>
#include <talus/nav_around.h>

// Sums of tiles' areas as squares of half a cell's area.
static uint64_t doubled_squares(const tl_navmesh *navmesh, const fixture_level *level)
{
    double area = 0.0;
    for (uint32_t s = 0; s < tl_navmesh_slot_count(navmesh); s++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, s);
        area += tile != NULL ? tile->area : 0.0;
    }
    double cell = (double)level->cell_size;
    return (uint64_t)llround(2.0 * area / (cell * cell));
}

static uint64_t doubled_squares_of(const tl_navmesh *navmesh, const fixture_level *level, tl_nav_ref ref)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    double cell = (double)level->cell_size;
    return (uint64_t)llround(2.0 * tl_nav_tile_polygon_area(tile, polygon) / (cell * cell));
}

// Random numbers that name the squares one by one.
static uint64_t bits_of_square(uint64_t square, uint64_t count)
{
    return square * (UINT64_MAX / count) + square + 1;
}

static void test_every_square(void **state)
{
    (void)state;
    test_random random = { 71 };
    uint32_t removed = 0, refused = 0;
    for (uint32_t round = 0; round < 24; round++) {
        fixture_level level = fixture_random(&random, round % 6, 7);
        level.tile_cells = round % 3 == 0 ? 0 : 2;
        level.area_count = 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        for (uint32_t i = 0; level.tile_cells != 0 && i < round % 5; i++) {
            int32_t x = (int32_t)test_random_below(&random, 4), z = (int32_t)test_random_below(&random, 4);
            removed += tl_navmesh_remove_tile(navmesh, x, z) == TL_OK;
        }
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_filter filter = tl_default_nav_filter();
        filter.include_flags = round % 2 == 0 ? 1 : UINT64_MAX;
        filter.exclude_flags = round % 12 == 11 ? 1 : 0;
        uint64_t *met = calloc(all.count + 1u, sizeof *met);
        uint64_t total = doubled_squares(navmesh, &level);
        for (uint64_t k = 0; k < total; k++) {
            const uint64_t bits[2] = { bits_of_square(k, total), test_random_u64(&random) };
            tl_nav_location at;
            if (filter.exclude_flags != 0) {
                TEST_RESULT(tl_navmesh_random_point(navmesh, &filter, bits, &at), TL_NOT_FOUND);
                refused++;
                break;
            }
            TEST_RESULT(tl_navmesh_random_point(navmesh, round % 4 == 0 ? NULL : &filter, bits, &at), TL_OK);
            met[fixture_index_of(&all, at.polygon)]++;
            if (k % 97 == 0) {
                tl_vec3 closest;
                bool inside = false;
                TEST_RESULT(tl_navmesh_closest_point(navmesh, at.polygon, at.point, &closest, &inside), TL_OK);
                TEST_CHECK(closest.y == at.point.y && tl_distance(closest, at.point) == 0.0f);
            }
        }
        for (uint32_t i = 0; filter.exclude_flags == 0 && i < all.count; i++) {
            TEST_CHECK(met[i] == doubled_squares_of(navmesh, &level, all.refs[i]));
        }
        free(met);
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(removed > 10 && refused == 2);
}

static bool pass_even(const tl_nav_tile *tile, uint32_t polygon, void *user)
{
    (void)tile;
    (void)user;
    return polygon % 2 == 0;
}

// Polygons that a filter lets through, as often as their areas say.
static void test_refusing(void **state)
{
    (void)state;
    test_random random = { 72 };
    fixture_level level = fixture_random(&random, 1, 7);
    level.tile_cells = 3;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    fixture_refs all = fixture_all_refs(navmesh);
    tl_nav_filter filter = tl_default_nav_filter();
    filter.pass = pass_even;
    uint64_t total = 0;
    uint64_t *met = calloc(all.count + 1u, sizeof *met);
    bool *passes = calloc(all.count + 1u, sizeof *passes);
    for (uint32_t i = 0; i < all.count; i++) {
        uint32_t polygon = 0;
        TEST_RESULT(tl_navmesh_resolve(navmesh, all.refs[i], NULL, &polygon), TL_OK);
        passes[i] = pass_even(NULL, polygon, NULL);
        total += passes[i] ? doubled_squares_of(navmesh, &level, all.refs[i]) : 0;
    }
    for (uint64_t k = 0; k < total; k++) {
        const uint64_t bits[2] = { bits_of_square(k, total), 0 };
        tl_nav_location at;
        TEST_RESULT(tl_navmesh_random_point(navmesh, &filter, bits, &at), TL_OK);
        met[fixture_index_of(&all, at.polygon)]++;
    }
    for (uint32_t i = 0; i < all.count; i++) {
        TEST_CHECK(met[i] == (passes[i] ? doubled_squares_of(navmesh, &level, all.refs[i]) : 0));
    }
    free(met);
    free(passes);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

// One square: quarters of it are met alike.
static void test_within(void **state)
{
    (void)state;
    const char *const rows[] = { "0" };
    fixture_level level = fixture_make(rows, 1);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    test_random random = { 73 };
    uint32_t met[16] = { 0 };
    enum { DRAWS = 32000 };
    for (uint32_t i = 0; i < DRAWS; i++) {
        const uint64_t bits[2] = { test_random_u64(&random), test_random_u64(&random) };
        tl_nav_location at;
        TEST_RESULT(tl_navmesh_random_point(navmesh, NULL, bits, &at), TL_OK);
        uint32_t x = (uint32_t)(at.point.x < 3.9999f ? at.point.x : 3.9999f);
        uint32_t z = (uint32_t)(at.point.z < 3.9999f ? at.point.z : 3.9999f);
        met[4 * z + x]++;
    }
    for (uint32_t i = 0; i < 16; i++) {
        // 2000 expected, 43 the deviation.
        TEST_CHECK(met[i] > 1800 && met[i] < 2200);
    }
    tl_navmesh_destroy(navmesh);
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    const uint64_t bits[2] = { 1, 2 };
    tl_nav_location at;
    TEST_RESULT(tl_navmesh_random_point(navmesh, NULL, bits, &at), TL_NOT_FOUND);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_every_square), cmocka_unit_test(test_refusing),
                                        cmocka_unit_test(test_within) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
