// SPDX-License-Identifier: MIT
//
// The tiles whose floors were unpacked last.

#ifndef TALUS_SRC_NAV_OBSTACLES_UNPACKED_TILES_H
#define TALUS_SRC_NAV_OBSTACLES_UNPACKED_TILES_H

#include "nav_obstacles/packed_floors.h"

/// As many as an obstacle reaches at its old and its new place, mostly.
enum { TL_UNPACKED_TILES = 4 };

typedef struct tl_unpacked_tile {
    tl_floors_scratch scratch;
    tl_nav_compact compact; ///< in the scratch, as it was unpacked but for its areas, which are the caller's to mark
    uint8_t *base_area;     ///< in the scratch: [span_count]
    uint64_t last_use;      ///< 0: it holds no tile
    uint32_t tile;
    bool is_linked;
} tl_unpacked_tile;

typedef struct tl_unpacked_tiles {
    tl_unpacked_tile tiles[TL_UNPACKED_TILES];
    uint32_t most; ///< of them that are used, 1 to TL_UNPACKED_TILES
    uint64_t uses;
} tl_unpacked_tiles;

/// None yet, of a level of so many tiles. Unpacked floors take many times the room of packed ones: there is one for
/// each 32 tiles of the level, and at least one.
void tl_unpacked_tiles_init(tl_unpacked_tiles *tiles, uint64_t tile_count);

/// A tile's floors with their base areas, until the next call; mostly they have no links yet. TL_ERR_MEMORY.
tl_result tl_unpacked_tiles_take(tl_unpacked_tiles *tiles, uint32_t tile, const tl_packed_floors *packed,
                                 const tl_allocator *allocator, tl_unpacked_tile **taken_out);
/// Links them, unless they are linked.
void tl_unpacked_tile_link(tl_unpacked_tile *tile);
/// To be called when a tile's packed floors are replaced.
void tl_unpacked_tiles_forget(tl_unpacked_tiles *tiles, uint32_t tile);
uint64_t tl_unpacked_tiles_bytes(const tl_unpacked_tiles *tiles);
/// Gives their room back; they can be used again.
void tl_unpacked_tiles_free(tl_unpacked_tiles *tiles);

#endif
