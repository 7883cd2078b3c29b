// SPDX-License-Identifier: MIT
//
// Exact predicates of polygons on the lattice.

#include "nav_format/lattice_polygon.h"

#include "base/exact_floats.h"

#include <string.h>

void tl_nav_gather_polygon(const int32_t *vertices, const uint32_t *corners, uint32_t count,
                           tl_nav_lattice_polygon *polygon_out)
{
    for (uint32_t i = 0; i < count; i++) {
        memcpy(polygon_out->points + 3 * (size_t)i, vertices + 3 * (size_t)corners[i], 3 * sizeof *vertices);
    }
    polygon_out->count = count;
}

void tl_nav_gather_tile_polygon(const tl_nav_tile *tile, uint32_t polygon, tl_nav_lattice_polygon *polygon_out)
{
    const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, polygon);
    polygon_out->count = corners.end - corners.begin;
    for (uint32_t i = 0; i < polygon_out->count; i++) {
        const tl_nav_lattice_point point = tl_nav_tile_vertex(tile, tl_nav_tile_corner_vertex(tile, corners.begin + i));
        memcpy(polygon_out->points + 3 * (size_t)i, point.at, sizeof point.at);
    }
}

bool tl_nav_is_convex(const tl_nav_lattice_polygon *polygon)
{
    // Every corner against every edge: right turns alone would let a pentagram pass.
    for (uint32_t i = 0; i < polygon->count; i++) {
        const int32_t *a = polygon->points + 3 * (size_t)i;
        const int32_t *b = polygon->points + 3 * (size_t)(i + 1 < polygon->count ? i + 1 : 0);
        if (a[0] == b[0] && a[2] == b[2]) {
            return false;
        }
        for (uint32_t k = 0; k < polygon->count; k++) {
            if (tl_nav_area2(a, b, polygon->points + 3 * (size_t)k) > 0) {
                return false;
            }
        }
    }
    return true;
}

int64_t tl_nav_double_area(const tl_nav_lattice_polygon *polygon)
{
    const int32_t *points = polygon->points;
    int64_t sum = 0;
    for (uint32_t i = 1; i + 1 < polygon->count; i++) {
        sum -= tl_nav_area2(points, points + 3 * (size_t)i, points + 3 * (size_t)(i + 1));
    }
    return sum;
}

// Inside is where area2 < 0: with the tile on its left hand an edge on side 0 (x = 0) runs towards z+, and so on.
bool tl_nav_on_side(const int32_t *a, const int32_t *b, uint32_t side, uint32_t tile_size)
{
    int64_t size = tile_size;
    switch (side) {
    case 0:
        return a[0] == 0 && b[0] == 0 && a[2] < b[2];
    case 1:
        return a[2] == size && b[2] == size && a[0] < b[0];
    case 2:
        return a[0] == size && b[0] == size && a[2] > b[2];
    default:
        return a[2] == 0 && b[2] == 0 && a[0] > b[0];
    }
}
