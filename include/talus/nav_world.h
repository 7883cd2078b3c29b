// SPDX-License-Identifier: MIT
//
// A world that is larger than memory: the tiles of a baked file (pack.h) come and go around points of interest, under a
// budget of bytes, and answers say so when they depend on what is not there.
//
//   tl_nav_world_create(&def, &world, &report);            reads the index alone
//   each frame, while no query runs:
//     tl_nav_world_update(world, interests, count, 4);     tiles that were read come in, others make room
//   on any thread, at any time:
//     while (tl_nav_world_begin_load(world, &load) == TL_OK)   on the thread that updates
//       tl_nav_world_run_load(&load);                          on any thread: reads and checks
//     tl_nav_world_end_load(&load);                            on the thread that updates
//   between updates, on any number of threads:
//     tl_nav_world_find_nearest, tl_nav_world_find_path ...    TL_NOT_LOADED: not proven, tiles are missing
//
// The core starts no thread and touches no file: bytes come from the def's callback, and the host decides where loads
// run. Between two updates nothing that queries read changes, so readers never wait; an update is the one moment at
// which tiles are exchanged, a few at a time.
//
// Coordinates. The file's level has its own, in double (the file's FRAM chunk). Tiles in memory are in metres from a
// local frame, in float, whose origin is a place of the grid near the first point of interest. Corners are counted on
// the tiles' lattice, in integers, so they are as exact 10,000 km from the level's origin as at it. When the interest
// moves farther than `frame_reach` from the frame's origin, an update moves the frame: tl_nav_world_state.frames
// counts on, and references and local points of before are stale. Keep points over updates as doubles.
//
// Errors that functions share: those of nav_query.h.

#ifndef TALUS_NAV_WORLD_H
#define TALUS_NAV_WORLD_H

#include <talus/nav_query.h>
#include <talus/pack.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tl_nav_world tl_nav_world;

/// Reads `size` bytes at `offset` of the file. Called by tl_nav_world_create, and by tl_nav_world_run_load on the
/// thread that calls it. Any result but TL_OK ends what is under way: an error is returned by it as it is, anything
/// else, TL_NOT_FOUND for one, as TL_ERR_IO.
typedef tl_result tl_nav_world_read_fn(uint64_t offset, void *bytes, size_t size, void *user);

/// Begin with tl_default_nav_world_def, and set `read`.
typedef struct tl_nav_world_def {
    tl_nav_world_read_fn *read;
    void *user;
    uint64_t budget;               ///< bytes that tiles and their navmesh may take together, >= 65536. Default 64 MiB
    double frame_reach;            ///< metres, > 0: the frame follows an interest that is farther away. Default 4096
    const tl_allocator *allocator; ///< copied; NULL: malloc. Called by the thread that updates alone
    uint32_t cookie;               ///< set by tl_default_nav_world_def
} tl_nav_world_def;

TL_API tl_nav_world_def tl_default_nav_world_def(void);

/// Opens a file of tiles by its index and the heads of its tiles; no tile is loaded yet.
///
/// TL_ERR_ARGUMENT (the report names the field), the errors of tl_pack_index_open and of `read`, TL_NOT_FOUND (the file
/// holds no navmesh), TL_ERR_UNSUPPORTED (it holds links, which are anchored to all tiles at once: load it by
/// tl_pack_load_navmesh), TL_ERR_CORRUPT (a tile lies outside its grid or is there twice), TL_ERR_MEMORY; `*world_out`
/// is NULL then. `report` may be NULL. O(tiles log tiles), one read of 256 bytes a tile.
TL_API tl_result tl_nav_world_create(const tl_nav_world_def *def, tl_nav_world **world_out, tl_report *report);
/// The index of its file, which stays as long as the world: for those who read other chunks than it does.
TL_API const tl_pack_index *tl_nav_world_index(const tl_nav_world *world);
/// Frees it with all its tiles. No load may be running. NULL: nothing happens.
TL_API void tl_nav_world_destroy(tl_nav_world *world);

// ---------------------------------------------------------------------------------------------------------
// Tiles in and out.

/// A point around which tiles are wanted.
typedef struct tl_nav_world_interest {
    double point[3]; ///< in the level's coordinates
    double radius;   ///< metres in the plane, >= 0: tiles that come nearer than this are wanted, the nearest first
} tl_nav_world_interest;

/// Says where tiles are wanted, takes in tiles that were read, and takes out those farthest from all interests where
/// the budget needs room: at most `max_changes` of either. Tiles that nobody wants stay until their room is needed.
///
/// No query may run meanwhile, and no other function on this world but tl_nav_world_run_load. With max_changes 1 it
/// takes the time that one tile does, some 100 us as a rule; where the frame moves, all tiles in memory are exchanged
/// at once. TL_NOT_FOUND: nothing changed. TL_ERR_NOT_FINITE, TL_ERR_ARGUMENT (a negative radius, NULL): nothing
/// changed. TL_ERR_MEMORY: what was wanted is not noted.
TL_API tl_result tl_nav_world_update(tl_nav_world *world, const tl_nav_world_interest *interests, uint32_t count,
                                     uint32_t max_changes);

/// Tiles of one place to be read: filled by tl_nav_world_begin_load.
typedef struct tl_nav_world_load {
    tl_nav_world *world;
    uint32_t place; ///< private
    int32_t tile_x; ///< place in the file's grid
    int32_t tile_z;
    tl_result result;   ///< of tl_nav_world_run_load
    const char *advice; ///< static; what to do about a failure, or NULL
} tl_nav_world_load;

/// The next place to be loaded: the nearest that is wanted, not there, and fits the budget. Its memory is taken now.
/// TL_NOT_FOUND: there is none at the moment. TL_ERR_ARGUMENT, TL_ERR_MEMORY (of the allocator, not of the budget).
/// Called by the thread that updates.
TL_API tl_result tl_nav_world_begin_load(tl_nav_world *world, tl_nav_world_load *load_out);
/// Reads the tiles of a load and checks them: hashes, contents, that they are what the index says. May run on any
/// thread, beside queries, updates and other loads. Returns load->result: those of `read` and of the checks.
TL_API tl_result tl_nav_world_run_load(tl_nav_world_load *load);
/// Hands a load back. The next update takes its tiles in. One that failed is counted in tl_nav_world_state.failed and
/// is tried again when the interests move. TL_ERR_ARGUMENT: NULL, or no load that is under way. Called by the thread
/// that updates.
TL_API tl_result tl_nav_world_end_load(tl_nav_world_load *load);

typedef struct tl_nav_world_state {
    uint32_t places;      ///< places of the grid that have tiles, in the file
    uint32_t loaded;      ///< in memory, as queries see them
    uint32_t loading;     ///< begun, not handed back
    uint32_t ready;       ///< read, waiting for an update
    uint32_t missing;     ///< wanted and neither loaded nor on their way
    uint32_t failed;      ///< wanted, and could not be loaded
    uint32_t frames;      ///< frames so far, 1 at the first update
    uint64_t bytes;       ///< of the budget, now
    uint64_t peak_bytes;  ///< the most so far
    uint64_t index_bytes; ///< of the index, which the budget does not count
    uint64_t read_bytes;  ///< of the file, for tiles, so far
} tl_nav_world_state;

TL_API tl_result tl_nav_world_get_state(const tl_nav_world *world, tl_nav_world_state *state_out);

// ---------------------------------------------------------------------------------------------------------
// Coordinates.

/// A point of the level in the local frame of now, and back. The difference is taken in double.
TL_API tl_vec3 tl_nav_world_place_in(const tl_nav_world *world, const double point[3]);
TL_API void tl_nav_world_place_out(const tl_nav_world *world, tl_vec3 point, double out[3]);

/// The tiles in memory, in the local frame, for all queries that are not here. What they answer is that of the whole
/// world where tl_nav_world_covers says so. Changes with each update; never change it yourself.
TL_API const tl_navmesh *tl_nav_world_navmesh(const tl_nav_world *world);

/// Whether all tiles that a circle in the plane touches are in memory: TL_OK or TL_NOT_LOADED. TL_ERR_NOT_FINITE,
/// TL_ERR_ARGUMENT (a negative radius, NULL).
TL_API tl_result tl_nav_world_covers(const tl_nav_world *world, const double center[3], double radius);

// ---------------------------------------------------------------------------------------------------------
// Queries. Their locations and points are local ones.

/// tl_navmesh_find_nearest at a point of the level. `half_extents` turns with the level's axes.
///
/// TL_NOT_LOADED: a tile that is not in memory reaches into the box, and no nearer than it is what was found, which is
/// written; TL_NAV_NO_REF where nothing was. So TL_OK and TL_NOT_FOUND are the answers of the whole world.
TL_API tl_result tl_nav_world_find_nearest(const tl_nav_world *world, const tl_nav_filter *filter,
                                           const double point[3], tl_vec3 half_extents, tl_nav_location *location_out);

/// tl_nav_query_find_shortest_path over the tiles in memory, and whether that is the answer of the whole world.
///
/// A path over tiles that are not in memory leaves through an edge to one, on the start's island, and comes back
/// through one on the goal's. No such edges: what was found is proven. Else each costs at least the straight lengths
/// from start to edge to goal; where that is no shorter for any than the path found, the path is proven. TL_OK:
/// path_out->status holds for the whole world. TL_NOT_LOADED: TL_NAV_PATH_COMPLETE is then a path, with its corners,
/// and path_out->lower_bound says how much shorter another one may be; TL_NAV_PATH_UNFINISHED: none over what is there,
/// and lower_bound holds. TL_NAV_PATH_OUT_OF_NODES: as in memory. Other results as of that function.
TL_API tl_result tl_nav_world_find_path(const tl_nav_world *world, tl_nav_query *query,
                                        const tl_nav_path_request *request, const tl_nav_path_buffers *buffers,
                                        tl_nav_shortest_path *path_out);

/// tl_navmesh_cast_ray towards a point of the level. TL_NOT_LOADED: the ray reached an edge behind which lies a tile
/// that is not in memory, and the hit says where; it may go on there.
TL_API tl_result tl_nav_world_cast_ray(const tl_nav_world *world, const tl_nav_filter *filter,
                                       const tl_nav_location *start, const double end[3], tl_nav_ray_hit *hit_out);

#ifdef __cplusplus
}
#endif

#endif
