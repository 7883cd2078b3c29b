// SPDX-License-Identifier: MIT
//
// The functions of nav_detour.h under the contract.

#include "contract.h"

#include <talus/nav_detour.h>

#include <stdlib.h>
#include <string.h>

static const tl_nav_tile *const *level_tiles(void)
{
    return (const tl_nav_tile *const *)contract_level_get()->tiles.tiles;
}

static tl_result write(contract_run *run, bool set)
{
    const contract_level *level = contract_level_get();
    const tl_nav_tile *const *tiles = level_tiles();
    const uint32_t count = level->tiles.tile_count;
    const uint64_t size =
        set ? tl_detour_set_size(tiles, count, TL_DETOUR_REFS_32) : tl_detour_tile_size(tiles[0], TL_DETOUR_REFS_32);
    TEST_CHECK(size > 0);
    unsigned char *bytes = calloc(1, (size_t)size);
    const uint64_t capacity = run->what == CONTRACT_NO_BUFFER      ? 0
                              : run->what == CONTRACT_SHORT_BUFFER ? size - 1
                                                                   : size;
    void *target = run->what == CONTRACT_NO_BUFFER ? NULL : bytes;
    const bool no_input = run->what == CONTRACT_NULL_INPUT;
    tl_detour_report report = { 0 };
    const tl_result result = set ? tl_detour_set_write(no_input ? NULL : tiles, count, TL_DETOUR_REFS_32, target,
                                                       capacity, run->wants_report ? &report : NULL)
                                 : tl_detour_tile_write(no_input ? NULL : tiles[0], TL_DETOUR_REFS_32, target, capacity,
                                                        run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = true;
    run->count = (uint32_t)size;
    run->answer = contract_hash(bytes, (size_t)size, 0);
    free(bytes);
    return result;
}

static tl_result detour_tile_write(contract_run *run)
{
    return write(run, false);
}

static tl_result detour_linked_set_write(contract_run *run)
{
    const tl_detour_off_mesh link = { .start = { 1, 0, 1 }, .end = { 2, 0, 2 }, .radius = 0.5f, .flags = 1, .area = 3 };
    const bool no_links = run->what == CONTRACT_NULL_INPUT && run->variant == 1;
    const tl_detour_set set = { level_tiles(), contract_level_get()->tiles.tile_count, no_links ? NULL : &link, 1,
                                TL_DETOUR_REFS_32 };
    const tl_detour_set sized = { set.tiles, set.tile_count, &link, 1, TL_DETOUR_REFS_32 };
    const uint64_t size = tl_detour_linked_set_size(&sized);
    TEST_CHECK(size > tl_detour_set_size(set.tiles, set.tile_count, TL_DETOUR_REFS_32));
    unsigned char *bytes = calloc(1, (size_t)size);
    const uint64_t capacity = run->what == CONTRACT_NO_BUFFER      ? 0
                              : run->what == CONTRACT_SHORT_BUFFER ? size - 1
                                                                   : size;
    tl_detour_report report = { 0 };
    const tl_result result = tl_detour_linked_set_write(
        run->what == CONTRACT_NULL_INPUT && run->variant == 0 ? NULL : &set,
        run->what == CONTRACT_NO_BUFFER ? NULL : bytes, capacity, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = true;
    run->count = (uint32_t)size;
    run->answer = contract_hash(bytes, (size_t)size, 0);
    free(bytes);
    return result;
}

static tl_result detour_set_write(contract_run *run)
{
    return write(run, true);
}

// A set of the level's tiles, which the caller frees.
static void *make_set(uint64_t *size)
{
    const uint32_t count = contract_level_get()->tiles.tile_count;
    *size = tl_detour_set_size(level_tiles(), count, TL_DETOUR_REFS_32);
    void *bytes = malloc((size_t)*size);
    TEST_RESULT(tl_detour_set_write(level_tiles(), count, TL_DETOUR_REFS_32, bytes, *size, NULL), TL_OK);
    return bytes;
}

static const char *const READ_FIELDS[] = { "cell_height", NULL };

static tl_result detour_read(contract_run *run)
{
    uint64_t size;
    void *bytes = make_set(&size);
    if (run->what == CONTRACT_BAD_BYTES) {
        memset(bytes, 0x55, (size_t)size);
    }
    tl_detour_read_def def = tl_default_detour_read_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.cell_height = 0.0f;
    }
    def.allocator = run->host->allocator;
    tl_detour_tiles tiles;
    memset(&tiles, 0x55, sizeof tiles);
    tl_detour_report report = { 0 };
    const tl_result result = tl_detour_read(
        run->what == CONTRACT_NULL_INPUT ? NULL : bytes, size, run->what == CONTRACT_NULL_DEF ? NULL : &def,
        run->what == CONTRACT_NULL_OUTPUT ? NULL : &tiles, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&tiles, sizeof tiles);
    if (result == TL_OK) {
        run->answer = contract_hash(tiles.tiles[0], (size_t)tiles.tiles[0]->blob.size, tiles.tile_count);
        tl_detour_tiles_free(&tiles);
    }
    free(bytes);
    return result;
}

static tl_result detour_read_off_mesh(contract_run *run)
{
    uint64_t size;
    void *bytes = make_set(&size);
    if (run->what == CONTRACT_BAD_BYTES) {
        memset(bytes, 0x55, (size_t)size);
    }
    uint32_t count = 99;
    tl_detour_report report = { 0 };
    const tl_result result =
        tl_detour_read_off_mesh(run->what == CONTRACT_NULL_INPUT ? NULL : bytes, size, NULL, 0,
                                run->what == CONTRACT_NULL_OUTPUT ? NULL : &count, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || count == 0;
    run->answer = count;
    free(bytes);
    return result;
}

static tl_result detour_tiles_free(contract_run *run)
{
    tl_detour_tiles zeroed;
    (void)run;
    memset(&zeroed, 0, sizeof zeroed);
    tl_detour_tiles_free(NULL);
    tl_detour_tiles_free(&zeroed);
    return TL_OK;
}

#define WRITES                                                                                                         \
    CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NO_BUFFER) |              \
        CONTRACT_BIT(SHORT_BUFFER)

const contract_entry CONTRACT_TABLE_nav_detour[] = {
    { "tl_detour_tile_size", CONTRACT_BIT(GOOD), 0, 0, NULL, detour_tile_write, NULL },
    { "tl_detour_set_size", CONTRACT_BIT(GOOD), 0, 0, NULL, detour_set_write, NULL },
    { "tl_detour_tile_write", WRITES, 1, 0, NULL, detour_tile_write, NULL },
    { "tl_detour_set_write", WRITES, 1, 0, NULL, detour_set_write, NULL },
    { "tl_detour_linked_set_size", CONTRACT_BIT(GOOD), 0, 0, NULL, detour_linked_set_write, NULL },
    { "tl_detour_linked_set_write", WRITES, 2, 0, NULL, detour_linked_set_write, NULL },
    { "tl_default_detour_read_def", 0, 0, 0, NULL, NULL, "returns the defaults" },
    { "tl_detour_read",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(BAD_BYTES) |
          CONTRACT_BIT(NO_MEMORY),
      1, 1, READ_FIELDS, detour_read, NULL },
    { "tl_detour_tiles_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, detour_tiles_free, NULL },
    { "tl_detour_read_off_mesh",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) |
          CONTRACT_BIT(BAD_BYTES),
      1, 1, NULL, detour_read_off_mesh, NULL },
    { 0 },
};
