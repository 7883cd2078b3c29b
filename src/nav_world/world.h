// SPDX-License-Identifier: MIT
//
// The inside of a world: its places, as the file has them, and which of them are in memory.

#ifndef TALUS_SRC_NAV_WORLD_WORLD_H
#define TALUS_SRC_NAV_WORLD_WORLD_H

#include "base/radix_sort.h"

#include <talus/nav_world.h>

#include <math.h>

#define TL_NAV_WORLD_NO_PLACE UINT32_MAX

/// What a tile in memory takes with all that the navmesh keeps for it, in its bytes in the file: hardly less than this.
#define TL_NAV_WORLD_LEAST_RATIO 1.3

/// Inner points of a tile's surface lie on such parts of a cell, where the bake puts them.
#define TL_NAV_WORLD_STEPS_A_CELL 512

typedef enum tl_nav_place_stage {
    TL_NAV_PLACE_ABSENT,
    TL_NAV_PLACE_LOADING, ///< a load has its tiles' memory
    TL_NAV_PLACE_READY,   ///< read and checked; the next update takes it in
    TL_NAV_PLACE_LOADED,
    TL_NAV_PLACE_FAILED ///< until the interests move
} tl_nav_place_stage;

/// One tile of the file.
typedef struct tl_nav_world_tile {
    uint32_t entry; ///< of the index
    uint32_t layer;
    int32_t x, z;
    tl_aabb bounds;    ///< metres, as in the file
    tl_nav_tile *blob; ///< NULL, or its bytes, which the navmesh borrows in a place that is loaded
    uint32_t slot;     ///< of the navmesh, where it is loaded
} tl_nav_world_tile;

/// A place of the grid, with the tiles of its layers. They come and go together.
typedef struct tl_nav_world_place {
    int32_t x, z;
    uint32_t first_tile, tile_count;
    uint32_t neighbour[4]; ///< across sides 0 to 3, or TL_NAV_WORLD_NO_PLACE
    tl_aabb bounds;        ///< metres, as in the file
    uint64_t file_bytes;
    double distance; ///< metres to the nearest interest; INFINITY: nobody wants it
    uint32_t stage;  ///< a tl_nav_place_stage
} tl_nav_world_place;

/// What of the budget is taken. An allocator that says no where it would be exceeded.
typedef struct tl_nav_world_purse {
    tl_allocator parent;
    uint64_t limit, taken, peak;
    bool parent_failed; ///< since it was last set to false
} tl_nav_world_purse;

struct tl_nav_world {
    tl_allocator allocator;
    tl_nav_world_purse purse;
    tl_allocator budgeted; ///< the purse, as an allocator
    tl_nav_world_read_fn *read;
    void *read_user;
    double frame_reach;

    void *index_bytes;
    uint64_t index_size;
    tl_pack_index index;
    tl_nav_world_tile *tiles; ///< [tile_count], by z, x, layer
    uint32_t tile_count, tile_capacity;
    tl_nav_world_place *places; ///< [place_count], by z, x; room for tile_capacity, as below
    uint32_t place_count;
    double origin[3]; ///< of the level's frame
    uint32_t axes;    ///< a tl_pack_axes
    tl_vec3 lattice_origin;
    float cell_size;
    uint32_t tile_size;
    uint32_t tiles_x, tiles_z; ///< of the grid

    int32_t frame_x, frame_z; ///< the place at which local 0 lies
    uint32_t frames;
    tl_navmesh *navmesh;
    tl_nav_world_interest *interests; ///< [interest_count], those that `wanted` was made for, in metres of the file
    uint32_t interest_count;
    uint32_t *wanted; ///< [wanted_count], nearest first
    uint32_t wanted_count;
    bool is_full;      ///< nothing more is loaded until the interests move: what is wanted next is too large
    uint32_t *present; ///< [present_count], places in memory
    uint32_t present_count;
    uint32_t *open; ///< [open_count], of them those beside a place that is not
    uint32_t open_count;
    tl_sort_item *sorted; ///< scratch, twice the room
    uint32_t loading, ready, failed;
    uint64_t present_file_bytes, read_bytes;

    struct tl_world_routes *routes; ///< NULL: the file has none
};

/// tl_nav_world_create; `bare`: what the file has of routes is not looked at.
tl_result tl_nav_world_open(const tl_nav_world_def *def, bool bare, tl_nav_world **world_out, tl_report *report);

/// Reads bytes of the file; what they are of is named in the report. Of `read` only TL_OK and errors pass: an outcome
/// such as TL_NOT_FOUND would be taken for one of the world's, so it becomes TL_ERR_IO.
tl_result tl_nav_world_read_bytes(const tl_nav_world *world, uint64_t offset, void *bytes, size_t size,
                                  const char *element, uint64_t index, tl_report *report);

/// Reports that an allocator had no memory: TL_ERR_MEMORY.
tl_result tl_nav_world_no_memory(tl_report *report);

/// Reads a tile of the file into `blob`, of the size that the index says, and checks it: hash, contents, and that it is
/// the one that its head promised. `*advice` (not NULL) says what to do about a failure.
tl_result tl_nav_world_read_tile(const tl_nav_world *world, const tl_nav_world_tile *tile, tl_nav_tile *blob,
                                 const char **advice);

/// The place at (x, z) of the file's grid, or TL_NAV_WORLD_NO_PLACE. O(log places).
uint32_t tl_nav_world_find_place(const tl_nav_world *world, int64_t x, int64_t z);

/// Where local 0 lies in metres of the file: x and z.
void tl_nav_world_frame_origin(const tl_nav_world *world, double out[2]);
/// A point of the level in metres of the file, in double.
void tl_nav_world_to_file(const tl_nav_world *world, const double point[3], double out[3]);
/// And back.
void tl_nav_world_from_file(const tl_nav_world *world, const double at[3], double out[3]);

/// Moves a checked tile so many places of the grid towards local 0, which is the lattice's origin from then on: its
/// place and corners are counted from there, exactly; inner points of the surface are rounded to 512ths of a cell
/// (tile_frame.c).
void tl_nav_world_move_tile(tl_nav_tile *tile, int32_t step_x, int32_t step_z);

/// Places that a box in the plane, metres in the file, may touch: calls back for each until it returns false. One cell
/// of margin for rounding.
typedef bool tl_nav_world_visit_fn(const tl_nav_world *world, uint32_t place, void *user);
void tl_nav_world_visit_box(const tl_nav_world *world, const double low[2], const double high[2],
                            tl_nav_world_visit_fn *visit, void *user);

/// Frees the tiles of a place, which are not in the navmesh.
void tl_nav_world_drop_blobs(tl_nav_world *world, uint32_t place);
/// The nearest wanted place that is neither in memory nor on its way, or TL_NAV_WORLD_NO_PLACE.
uint32_t tl_nav_world_next_wanted(const tl_nav_world *world);
/// What a place takes of the budget, by what those in memory take.
double tl_nav_world_bytes_needed(const tl_nav_world *world, uint32_t place);
/// Whether the budget has room for a place beside what is on its way.
bool tl_nav_world_has_room(const tl_nav_world *world, uint32_t place);

/// Distance from `at` to [low, high].
static inline double tl_nav_world_gap(double at, double low, double high)
{
    return at < low ? low - at : at > high ? at - high : 0.0;
}

static inline bool tl_nav_world_is_finite(const double point[3])
{
    return isfinite(point[0]) && isfinite(point[1]) && isfinite(point[2]);
}

static inline bool tl_nav_world_is_present(const tl_nav_world *world, uint32_t place)
{
    return world->places[place].stage == TL_NAV_PLACE_LOADED;
}

#endif
