// SPDX-License-Identifier: MIT
//
// The tiles of a job in one baked file, and the check of such a file.

#ifndef TALUS_WORLD_MERGE_TILES_H
#define TALUS_WORLD_MERGE_TILES_H

#include "world/job/bake_tiles.h"

typedef struct tl_world_merge_report {
    uint64_t places, tiles;    ///< places of the plan, tiles (layers) in the file
    uint64_t missing, damaged; ///< places without a sound file
    uint64_t polygons, bytes;
    double area; ///< square metres
} tl_world_merge_report;

typedef struct tl_world_merge_def {
    const char *job, *output;                           ///< paths
    bool as_planned;                                    ///< do not look whether the inputs changed since the plan
    tl_host host;                                       ///< its progress is used
    void (*fail)(const tl_io_error *error, void *user); ///< told of each damaged tile
    void *user;
} tl_world_merge_def;

/// Checks every tile of the plan and writes them as `talus bake --tile-size` would: META, FRAM where the origin is not
/// 0, NAVM, and the tiles by z, x and layer. Nothing is written unless all are there: TL_NOT_FOUND names the first that
/// is missing, and damaged ones are taken away, so that the next bake makes them again.
tl_result tl_world_merge(const tl_world_merge_def *def, tl_world_merge_report *report_out, tl_io_error *error_out);

typedef struct tl_world_check_report {
    uint64_t tiles, polygons, links; ///< links: portals over which tiles are joined
    uint32_t tiles_x, tiles_z;
    double area;
} tl_world_check_report;

/// Checks a merged file: container, every tile, that no place and layer is there twice, that all share one lattice and
/// lie in its grid, and that the number of tiles is what the file says. TL_ERR_CORRUPT and others name what is wrong.
tl_result tl_world_check(const char *path, tl_world_check_report *report_out, tl_io_error *error_out);

#endif
