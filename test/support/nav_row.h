// SPDX-License-Identifier: MIT
//
// A tile of one row of strips: beside another one, of a single polygon or of many, it makes a hub.

#ifndef TALUS_TEST_NAV_ROW_H
#define TALUS_TEST_NAV_ROW_H

#include <talus/talus.h>

#include <stdlib.h>
#include <string.h>

/// `count` strips that run along x, each `length` long, side by side to z = `length`: each with a portal at one end, at
/// its last x in the tile at tile_x 0, at its first in that at 1. NULL where it cannot be made.
static inline tl_nav_tile *nav_row_tile(uint32_t count, uint32_t length, int32_t tile_x)
{
    int32_t *vertices = calloc(6 * ((size_t)count + 1), sizeof *vertices);
    uint32_t *numbers = calloc(11 * (size_t)count + 1, sizeof *numbers);
    uint32_t *first = numbers, *indices = first + count + 1, *neighbours = indices + 4 * (size_t)count;
    uint32_t *areas = neighbours + 4 * (size_t)count, *zeros = areas + count;
    for (uint32_t i = 0; i <= count; i++) {
        int32_t *at = vertices + 6 * (size_t)i;
        at[2] = at[5] = (int32_t)(i * (length / count));
        at[3] = (int32_t)length;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t corners[4] = { 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1 };
        const uint32_t across[4] = { tile_x == 1 ? TL_PORTAL | 0u : TL_NO_POLYGON, TL_NO_POLYGON,
                                     tile_x == 0 ? TL_PORTAL | 2u : TL_NO_POLYGON, TL_NO_POLYGON };
        memcpy(indices + 4 * (size_t)i, corners, sizeof corners);
        memcpy(neighbours + 4 * (size_t)i, across, sizeof across);
        first[i + 1] = 4 * (i + 1);
        areas[i] = 63;
    }
    tl_polygon_mesh mesh = { .vertex_count = 2 * (count + 1),
                             .polygon_count = count,
                             .index_count = 4 * count,
                             .vertices = vertices,
                             .first = first,
                             .indices = indices,
                             .neighbours = neighbours,
                             .areas = areas,
                             .regions = zeros,
                             .contours = zeros,
                             .cell_size = 1.0f,
                             .cell_height = 1.0f };
    mesh.bounds.min.x = (float)tile_x * (float)length;
    const tl_nav_tile_source source = {
        .polygons = &mesh, .tile_size = length, .tile_x = tile_x, .agent_height = 2.0f, .agent_max_climb = 1.0f
    };
    tl_nav_tile *tile = NULL;
    const tl_result result = tl_nav_tile_encode(&source, NULL, &tile, NULL);
    free(vertices);
    free(numbers);
    return result == TL_OK ? tile : NULL;
}

#endif
