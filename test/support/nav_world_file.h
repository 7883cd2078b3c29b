// SPDX-License-Identifier: MIT
//
// Baked files of small worlds in memory, and worlds over them: a grid of cells (nav_fixture.h) in tiles, anywhere.

#ifndef TALUS_TEST_NAV_WORLD_FILE_H
#define TALUS_TEST_NAV_WORLD_FILE_H

#include "memory_file.h"
#include "nav_fixture.h"

#include <talus/nav_world.h>

typedef struct world_file {
    memory_file in;
    uint64_t reads;
    uint64_t fail_from; ///< reads of chunks behind this offset fail; 0: none
    uint64_t fail_at;   ///< this read, counted from 1, says `failure`; 0: none
    tl_result failure;
} world_file;

static inline tl_result world_file_read(uint64_t offset, void *bytes, size_t size, void *user)
{
    world_file *file = (world_file *)user;
    if (++file->reads == file->fail_at) {
        return file->failure;
    }
    if (file->fail_from != 0 && offset >= file->fail_from && offset + size <= file->in.size) {
        return TL_ERR_IO;
    }
    return memory_file_read(offset, bytes, size, &file->in);
}

/// A file of such tiles, row by row, with `origin` as the level's own coordinates of 0 and such axes.
static inline world_file world_file_pack(const tl_nav_def *def, const tl_nav_tiles *tiles, const double origin[3],
                                         tl_pack_axes axes)
{
    enum { MAX_ITEMS = 1024 };
    static tl_pack_item items[MAX_ITEMS];
    const uint32_t count = 2 + tiles->tile_count;
    tl_pack_navmesh *navmesh = NULL;
    tl_pack_frame *frame = NULL;
    TEST_CHECK(count <= MAX_ITEMS);
    TEST_RESULT(tl_pack_navmesh_encode(def, tiles->tiles_x, tiles->tiles_z, tiles->tile_count, NULL, &navmesh, NULL),
                TL_OK);
    TEST_RESULT(tl_pack_frame_encode(axes, origin, NULL, &frame, NULL), TL_OK);
    const tl_pack_item settings = { TL_PACK_NAVM, 0, navmesh, navmesh->blob.size };
    const tl_pack_item place = { TL_PACK_FRAM, 0, frame, frame->blob.size };
    items[0] = settings;
    items[1] = place;
    for (uint32_t i = 0; i < tiles->tile_count; i++) {
        const tl_pack_item item = { TL_PACK_NAVT, i, tiles->tiles[i], tiles->tiles[i]->blob.size };
        items[2 + i] = item;
    }
    world_file file;
    memset(&file, 0, sizeof file);
    TEST_RESULT(tl_pack_write(items, count, NULL, memory_file_write, &file.in, NULL), TL_OK);
    tl_blob_free(navmesh);
    tl_blob_free(frame);
    return file;
}

/// The same of a grid of cells.
static inline world_file world_file_make(const fixture_level *level, const double origin[3], tl_pack_axes axes)
{
    enum { MAX_TILES = 1024 };
    tl_nav_tile *list[MAX_TILES];
    tl_nav_tiles tiles;
    memset(&tiles, 0, sizeof tiles);
    tiles.tiles = list;
    tiles.tiles_x = fixture_tiles(level->width, level->tile_cells);
    tiles.tiles_z = fixture_tiles(level->height, level->tile_cells);
    for (uint32_t i = 0; i < tiles.tiles_x * tiles.tiles_z; i++) {
        tl_nav_tile *tile = fixture_build_tile(level, (int32_t)(i % tiles.tiles_x), (int32_t)(i / tiles.tiles_x), NULL);
        if (tile != NULL) {
            TEST_CHECK(tiles.tile_count < MAX_TILES);
            list[tiles.tile_count++] = tile;
        }
    }
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = level->cell_size;
    def.cell_height = level->cell_height;
    def.tile_size = level->tile_cells * FIXTURE_STEP;
    def.bounds.min = level->origin;
    def.bounds.max = tl_add(level->origin, tl_vec3_make(300, 50, 300));
    const world_file file = world_file_pack(&def, &tiles, origin, axes);
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        tl_blob_free(list[i]);
    }
    return file;
}

static inline void world_file_free(world_file *file)
{
    free(file->in.bytes);
    memset(file, 0, sizeof *file);
}

static inline tl_nav_world *world_open(world_file *file, uint64_t budget, double frame_reach)
{
    tl_nav_world_def def = tl_default_nav_world_def();
    tl_nav_world *world = NULL;
    tl_report report;
    def.read = world_file_read;
    def.user = file;
    def.budget = budget;
    def.frame_reach = frame_reach;
    TEST_RESULT(tl_nav_world_create(&def, &world, &report), TL_OK);
    return world;
}

/// Runs loads and updates until nothing changes any more.
static inline void world_settle(tl_nav_world *world, const tl_nav_world_interest *interests, uint32_t count)
{
    uint32_t quiet = 0;
    for (uint32_t round = 0; quiet < 2; round++) {
        tl_nav_world_load load;
        TEST_CHECK(round < 100000);
        const tl_result result = tl_nav_world_update(world, interests, count, 1 + round % 3);
        TEST_CHECK(result == TL_OK || result == TL_NOT_FOUND);
        quiet = result == TL_NOT_FOUND ? quiet + 1 : 0;
        if (tl_nav_world_begin_load(world, &load) == TL_OK) {
            (void)tl_nav_world_run_load(&load);
            TEST_RESULT(tl_nav_world_end_load(&load), TL_OK);
            quiet = 0;
        }
    }
}

static inline tl_nav_world_interest world_interest(const double origin[3], double x, double z, double radius)
{
    const tl_nav_world_interest interest = { { origin[0] + x, origin[1], origin[2] + z }, radius };
    return interest;
}

static inline tl_nav_world_state world_state(const tl_nav_world *world)
{
    tl_nav_world_state state;
    TEST_RESULT(tl_nav_world_get_state(world, &state), TL_OK);
    return state;
}

#endif
