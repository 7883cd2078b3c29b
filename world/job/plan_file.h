// SPDX-License-Identifier: MIT
//
// The plan of a job: settings, inputs and tiles, in one file that is replaced as a whole. Shards read nothing else but
// the store.
//
// Layout, little-endian: magic "TLWPLAN\n", u32 version, u32 zero, u64 size of the file; the grid
// (TL_WORLD_GRID_BYTES); u64 source vertices, triangles, degenerate ones; f32 bounds of the triangles, 6; the world's
// name, as u32 length and bytes; u32 number of inputs, and each: path (u32 length, bytes), u64 size, u64 changed, u64
// name of its segments twice, u32 segments, u64 triangles; u64 number of tiles, and each 32 bytes: u32 x, u32 z, u32
// triangles, u32 cost, u64 key twice; the checksum of all before it, u64.

#ifndef TALUS_WORLD_PLAN_FILE_H
#define TALUS_WORLD_PLAN_FILE_H

#include "world/input/read_input.h"
#include "world/job/tile_grid.h"

#define TL_WORLD_PLAN_MAGIC   "TLWPLAN\n"
#define TL_WORLD_PLAN_VERSION 1u

enum { TL_WORLD_GRID_BYTES = 160 };

/// A tile that holds triangles, or whose border does.
typedef struct tl_world_tile {
    uint32_t x, z;
    uint32_t triangles; ///< in its window
    uint32_t cost;      ///< estimated, in the time that about a column takes
    tl_content_hash key;
} tl_world_tile;

typedef struct tl_world_plan {
    tl_world_grid grid;
    char *name;                               ///< of the world: the input's last part
    uint64_t vertices, triangles, degenerate; ///< of all inputs
    tl_aabb bounds;                           ///< metres from the grid's origin, of the triangles with area
    tl_world_stored *inputs;                  ///< [input_count]; was_there, degenerate and vertices are not kept
    uint32_t input_count;
    tl_world_tile *tiles; ///< [tile_count] by z, then x
    uint64_t tile_count;
} tl_world_plan;

/// A name of all that a tile's bytes depend on, but its triangles.
tl_content_hash tl_world_grid_hash(const tl_world_grid *grid);

tl_result tl_world_plan_write(const tl_world_plan *plan, const char *path, tl_io_error *error_out);
/// Reads and checks a plan: all counts and places in it hold. Errors: TL_ERR_IO, TL_ERR_MAGIC, TL_ERR_VERSION,
/// TL_ERR_TRUNCATED, TL_ERR_HASH, TL_ERR_CORRUPT, TL_ERR_MEMORY. Free with tl_world_plan_free in any case.
tl_result tl_world_plan_read(const char *path, tl_world_plan *plan_out, tl_io_error *error_out);
/// The same of bytes; `path` is for messages.
tl_result tl_world_plan_decode(const unsigned char *bytes, size_t size, const char *path, tl_world_plan *plan_out,
                               tl_io_error *error_out);
void tl_world_plan_free(tl_world_plan *plan);

/// The first tile of a plan that does not come before (x, z); tile_count: there is none.
uint64_t tl_world_plan_find(const tl_world_plan *plan, uint32_t x, uint32_t z);

/// The key of a tile's file: the settings (tl_world_grid_hash), the place, and the sum of its triangles' hashes.
tl_content_hash tl_world_tile_key(tl_content_hash settings, const tl_world_tile *tile, tl_content_hash sum);

/// "<job>/<part>", freed with free(); NULL: out of memory.
char *tl_world_job_path(const char *job, const char *part);
/// "<job>/tiles/ab/abcd....tile".
char *tl_world_tile_path(const char *job, tl_content_hash key);

#endif
