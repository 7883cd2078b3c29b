// SPDX-License-Identifier: MIT

#include "polygon/mesh/polygon_store.h"

#include "talus_test.h"

static uint32_t vertex(tl_polygon_store *store, int32_t x, int32_t y, int32_t z)
{
    uint32_t number = TL_NO_VALUE;
    TEST_RESULT(tl_polygon_store_vertex(store, x, y, z, false, &number), TL_OK);
    return number;
}

static void merges_within_the_height(void **state)
{
    (void)state;
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_polygon_def def = tl_default_polygon_def();
    tl_polygon_store store;
    TEST_RESULT(tl_polygon_store_init(&store, &arena, &def, 0), TL_OK);
    TEST_CHECK(vertex(&store, 5, 10, 5) == 0);
    TEST_CHECK(vertex(&store, 5, 12, 5) == 0 && vertex(&store, 5, 8, 5) == 0);
    TEST_CHECK(vertex(&store, 5, 13, 5) == 1);
    TEST_CHECK(vertex(&store, 6, 10, 5) == 2 && vertex(&store, 5, 10, 6) == 3);
    // Between two the nearest, at equal distance the lower number.
    TEST_CHECK(vertex(&store, 5, 12, 5) == 1 && vertex(&store, 5, 11, 5) == 0);
    TEST_CHECK(vertex(&store, 5, 16, 5) == 4 && vertex(&store, 5, 14, 5) == 1 && vertex(&store, 5, 15, 5) == 4);
    // The whole range of heights.
    TEST_CHECK(vertex(&store, 5, INT32_MIN, 5) == 5 && vertex(&store, 5, INT32_MAX, 5) == 6);
    tl_arena_free(&arena);
}

static void grows_and_still_finds(void **state)
{
    (void)state;
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_polygon_def def = tl_default_polygon_def();
    def.merge_height = 0;
    tl_polygon_store store;
    TEST_RESULT(tl_polygon_store_init(&store, &arena, &def, 0), TL_OK);
    for (int32_t round = 0; round < 2; round++) {
        for (int32_t i = 0; i < 3000; i++) {
            // Three heights a place.
            TEST_CHECK(vertex(&store, i / 3 % 50, i % 3, i / 150) == (uint32_t)i);
        }
    }
    TEST_CHECK(store.vertex_count == 3000 && store.place_count == 1000);
    uint32_t corners[3] = { 0, 1, 2 }, map[3] = { 7, 8, 9 };
    tl_stored_polygon of = { 0, 0, 1, 2, 3 };
    for (uint32_t p = 0; p < 500; p++) {
        TEST_RESULT(tl_polygon_store_add(&store, corners, 3, map, &of), TL_OK);
        TEST_RESULT(tl_polygon_store_add(&store, corners, 3, NULL, &of), TL_OK);
    }
    TEST_CHECK(store.polygon_count == 1000 && store.index_count == 3000);
    TEST_CHECK(store.polygons[999].first == 2997 && store.polygons[999].contour == 3);
    TEST_CHECK(store.indices[0] == 7 && store.indices[5] == 2);
    tl_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(merges_within_the_height),
        cmocka_unit_test(grows_and_still_finds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
