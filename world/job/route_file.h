// SPDX-License-Identifier: MIT
//
// Routes of a merged file: baked and put into it.

#ifndef TALUS_WORLD_ROUTE_FILE_H
#define TALUS_WORLD_ROUTE_FILE_H

#include "world/job/world_reader.h"

#include <talus/nav_routes.h>

typedef struct tl_world_routes_def {
    const char *input, *output; ///< paths of a merged file and of the one with routes; may be the same
    uint32_t block;             ///< of tl_nav_routes_def; 0: its default
    tl_host host;               ///< its progress is used
} tl_world_routes_def;

typedef struct tl_world_routes_report {
    uint64_t gates, lengths;
    uint64_t route_bytes, bytes; ///< of the chunk, of the file
    uint64_t tiles;
} tl_world_routes_report;

/// Writes a merged file again with its routes, in place of those that it had. The same input gives the same bytes.
tl_result tl_world_add_routes(const tl_world_routes_def *def, tl_world_routes_report *report_out,
                              tl_io_error *error_out);

#endif
