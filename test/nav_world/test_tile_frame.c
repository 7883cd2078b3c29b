// SPDX-License-Identifier: MIT
//
// Tiles moved to another frame: the bits of tiles that were baked there, and the same bits after a way there and back.

#include "nav_world/world.h"
#include "nav_world_file.h"

static fixture_level make_level(tl_vec3 origin, bool detail)
{
    test_random random = { 7 };
    fixture_level level = fixture_random(&random, 5, 24);
    level.tile_cells = 8;
    level.origin = origin;
    level.detail = detail;
    return level;
}

static void test_moved_tiles_are_those_of_the_frame(void **state)
{
    (void)state;
    const fixture_level far = make_level(tl_vec3_make(-91234.56f, 3.25f, 77777.7f), false);
    const fixture_level near = make_level(tl_vec3_make(0, 3.25f, 0), false);
    uint32_t compared = 0;
    for (int32_t i = 0; i < 9; i++) {
        tl_nav_tile *moved = fixture_build_tile(&far, i % 3, i / 3, NULL);
        tl_nav_tile *baked = fixture_build_tile(&near, i % 3, i / 3, NULL);
        TEST_CHECK((moved == NULL) == (baked == NULL));
        if (moved != NULL) {
            tl_nav_world_move_tile(moved, 0, 0);
            TEST_CHECK(moved->blob.size == baked->blob.size);
            // The tree over the polygons was chosen by the rounded floats of the far tile: all else is the same.
            const size_t tree = (size_t)baked->nodes, behind = (size_t)baked->portals;
            TEST_CHECK(memcmp(moved, baked, tree) == 0);
            TEST_CHECK(memcmp((char *)moved + behind, (char *)baked + behind, (size_t)baked->blob.size - behind) == 0);
            TEST_RESULT(tl_nav_tile_check(moved, moved->blob.size, NULL), TL_OK);
            compared++;
        }
        tl_blob_free(moved);
        tl_blob_free(baked);
    }
    TEST_CHECK(compared >= 4);
}

static void test_there_and_back(void **state)
{
    (void)state;
    const fixture_level level = make_level(tl_vec3_make(1000.1f, 0, -2000.2f), true);
    uint32_t compared = 0;
    for (int32_t i = 0; i < 9; i++) {
        tl_nav_tile *tile = fixture_build_tile(&level, i % 3, i / 3, NULL);
        if (tile == NULL) {
            continue;
        }
        tl_nav_world_move_tile(tile, 1, 2);
        TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
        unsigned char *before = malloc((size_t)tile->blob.size);
        memcpy(before, tile, (size_t)tile->blob.size);
        // 100 tiles of 128 columns are 12,800 cells.
        tl_nav_world_move_tile(tile, -100, 70);
        TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
        TEST_CHECK(memcmp(before, tile, (size_t)tile->blob.size) != 0);
        tl_nav_world_move_tile(tile, 103, -75);
        tl_nav_world_move_tile(tile, -3, 5);
        TEST_CHECK(memcmp(before, tile, (size_t)tile->blob.size) == 0);
        compared++;
        free(before);
        tl_blob_free(tile);
    }
    TEST_CHECK(compared >= 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_moved_tiles_are_those_of_the_frame),
        cmocka_unit_test(test_there_and_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
