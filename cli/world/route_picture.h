// SPDX-License-Identifier: MIT
//
// A route as a picture: the walkable ground around it, by its height, and the way over it.

#ifndef TALUS_CLI_ROUTE_PICTURE_H
#define TALUS_CLI_ROUTE_PICTURE_H

#include "world/job/world_reader.h"

#include <talus/nav_routes.h>

typedef struct tl_route_picture {
    tl_world_reader *reader;    ///< of a merged file
    const tl_pack_index *index; ///< of that
    const char *output;         ///< .png or .svg
    const tl_nav_world_route_point *points;
    const tl_nav_world_route *route; ///< complete
    uint32_t size;                   ///< pixels along the longer side of the map
} tl_route_picture;

/// Reads the file's tiles one at a time: memory is that of the picture, its index and a tile.
tl_result tl_draw_world_route(const tl_route_picture *picture, tl_io_error *error_out);

#endif
