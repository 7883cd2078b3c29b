// SPDX-License-Identifier: MIT
//
// Tiles of some of a tile's polygons: all give the same bytes, some are whole tiles with walls where the others were.

#include "nav_level.h"

static test_level LEVEL;

static tl_nav_tiles bake(uint32_t tile_size)
{
    test_level_make(&LEVEL, tl_vec3_make(3, 1, -7));
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    def.agent_radius = 0.4f;
    def.tile_size = tile_size;
    const tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
    return tiles;
}

static void all_polygons_give_the_same_bytes(void **state)
{
    (void)state;
    uint8_t keep[4096];
    memset(keep, 1, sizeof keep);
    for (uint32_t tile_size = 0; tile_size <= 48; tile_size += 16) {
        tl_nav_tiles tiles = bake(tile_size);
        for (uint32_t t = 0; t < tiles.tile_count; t++) {
            tl_nav_tile *again;
            TEST_RESULT(tl_nav_tile_subset(tiles.tiles[t], keep, NULL, &again, NULL), TL_OK);
            TEST_CHECK(again->blob.size == tiles.tiles[t]->blob.size);
            TEST_CHECK(memcmp(again, tiles.tiles[t], again->blob.size) == 0);
            tl_blob_free(again);
        }
        tl_nav_tiles_free(&tiles);
    }
}

static void check_polygon(const tl_nav_tile *tile, uint32_t p, const tl_nav_tile *part, uint32_t q, const uint8_t *keep)
{
    uint32_t count, part_count;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, p, &count);
    const tl_vec3 *part_corners = tl_nav_tile_corners(part, q, &part_count);
    TEST_CHECK(count == part_count && memcmp(corners, part_corners, count * sizeof *corners) == 0);
    TEST_CHECK(tl_nav_tile_area(tile, p) == tl_nav_tile_area(part, q));
    const tl_nav_surface surface = tl_nav_tile_surface(tile, p), part_surface = tl_nav_tile_surface(part, q);
    TEST_CHECK(surface.vertex_count == part_surface.vertex_count &&
               surface.triangle_count == part_surface.triangle_count);
    TEST_CHECK(memcmp(surface.vertices, part_surface.vertices, surface.vertex_count * sizeof *surface.vertices) == 0);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t across = tl_nav_tile_neighbour(tile, p, k), part_across = tl_nav_tile_neighbour(part, q, k);
        if (across >= tile->polygon_count) {
            TEST_CHECK(part_across == across);
        } else if (!keep[across]) {
            TEST_CHECK(part_across == TL_NO_POLYGON);
        } else {
            uint32_t number = 0;
            for (uint32_t i = 0; i < across; i++) {
                number += keep[i];
            }
            TEST_CHECK(part_across == number);
        }
    }
}

static void some_polygons_stay_what_they_are(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t portals = 0, cut = 0;
    for (uint32_t run = 0; run < 60; run++) {
        tl_nav_tiles tiles = bake(run % 2 == 0 ? 0 : 32);
        for (uint32_t t = 0; t < tiles.tile_count; t++) {
            const tl_nav_tile *tile = tiles.tiles[t];
            uint8_t keep[4096];
            uint32_t kept = 0;
            for (uint32_t p = 0; p < tile->polygon_count; p++) {
                keep[p] = (uint8_t)test_random_below(&random, 2);
                kept += keep[p];
            }
            tl_nav_tile *part;
            TEST_RESULT(tl_nav_tile_subset(tile, keep, NULL, &part, NULL), kept > 0 ? TL_OK : TL_ERR_EMPTY);
            if (part == NULL) {
                continue;
            }
            TEST_RESULT(tl_nav_tile_check(part, part->blob.size, NULL), TL_OK);
            TEST_CHECK(part->polygon_count == kept);
            for (uint32_t p = 0, q = 0; p < tile->polygon_count; p++) {
                if (keep[p]) {
                    check_polygon(tile, p, part, q++, keep);
                }
            }
            portals += part->portal_count;
            cut += tile->polygon_count - kept;
            tl_blob_free(part);
        }
        tl_nav_tiles_free(&tiles);
    }
    TEST_CHECK(portals > 100 && cut > 500);
}

static void failing_memory_leaves_nothing(void **state)
{
    (void)state;
    tl_nav_tiles tiles = bake(0);
    uint8_t keep[4096] = { 1, 0, 1, 1 };
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_nav_tile *part;
        const tl_result result = tl_nav_tile_subset(tiles.tiles[0], keep, &memory.allocator, &part, NULL);
        TEST_CHECK((result == TL_OK) == (part != NULL));
        tl_blob_free(part);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 2);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
    tl_nav_tiles_free(&tiles);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(all_polygons_give_the_same_bytes),
                                        cmocka_unit_test(some_polygons_stay_what_they_are),
                                        cmocka_unit_test(failing_memory_leaves_nothing) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
