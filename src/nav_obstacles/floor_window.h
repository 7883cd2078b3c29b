// SPDX-License-Identifier: MIT
//
// A rectangle of a tile's columns with their floors, read without the rest of the tile.

#ifndef TALUS_SRC_NAV_OBSTACLES_FLOOR_WINDOW_H
#define TALUS_SRC_NAV_OBSTACLES_FLOOR_WINDOW_H

#include "nav_obstacles/obstacle_window.h"
#include "nav_obstacles/packed_floors.h"
#include "nav_obstacles/tile_marks.h"

/// Memory that is used again.
typedef struct tl_window_block {
    void *bytes;
    uint64_t size;
} tl_window_block;

/// Zero is an empty one.
typedef struct tl_floor_window {
    tl_nav_compact
        compact; ///< a field of these columns alone, in the level's lattice: no links; areas are to be marked
    const uint8_t *base_area; ///< [compact.span_count]
    uint32_t *row_floor;      ///< [compact.height] the tile's number of each row's first floor
    uint8_t *marked;          ///< [compact.span_count] scratch
    tl_window_block columns, floors;
} tl_floor_window;

/// Reads the floors and their base areas. TL_ERR_MEMORY: the window is empty.
tl_result tl_floor_window_read(tl_floor_window *window, const tl_packed_floors *packed, tl_obstacle_window columns,
                               const tl_allocator *allocator);
/// Whether the areas are those that a tile's marks stand for.
bool tl_floor_window_holds(const tl_floor_window *window, const tl_tile_marks *marks);
/// Puts the areas into those of the tile's floors.
void tl_floor_window_paste(const tl_floor_window *window, uint8_t *area);
uint64_t tl_floor_window_bytes(const tl_floor_window *window);
void tl_floor_window_free(tl_floor_window *window, const tl_allocator *allocator);

#endif
