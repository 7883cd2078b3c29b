// SPDX-License-Identifier: MIT
//
// A baked tile of a job: the layers of one place, in a file named after its key.
//
// Layout, little-endian: 0 magic "TLWTILE\n"; 8 u32 version; 12 u32 layers; 16 u64 key twice; 32 u32 x; 36 u32 z;
// 40 u64 size of the file; 48 u64 checksum of all behind byte 64; 56 u64 checksum of bytes 0 to 55. Then the sizes of
// the layers, u64 each, padded to 64 bytes; then the layers, blobs in the file's byte order, whose sizes are multiples
// of 64. A place where nothing is walkable has a file of no layers.

#ifndef TALUS_WORLD_TILE_FILE_H
#define TALUS_WORLD_TILE_FILE_H

#include "io/files/file_map.h"
#include "world/job/plan_file.h"

#include <talus/pack.h>

#define TL_WORLD_TILE_MAGIC   "TLWTILE\n"
#define TL_WORLD_TILE_VERSION 1u

enum { TL_WORLD_TILE_HEADER = 64 };

/// Writes a tile beside its place, then renames it: it is whole or absent.
tl_result tl_world_tile_write(const char *path, const tl_world_tile *tile, const tl_nav_tile_stack *stack,
                              tl_io_error *error_out);

/// Whether the tile's file is there, by its header and its size: what a new run skips. A file that is there and is not
/// right counts as missing.
bool tl_world_tile_is_there(const char *path, const tl_world_tile *tile);

/// The layers of a tile's file. They lie in `map`.
typedef struct tl_world_layers {
    tl_file_map map;
    tl_pack_entry *entries;    ///< [count], as a baked file is to list them: NAVT, with the layer's number as id
    const tl_nav_tile **tiles; ///< [count], in the file's byte order until tl_world_layers_check
    uint32_t count;
} tl_world_layers;

/// Reads a tile's file. `hashed`: the entries are filled; else they have sizes alone. TL_ERR_IO, TL_ERR_MAGIC,
/// TL_ERR_VERSION, TL_ERR_TRUNCATED, TL_ERR_HASH, TL_ERR_CORRUPT, TL_ERR_MEMORY. On failure `*layers_out` is zeroed.
/// Free with tl_world_layers_free.
tl_result tl_world_tile_read(const char *path, const tl_world_tile *tile, bool hashed, tl_world_layers *layers_out,
                             tl_io_error *error_out);
/// Turns the layers to the machine's byte order, and proves each a sound tile of that place. TL_ERR_CORRUPT, and those
/// of tl_nav_tile_check; the layers are of no use then.
tl_result tl_world_layers_check(tl_world_layers *layers, const char *path, const tl_world_tile *tile,
                                tl_io_error *error_out);
void tl_world_layers_free(tl_world_layers *layers);

#endif
