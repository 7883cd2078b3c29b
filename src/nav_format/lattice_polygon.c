// SPDX-License-Identifier: MIT
//
// Exact predicates of polygons on the lattice.

#include "nav_format/lattice_polygon.h"

#include "base/exact_floats.h"

bool tl_nav_is_convex(const int32_t *vertices, const uint32_t *corners, uint32_t count)
{
    // Every corner against every edge: right turns alone would let a pentagram pass.
    for (uint32_t i = 0; i < count; i++) {
        const int32_t *a = vertices + 3 * (size_t)corners[i];
        const int32_t *b = vertices + 3 * (size_t)corners[i + 1 < count ? i + 1 : 0];
        if (a[0] == b[0] && a[2] == b[2]) {
            return false;
        }
        for (uint32_t k = 0; k < count; k++) {
            if (tl_nav_area2(a, b, vertices + 3 * (size_t)corners[k]) > 0) {
                return false;
            }
        }
    }
    return true;
}

int64_t tl_nav_double_area(const int32_t *vertices, const uint32_t *corners, uint32_t count)
{
    const int32_t *apex = vertices + 3 * (size_t)corners[0];
    int64_t sum = 0;
    for (uint32_t i = 1; i + 1 < count; i++) {
        sum -= tl_nav_area2(apex, vertices + 3 * (size_t)corners[i], vertices + 3 * (size_t)corners[i + 1]);
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
