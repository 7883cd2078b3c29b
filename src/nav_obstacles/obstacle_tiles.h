// SPDX-License-Identifier: MIT
//
// The tiles of obstacles: their floors, what stands on them, and which of them wait to be baked again.

#ifndef TALUS_SRC_NAV_OBSTACLES_OBSTACLE_TILES_H
#define TALUS_SRC_NAV_OBSTACLES_OBSTACLE_TILES_H

#include "nav_obstacles/floor_window.h"
#include "nav_obstacles/unpacked_tiles.h"

#include <talus/nav_obstacles.h>

// A tile's floors, with the areas that the bake gave.
typedef struct tile_floors {
    tl_packed_floors floors;
    tl_nav_tile_memo *memo; // NULL until the tile is first made again
    tl_tile_marks marks;    // as it was last handed out, with is_known
    tl_aabb changed;        // where marks may have changed since then, while it waits
    uint32_t next_waiting;  // in the queue, while it waits
    bool is_there, waits;
    bool is_known;    // the caller has this tile
    bool all_changed; // marks may have changed anywhere, while it waits
} tile_floors;

typedef struct obstacle_slot {
    tl_nav_obstacle obstacle;
    tl_nav_tile_range range; // the tiles that it touches
    tl_aabb box;
    uint32_t generation; // odd: in use
    uint32_t next_free;
} obstacle_slot;

struct tl_nav_obstacles {
    tl_allocator allocator;
    tl_nav_def def; // without host
    uint32_t tiles_x, tiles_z;
    tile_floors *tiles; // [tiles_x * tiles_z]
    obstacle_slot *slots;
    uint32_t slot_count, slot_capacity, first_free, used_count;
    uint32_t first_waiting, last_waiting, waiting_count;
    tl_unpacked_tiles unpacked; // of the tiles that were made again last
    const tl_tasks *tasks;      // that make tiles; NULL: the calling thread
    tl_floor_window *windows;   // [window_count] of the tile that a worker looks at
    uint32_t window_count;      // at least one for each worker
};

#define OBSTACLE_NO_SLOT UINT32_MAX

static inline tile_floors *tl_obstacles_tile_at(const tl_nav_obstacles *o, uint32_t x, uint32_t z)
{
    return &o->tiles[(uint64_t)z * o->tiles_x + x];
}

/// The part of a report that all calls have, begun; NULL: nobody asks for one.
tl_report *tl_obstacles_report_begin(tl_nav_bake_report *report, const char *stage);

/// Puts tiles into the queue: those of a range whose floors can be in the box; NULL: all.
void tl_obstacles_let_wait(tl_nav_obstacles *o, const tl_nav_tile_range *range, const tl_aabb *box);
/// Takes the first one out of it.
void tl_obstacles_end_wait(tl_nav_obstacles *o);

#endif
