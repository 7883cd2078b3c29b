// SPDX-License-Identifier: MIT
//
// Floors that stay unpacked are the floors that were packed, whatever was marked on them, which tiles were asked for
// between, and after floors were replaced; and memory may fail.

#include "nav_compact_fixture.h"

#include "nav_obstacles/unpacked_tiles.h"

enum { SOME_TILES = 8 };

typedef struct packed_tile {
    tl_nav_compact compact;
    tl_packed_floors floors;
} packed_tile;

static void pack_tile(test_random *random, packed_tile *tile)
{
    tile->compact = fixture_random(random, 5 + test_random_below(random, 20), 5 + test_random_below(random, 20),
                                   1 + (int)test_random_below(random, 3), test_random_below(random, 30), 0);
    TEST_RESULT(tl_floors_pack(&tile->compact, &tile->compact.allocator, &tile->floors), TL_OK);
}

static void free_tile(packed_tile *tile)
{
    tl_packed_floors_free(&tile->floors);
    fixture_compact_free(&tile->compact);
}

static void check_floors(const tl_nav_compact *a, const tl_unpacked_tile *b)
{
    TEST_CHECK(b->compact.span_count == a->span_count && b->compact.width == a->width);
    TEST_CHECK(memcmp(b->compact.area, a->area, a->span_count) == 0 &&
               memcmp(b->base_area, a->area, a->span_count) == 0);
    TEST_CHECK(memcmp(b->compact.floor, a->floor, a->span_count * sizeof *a->floor) == 0);
    for (uint32_t i = 0; i < 4 * a->span_count; i++) {
        TEST_CHECK(tl_nav_compact_neighbour(&b->compact, i / 4, i % 4) == tl_nav_compact_neighbour(a, i / 4, i % 4));
    }
}

static tl_result take(tl_unpacked_tiles *unpacked, uint32_t which, const packed_tile *tile,
                      const tl_allocator *allocator, tl_unpacked_tile **taken_out)
{
    *taken_out = tl_unpacked_tiles_reserve(unpacked, which);
    TEST_CHECK(*taken_out != NULL);
    const tl_result result = tl_unpacked_tile_fill(*taken_out, which, &tile->floors, allocator);
    tl_unpacked_tiles_release(unpacked);
    return result;
}

// Asks for few tiles again and again, and now and then for others.
static void test_floors_stay(void **state)
{
    (void)state;
    test_random random = { 8 };
    static packed_tile tiles[SOME_TILES];
    static tl_unpacked_tiles unpacked;
    uint32_t kept = 0, fresh = 0, replaced = 0;
    for (uint32_t i = 0; i < SOME_TILES; i++) {
        pack_tile(&random, &tiles[i]);
    }
    tl_unpacked_tiles_init(&unpacked, 1000, 1);
    TEST_CHECK(unpacked.most == 4);
    for (int round = 0; round < 3000; round++) {
        const uint32_t most = round / 20 % 2 == 0 ? 4 : SOME_TILES;
        const uint32_t which = test_random_below(&random, most);
        tl_unpacked_tile *taken = NULL;
        TEST_RESULT(take(&unpacked, which, &tiles[which], NULL, &taken), TL_OK);
        kept += taken->is_linked;
        fresh += !taken->is_linked;
        tl_unpacked_tile_link(taken);
        check_floors(&tiles[which].compact, taken);
        memset(taken->compact.area, round % 200, taken->compact.span_count / 2); // an obstacle
        if (test_random_below(&random, 50) == 0) {
            tl_unpacked_tiles_forget(&unpacked, which);
            free_tile(&tiles[which]);
            pack_tile(&random, &tiles[which]);
            replaced++;
        }
    }
    TEST_CHECK(kept > 1500 && fresh > 300 && replaced > 20);
    TEST_CHECK(tl_unpacked_tiles_bytes(&unpacked) > 1000);
    tl_unpacked_tiles_free(&unpacked);
    TEST_CHECK(tl_unpacked_tiles_bytes(&unpacked) == 0);
    for (uint32_t i = 0; i < SOME_TILES; i++) {
        free_tile(&tiles[i]);
    }
}

// A tile that there was no memory for is not taken for one that is there.
static void test_memory_fails(void **state)
{
    (void)state;
    test_random random = { 9 };
    test_allocator memory;
    packed_tile tile;
    static tl_unpacked_tiles unpacked;
    tl_unpacked_tile *taken = NULL;
    pack_tile(&random, &tile);
    tl_unpacked_tiles_init(&unpacked, 31, 1);
    TEST_CHECK(unpacked.most == 1);
    test_allocator_init(&memory, 1);
    TEST_RESULT(take(&unpacked, 3, &tile, &memory.allocator, &taken), TL_ERR_MEMORY);
    TEST_CHECK(memory.live_blocks == 0);
    memory.fail_at = 0;
    TEST_RESULT(take(&unpacked, 3, &tile, &memory.allocator, &taken), TL_OK);
    tl_unpacked_tile_link(taken);
    check_floors(&tile.compact, taken);
    tl_unpacked_tiles_free(&unpacked);
    TEST_CHECK(memory.live_blocks == 0);
    free_tile(&tile);
}

// Rooms that are reserved are apart, four a worker; a tile that lies in one gets it again.
static void test_reserved_rooms(void **state)
{
    (void)state;
    enum { WORKERS = 3, ROOMS = 4 * WORKERS };
    test_random random = { 10 };
    packed_tile tile;
    static tl_unpacked_tiles unpacked;
    tl_unpacked_tile *rooms[ROOMS], *again[ROOMS];
    pack_tile(&random, &tile);
    tl_unpacked_tiles_init(&unpacked, 31, WORKERS);
    for (uint32_t i = 0; i < ROOMS; i++) {
        rooms[i] = tl_unpacked_tiles_reserve(&unpacked, i);
        for (uint32_t k = 0; k < i; k++) {
            TEST_CHECK(rooms[k] != rooms[i]);
        }
        TEST_RESULT(i % 2 == 0 ? tl_unpacked_tile_fill(rooms[i], i, &tile.floors, NULL) : TL_OK, TL_OK);
    }
    TEST_CHECK(tl_unpacked_tiles_reserve(&unpacked, ROOMS) == NULL);
    tl_unpacked_tiles_release(&unpacked);
    for (uint32_t i = ROOMS; i > 0; i -= 2) {
        again[i - 2] = tl_unpacked_tiles_reserve(&unpacked, i - 2);
        TEST_CHECK(again[i - 2] == rooms[i - 2]);
    }
    for (uint32_t i = 1; i < ROOMS; i += 2) {
        again[i] = tl_unpacked_tiles_reserve(&unpacked, 100 + i);
        TEST_CHECK(again[i] != NULL && again[i]->last_use == 0);
    }
    tl_unpacked_tiles_release(&unpacked);
    // One that was given to another tile is not given to its own as well.
    const tl_unpacked_tile *taken = NULL;
    for (uint32_t i = 0; i < ROOMS; i++) {
        const tl_unpacked_tile *room = tl_unpacked_tiles_reserve(&unpacked, 200 + i);
        taken = room == rooms[0] ? room : taken;
    }
    TEST_CHECK(taken == rooms[0] && tl_unpacked_tiles_reserve(&unpacked, 0) == NULL);
    tl_unpacked_tiles_release(&unpacked);
    tl_unpacked_tiles_free(&unpacked);
    free_tile(&tile);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_floors_stay), cmocka_unit_test(test_memory_fails),
                                        cmocka_unit_test(test_reserved_rooms) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
