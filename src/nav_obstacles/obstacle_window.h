// SPDX-License-Identifier: MIT
//
// Where the columns and floors of a field are in the world, and which columns an obstacle can reach.

#ifndef TALUS_SRC_NAV_OBSTACLES_OBSTACLE_WINDOW_H
#define TALUS_SRC_NAV_OBSTACLES_OBSTACLE_WINDOW_H

#include "math/column_range.h"

#include <math.h>
#include <talus/nav_bake.h>

/// Columns [first_x, end_x) x [first_z, end_z) of a field.
typedef struct tl_obstacle_window {
    uint32_t first_x, end_x, first_z, end_z;
} tl_obstacle_window;

static inline bool tl_obstacle_window_is_empty(const tl_obstacle_window *window)
{
    return window->first_x >= window->end_x || window->first_z >= window->end_z;
}

/// Columns whose centres can lie in [min - cell, max + cell], metres.
static inline void tl_window_along(tl_column_axis axis, float min, float max, uint32_t *first, uint32_t *end)
{
    const double low = floor(tl_column_of_center(&axis, min - axis.cell_size));
    const double high = ceil(tl_column_of_center(&axis, max + axis.cell_size)) + 1.0;
    tl_clamp_columns(&axis, low, high, first, end);
}

/// The columns within a cell of a box, and perhaps one more on each side.
static inline tl_obstacle_window tl_obstacle_window_make(const tl_nav_compact *compact, tl_aabb box)
{
    const tl_nav_lattice *lattice = &compact->lattice;
    const tl_column_axis x = { lattice->origin.x, compact->cell_size, lattice->first_x, compact->width };
    const tl_column_axis z = { lattice->origin.z, compact->cell_size, lattice->first_z, compact->height };
    tl_obstacle_window window;
    tl_window_along(x, box.min.x, box.max.x, &window.first_x, &window.end_x);
    tl_window_along(z, box.min.z, box.max.z, &window.first_z, &window.end_z);
    return window;
}

/// Metres: of a column's centre. The number of a column in the level's lattice decides, so tiles agree to the bit.
static inline double tl_column_center_x(const tl_nav_compact *compact, uint32_t x)
{
    return (double)compact->lattice.origin.x +
           ((double)compact->lattice.first_x + (double)x + 0.5) * (double)compact->cell_size;
}

static inline double tl_column_center_z(const tl_nav_compact *compact, uint32_t z)
{
    return (double)compact->lattice.origin.z +
           ((double)compact->lattice.first_z + (double)z + 0.5) * (double)compact->cell_size;
}

/// Metres: where the agent's foot is on a floor.
static inline double tl_floor_height(const tl_nav_compact *compact, uint32_t floor)
{
    return (double)compact->lattice.origin.y + (double)compact->floor[floor] * (double)compact->cell_height;
}

/// The smallest range that floats can name around [low, high].
static inline void tl_round_outward(double low, double high, float *min, float *max)
{
    *min = nextafterf((float)low, -INFINITY);
    *max = nextafterf((float)high, INFINITY);
}

#endif
