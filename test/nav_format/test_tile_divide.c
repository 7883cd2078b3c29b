// SPDX-License-Identifier: MIT
//
// A tile divided into layers: altered bytes, failing memory, what is refused, and the swap of a place's layers.

#include "stacked_levels.h"

#include <string.h>
#include <talus/nav_bake.h>
#include <talus/nav_query.h>

// A tile of the house with cuts, and the tile that it is a layer of.
static tl_nav_tile *make_house(const tl_sample_mesh *mesh, tl_nav_tiles *divided)
{
    const tl_nav_input input = { tl_sample_mesh_as_view(mesh), NULL, NULL, 0 };
    tl_nav_def def = tl_default_nav_def();
    def.tile_height = 2.9f;
    TEST_RESULT(tl_nav_bake(&def, &input, divided, NULL), TL_OK);
    TEST_CHECK(divided->tile_count > 3);
    def.tile_height = 0.0f;
    tl_nav_tiles whole;
    TEST_RESULT(tl_nav_bake(&def, &input, &whole, NULL), TL_OK);
    TEST_CHECK(whole.tile_count == 1);
    tl_nav_tile *tile = whole.tiles[0];
    whole.tiles[0] = NULL;
    tl_nav_tiles_free(&whole);
    return tile;
}

// Whatever byte is altered: the check refuses the tile, or a navmesh can hold it beside the others.
static void test_altered_bytes(void **state)
{
    (void)state;
    tl_sample_mesh mesh;
    tl_nav_tiles tiles;
    make_level(&STACKED_LEVELS[1], &mesh);
    tl_nav_tile *whole = make_house(&mesh, &tiles);
    tl_nav_tile *tile = tiles.tiles[1];
    uint8_t *bytes = (uint8_t *)tile;
    const uint32_t first = tl_nav_tile_side_first(tile, TL_NAV_SIDE_CUT);
    TEST_CHECK(first + 1 < tile->portal_count);
    uint32_t refused = 0, taken = 0;
    for (uint64_t i = 0; i < tile->blob.size; i++) {
        const uint64_t size = tile->blob.size;
        const uint8_t was = bytes[i];
        for (uint32_t change = 0; change < 3; change++) {
            bytes[i] = (uint8_t)(change == 0 ? was ^ 1 : change == 1 ? was ^ 0x80 : ~was);
            if (tl_nav_tile_check(bytes, size, NULL) != TL_OK) {
                refused++;
                continue;
            }
            tl_navmesh *navmesh;
            TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
            for (uint32_t t = 0; t < tiles.tile_count; t++) {
                const tl_result result = tl_navmesh_add_tile(navmesh, tiles.tiles[t], TL_NAV_TILE_BORROWED);
                TEST_CHECK(result == TL_OK || result == TL_ERR_ARGUMENT); // of a layer or lattice of another tile
            }
            tl_navmesh_destroy(navmesh);
            taken++;
        }
        bytes[i] = was;
    }
    TEST_CHECK(refused > 10 * taken && taken > 0);
    // What a cut says of itself.
    union {
        const tl_nav_portal *read;
        tl_nav_portal *write;
    } cuts = { tl_nav_tile_portals(tile) + first };
    const tl_nav_portal kept = cuts.write[0];
    cuts.write[0].low = (int32_t)tile->layer;
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_ERR_CORRUPT);
    cuts.write[0] = cuts.write[1];
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_ERR_CORRUPT);
    cuts.write[0] = kept;
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
    tl_blob_free(whole);
    tl_nav_tiles_free(&tiles);
    tl_sample_mesh_free(&mesh);
}

static void test_divide(void **state)
{
    (void)state;
    tl_sample_mesh mesh;
    tl_nav_tiles tiles;
    make_level(&STACKED_LEVELS[1], &mesh);
    tl_nav_tile *whole = make_house(&mesh, &tiles);
    uint32_t *layers = calloc(whole->polygon_count, sizeof *layers);
    tl_nav_tile_stack stack;
    // One layer is the tile; of another number but for that.
    TEST_RESULT(tl_nav_tile_divide(whole, layers, NULL, &stack, NULL), TL_OK);
    TEST_CHECK(stack.count == 1 && memcmp(stack.tiles[0], whole, whole->blob.size) == 0);
    tl_nav_tile_stack_free(&stack);
    tl_report report;
    TEST_RESULT(tl_nav_tile_divide(tiles.tiles[1], layers, NULL, &stack, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(stack.count == 0 && strcmp(report.field, "tile") == 0);
    layers[1] = TL_NAV_MAX_LAYER + 1;
    TEST_RESULT(tl_nav_tile_divide(whole, layers, NULL, &stack, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.element, "polygon") == 0 && report.element_index == 1);
    // All of a layer's polygons give its bytes again, cuts too.
    uint8_t *keep = malloc(whole->polygon_count);
    memset(keep, 1, whole->polygon_count);
    tl_nav_tile *again;
    TEST_RESULT(tl_nav_tile_subset(tiles.tiles[1], keep, NULL, &again, NULL), TL_OK);
    TEST_CHECK(again->blob.size == tiles.tiles[1]->blob.size && memcmp(again, tiles.tiles[1], again->blob.size) == 0);
    tl_blob_free(again);
    // Memory that fails.
    for (uint32_t p = 0; p < whole->polygon_count; p++) {
        layers[p] = p % 3;
    }
    uint32_t failures = 0;
    for (uint64_t k = 1;; k++, failures++) {
        test_allocator failing;
        test_allocator_init(&failing, k);
        const tl_result result = tl_nav_tile_divide(whole, layers, &failing.allocator, &stack, NULL);
        if (result == TL_OK) {
            TEST_CHECK(failing.live_blocks == 4);
            tl_nav_tile_stack_free(&stack);
            TEST_CHECK(failing.live_blocks == 0);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(stack.count == 0 && failing.live_blocks == 0);
    }
    TEST_CHECK(failures > 10);
    free(keep);
    free(layers);
    tl_blob_free(whole);
    tl_nav_tiles_free(&tiles);
    tl_sample_mesh_free(&mesh);
}

// A copy of a tile, by an allocator.
static tl_nav_tile *copy_of(const tl_nav_tile *tile, const tl_allocator *allocator)
{
    tl_nav_tile *copy = NULL;
    uint8_t *keep = malloc(tile->polygon_count);
    memset(keep, 1, tile->polygon_count);
    TEST_RESULT(tl_nav_tile_subset(tile, keep, allocator, &copy, NULL), TL_OK);
    free(keep);
    return copy;
}

static tl_nav_tile_stack copy_all(const tl_nav_tiles *tiles, uint32_t without, test_allocator *counting)
{
    tl_nav_tile_stack stack = { .allocator = counting->allocator };
    stack.tiles = test_allocate((tiles->tile_count - 1) * sizeof *stack.tiles, 16, counting);
    for (uint32_t i = 0; i < tiles->tile_count; i++) {
        if (i != without) {
            stack.tiles[stack.count++] = copy_of(tiles->tiles[i], &counting->allocator);
        }
    }
    return stack;
}

// The swap: what stays keeps its references, memory that fails loses none, another place is refused.
static void test_replace(void **state)
{
    (void)state;
    tl_sample_mesh mesh;
    tl_nav_tiles tiles;
    make_level(&STACKED_LEVELS[1], &mesh);
    tl_nav_tile *whole = make_house(&mesh, &tiles);
    const uint32_t count = tiles.tile_count;
    uint32_t failures = 0;
    for (uint64_t k = 0;; k++) {
        test_allocator counting;
        test_allocator_init(&counting, 0);
        tl_navmesh *navmesh;
        TEST_RESULT(tl_navmesh_create(&counting.allocator, &navmesh), TL_OK);
        tl_nav_tile_stack stack = copy_all(&tiles, count - 1, &counting);
        TEST_RESULT(tl_navmesh_replace_tiles(navmesh, 0, 0, &stack), TL_OK);
        TEST_CHECK(stack.count == 0 && stack.tiles == NULL && tl_navmesh_tile_count(navmesh) == count - 1);
        const tl_nav_ref kept = tl_navmesh_polygon_ref(navmesh, 1, 0), gone = tl_navmesh_polygon_ref(navmesh, 0, 0);
        stack = copy_all(&tiles, 0, &counting);
        stack.tiles[0]->tile_x = k == 0 ? 1 : 0;
        counting.calls = 0;
        counting.fail_at = k;
        const tl_result result = tl_navmesh_replace_tiles(navmesh, 0, 0, &stack);
        TEST_CHECK(stack.count == 0 && stack.tiles == NULL);
        TEST_CHECK((tl_navmesh_resolve(navmesh, kept, NULL, NULL) == TL_OK));
        TEST_CHECK((tl_navmesh_resolve(navmesh, gone, NULL, NULL) == TL_OK) == (k == 0));
        if (k == 0) {
            TEST_RESULT(result, TL_ERR_ARGUMENT);
            TEST_CHECK(tl_navmesh_tile_count(navmesh) == count - 1);
        } else if (result != TL_OK) {
            TEST_RESULT(result, TL_ERR_MEMORY);
            failures++;
        }
        tl_navmesh_destroy(navmesh);
        TEST_CHECK(counting.live_blocks == 0);
        if (result == TL_OK) {
            break;
        }
    }
    TEST_CHECK(failures > 5);
    tl_blob_free(whole);
    tl_nav_tiles_free(&tiles);
    tl_sample_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_altered_bytes), cmocka_unit_test(test_divide),
                                        cmocka_unit_test(test_replace) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
