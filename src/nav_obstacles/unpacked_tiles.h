// SPDX-License-Identifier: MIT
//
// The tiles whose floors were unpacked last.

#ifndef TALUS_SRC_NAV_OBSTACLES_UNPACKED_TILES_H
#define TALUS_SRC_NAV_OBSTACLES_UNPACKED_TILES_H

#include "nav_obstacles/packed_floors.h"

/// At most. For one worker it is 4, as many as an obstacle reaches at its old and its new place, mostly.
enum { TL_MAX_UNPACKED_TILES = 16 };

typedef struct tl_unpacked_tile {
    tl_floors_scratch scratch;
    tl_nav_compact compact; ///< in the scratch, as it was unpacked but for its areas, which are the caller's to mark
    uint8_t *base_area;     ///< in the scratch: [span_count]
    uint64_t last_use;      ///< 0: it holds no tile
    uint32_t tile;
    bool is_linked;
    bool is_reserved, was_filled; ///< since it was reserved
} tl_unpacked_tile;

typedef struct tl_unpacked_tiles {
    tl_unpacked_tile tiles[TL_MAX_UNPACKED_TILES];
    uint32_t most; ///< of them that are used, 1 to TL_MAX_UNPACKED_TILES
    uint64_t uses;
} tl_unpacked_tiles;

/// None yet, of a level of so many tiles. Unpacked floors take many times the room of packed ones: for one worker there
/// is one for each 32 tiles of the level, up to 4, and at least one; for several 4 a worker, so that they are made in
/// batches. Those that are there stay.
void tl_unpacked_tiles_init(tl_unpacked_tiles *tiles, uint64_t tile_count, uint32_t workers);

/// Room for a tile, which is not another's before tl_unpacked_tiles_release: that in which it lies already, or else the
/// one that was used least recently. NULL: all are reserved.
tl_unpacked_tile *tl_unpacked_tiles_reserve(tl_unpacked_tiles *tiles, uint32_t tile);
/// Its floors with their base areas; mostly they have no links yet. Other threads may fill others. TL_ERR_MEMORY.
tl_result tl_unpacked_tile_fill(tl_unpacked_tile *room, uint32_t tile, const tl_packed_floors *packed,
                                const tl_allocator *allocator);
/// Links them, unless they are linked.
void tl_unpacked_tile_link(tl_unpacked_tile *tile);
/// Gives all rooms back that are reserved.
void tl_unpacked_tiles_release(tl_unpacked_tiles *tiles);
/// To be called when a tile's packed floors are replaced.
void tl_unpacked_tiles_forget(tl_unpacked_tiles *tiles, uint32_t tile);
uint64_t tl_unpacked_tiles_bytes(const tl_unpacked_tiles *tiles);
/// Gives their memory back; they can be used again.
void tl_unpacked_tiles_free(tl_unpacked_tiles *tiles);

#endif
