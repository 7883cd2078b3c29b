// SPDX-License-Identifier: MIT
//
// The surface of a polygon that has no detail of its own: a fan from its first corner.

#ifndef TALUS_SRC_NAV_FORMAT_TRIANGLE_FAN_H
#define TALUS_SRC_NAV_FORMAT_TRIANGLE_FAN_H

#include <talus/nav_tile.h>

/// Triangle i, in [0, corner_count - 2), of the fan over corner_count corners.
static inline tl_nav_detail_triangle tl_nav_fan_triangle(uint32_t i, uint32_t corner_count)
{
    // Edge 1 is always on the outline, the first triangle's edge 0 and the last one's edge 2 are too.
    uint32_t outline = 2u | (i == 0 ? 1u : 0u) | (i + 3 == corner_count ? 4u : 0u);
    tl_nav_detail_triangle triangle = { { 0, (uint16_t)(i + 1), (uint16_t)(i + 2) }, (uint16_t)outline };
    return triangle;
}

#endif
