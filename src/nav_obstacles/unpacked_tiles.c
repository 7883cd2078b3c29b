// SPDX-License-Identifier: MIT
//
// Unpacked floors of the tiles that were asked for last, by least recent use: what moves touches the same few tiles at
// each step, and to unpack and link floors is a sixth of what it takes to bake a tile. Only their areas are set back.

#include "nav_obstacles/unpacked_tiles.h"

#include "base/assert.h"
#include "base/min_max.h"

#include <string.h>

enum { TILES_FOR_EACH_UNPACKED = 32, FOR_EACH_WORKER = 4 };

void tl_unpacked_tiles_init(tl_unpacked_tiles *tiles, uint64_t tile_count, uint32_t workers)
{
    const uint64_t wanted = workers > 1 ? (uint64_t)FOR_EACH_WORKER * workers
                                        : tl_min_u64(tile_count / TILES_FOR_EACH_UNPACKED, FOR_EACH_WORKER);
    tiles->most = tl_max_u32(tiles->most, (uint32_t)tl_min_u64(wanted, TL_MAX_UNPACKED_TILES));
    tiles->most = tl_max_u32(tiles->most, 1);
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
    tl_unpacked_tile *least = NULL;
    for (uint32_t i = 0; i < tiles->most; i++) {
        tl_unpacked_tile *room = &tiles->tiles[i];
        least = !room->is_reserved && (least == NULL || room->last_use < least->last_use) ? room : least;
    }
    return least;
}

tl_unpacked_tile *tl_unpacked_tiles_reserve(tl_unpacked_tiles *tiles, uint32_t tile)
{
    tl_unpacked_tile *room = find_unpacked(tiles, tile);
    room = room != NULL && !room->is_reserved ? room : least_recent(tiles); // another tile may have got it
    if (room != NULL) {
        room->is_reserved = true;
        room->was_filled = false;
    }
    return room;
}

tl_result tl_unpacked_tile_fill(tl_unpacked_tile *room, uint32_t tile, const tl_packed_floors *packed,
                                const tl_allocator *allocator)
{
    if (room->last_use > 0 && room->tile == tile) {
        memcpy(room->compact.area, room->base_area, room->compact.span_count);
    } else {
        room->last_use = 0;
        room->is_linked = false;
        room->tile = tile;
        room->scratch.allocator = allocator;
        TL_TRY(tl_floors_unpack(packed, &room->scratch, &room->compact, &room->base_area));
    }
    room->was_filled = true;
    return TL_OK;
}

void tl_unpacked_tiles_release(tl_unpacked_tiles *tiles)
{
    for (uint32_t i = 0; i < tiles->most; i++) {
        tl_unpacked_tile *room = &tiles->tiles[i];
        if (room->is_reserved && room->was_filled) {
            room->last_use = ++tiles->uses;
        }
        room->is_reserved = false;
    }
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
