// SPDX-License-Identifier: MIT
//
// The triangles of an input, placed, into segments of the store.

#ifndef TALUS_WORLD_READ_INPUT_H
#define TALUS_WORLD_READ_INPUT_H

#include "world/bytes/content_hash.h"
#include "world/bytes/folder.h"
#include "world/input/input_list.h"
#include "world/store/segment_builder.h"

/// How inputs become segments.
typedef struct tl_world_storing {
    const char *folder; ///< of the store
    double cell_size;   ///< metres
    uint64_t memory;    ///< bytes for the segment in the making
} tl_world_storing;

/// What the store has of an input.
typedef struct tl_world_stored {
    char *path;           ///< of the input, from the root on
    tl_file_facts facts;  ///< when it was read
    tl_content_hash name; ///< of its segments: of the path, facts, place and areas
    uint32_t segments;
    uint64_t triangles; ///< of the input, those without area included
    uint64_t degenerate;
    uint64_t vertices;
    bool was_there; ///< nothing had to be read
} tl_world_stored;

/// Sees to it that the segments of an input are in the store: those that are there already are kept, what is missing is
/// read. `host` may be NULL; its progress is used. TL_ERR_STALE: the file changed while it was read. Errors else as
/// tl_import_mesh. `stored_out->path` is freed with free().
tl_result tl_world_store_input(const tl_world_input *input, const tl_world_storing *storing, const tl_host *host,
                               tl_world_stored *stored_out, tl_io_error *error_out);

/// "<folder>/<name>", freed with free(); NULL: out of memory.
char *tl_world_segment_stem(const char *folder, tl_content_hash name);

/// Reads a binary STL in pieces, from the triangle that the builder wants next. TL_NOT_FOUND: the file is none.
tl_result tl_world_stl_read(const tl_world_input *input, uint64_t first, const tl_host *host, tl_world_builder *builder,
                            uint64_t *count_out, tl_io_error *error_out);

/// Gives a triangle of an input to the builder: `corners` are in metres, y up, counted from `origin`.
tl_result tl_world_place_triangle(const tl_world_input *input, const tl_vec3 corners[3], const double origin[3],
                                  uint8_t area, tl_world_builder *builder, tl_io_error *error_out);

#endif
