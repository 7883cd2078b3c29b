// SPDX-License-Identifier: MIT
//
// A route as a picture: the walkable ground around it, by its height, and the way over it.

#ifndef TALUS_CLI_ROUTE_PICTURE_H
#define TALUS_CLI_ROUTE_PICTURE_H

#include "io/files/io_error.h"

#include <talus/nav_routes.h>

typedef struct tl_route_picture {
    const char *file, *output; ///< a merged file; .png or .svg
    const tl_nav_world_route_point *points;
    const tl_nav_world_route *route; ///< complete
    uint32_t size;                   ///< pixels along the longer side of the map
} tl_route_picture;

/// Reads the file's tiles one at a time: memory is that of the picture, its index and a tile.
tl_result tl_draw_world_route(const tl_route_picture *picture, tl_io_error *error_out);

#endif
