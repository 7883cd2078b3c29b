// SPDX-License-Identifier: MIT
//
// Unpacked floors of the tiles that were asked for last, by least recent use: what moves touches the same few tiles at
// each step, and to unpack and link floors is a sixth of what it takes to bake a tile. Only their areas are set back.

#include "nav_obstacles/unpacked_tiles.h"

#include "base/assert.h"

#include <string.h>

enum { TILES_FOR_EACH_UNPACKED = 32 };

void tl_unpacked_tiles_init(tl_unpacked_tiles *tiles, uint64_t tile_count)
{
    const uint64_t share = tile_count / TILES_FOR_EACH_UNPACKED;
    memset(tiles, 0, sizeof *tiles);
    tiles->most = share < 1 ? 1 : share < TL_UNPACKED_TILES ? (uint32_t)share : TL_UNPACKED_TILES;
}

static tl_unpacked_tile *find_unpacked(tl_unpacked_tiles *tiles, uint32_t tile)
{
    for (uint32_t i = 0; i < tiles->most; i++) {
        if (tiles->tiles[i].last_use > 0 && tiles->tiles[i].tile == tile) {
            return &tiles->tiles[i];
        }
    }
    return NULL;
}

static tl_unpacked_tile *least_recent(tl_unpacked_tiles *tiles)
{
    tl_unpacked_tile *least = &tiles->tiles[0];
    for (uint32_t i = 1; i < tiles->most; i++) {
        least = tiles->tiles[i].last_use < least->last_use ? &tiles->tiles[i] : least;
    }
    return least;
}

tl_result tl_unpacked_tiles_take(tl_unpacked_tiles *tiles, uint32_t tile, const tl_packed_floors *packed,
                                 const tl_allocator *allocator, tl_unpacked_tile **taken_out)
{
    tl_unpacked_tile *taken = find_unpacked(tiles, tile);
    if (taken != NULL) {
        memcpy(taken->compact.area, taken->base_area, taken->compact.span_count);
    } else {
        taken = least_recent(tiles);
        taken->last_use = 0;
        taken->is_linked = false;
        taken->tile = tile;
        taken->scratch.allocator = allocator;
        TL_TRY(tl_floors_unpack(packed, &taken->scratch, &taken->compact, &taken->base_area));
    }
    taken->last_use = ++tiles->uses;
    *taken_out = taken;
    return TL_OK;
}

void tl_unpacked_tile_link(tl_unpacked_tile *tile)
{
    if (!tile->is_linked) {
        tl_floors_link(&tile->scratch, &tile->compact);
        tile->is_linked = true;
    }
}

void tl_unpacked_tiles_forget(tl_unpacked_tiles *tiles, uint32_t tile)
{
    tl_unpacked_tile *unpacked = find_unpacked(tiles, tile);
    if (unpacked != NULL) {
        unpacked->last_use = 0;
    }
}

uint64_t tl_unpacked_tiles_bytes(const tl_unpacked_tiles *tiles)
{
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < tiles->most; i++) {
        bytes += tiles->tiles[i].scratch.size;
    }
    return bytes;
}

void tl_unpacked_tiles_free(tl_unpacked_tiles *tiles)
{
    for (uint32_t i = 0; i < tiles->most; i++) {
        tl_floors_scratch_free(&tiles->tiles[i].scratch);
        tiles->tiles[i].last_use = 0;
    }
}
