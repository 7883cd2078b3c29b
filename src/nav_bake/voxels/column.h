// SPDX-License-Identifier: MIT
//
// Steps from a column to the ones beside it, and the free space above a span.

#ifndef TALUS_SRC_NAV_BAKE_COLUMN_H
#define TALUS_SRC_NAV_BAKE_COLUMN_H

#include <talus/nav_bake.h>

/// The ceiling of a span with nothing above it, voxels: more than any floor plus any agent's height.
#define TL_NAV_OPEN_SKY 0x1ffffu

/// Direction d steps (tl_nav_step_x[d], tl_nav_step_z[d]), as in tl_nav_compact.
static const int8_t tl_nav_step_x[4] = { -1, 0, 1, 0 };
static const int8_t tl_nav_step_z[4] = { 0, 1, 0, -1 };

/// What to add to a column's index to step in a direction; wraps around as unsigned arithmetic does.
static inline uint32_t tl_nav_column_step(uint32_t width, uint32_t direction)
{
    return (uint32_t)tl_nav_step_x[direction] + (uint32_t)tl_nav_step_z[direction] * width;
}

/// Where the free space above span i ends; `end` is one past the column's last span.
static inline uint32_t tl_nav_ceiling(const tl_nav_span *spans, uint32_t i, uint32_t end)
{
    return i + 1 < end ? spans[i + 1].min : TL_NAV_OPEN_SKY;
}

#endif
