// SPDX-License-Identifier: MIT
//
// The agents nearest to one, rim to rim (crowd_neighbors.c).

#ifndef TALUS_SRC_NAV_CROWD_CROWD_NEIGHBORS_H
#define TALUS_SRC_NAV_CROWD_CROWD_NEIGHBORS_H

#include "nav_crowd/crowd.h"

#include <math.h>

/// Where a coordinate is in a grid.
typedef struct crowd_cell_place {
    int32_t cell; ///< cells beyond 2^30 fall together with others
    float in;     ///< metres from the cell's begin
} crowd_cell_place;

/// floor, which is a call where the processor need not have it.
static inline double tl_crowd_floor(double value)
{
    if (!(fabs(value) < 0x1p52)) {
        return value; // whole
    }
    const double whole = (double)(int64_t)value;
    return whole > value ? whole - 1.0 : whole;
}

static inline crowd_cell_place tl_crowd_place_in_grid(float at, float cell_size)
{
    const double cell = tl_crowd_floor((double)at / (double)cell_size);
    const crowd_cell_place place = { (int32_t)(cell - tl_crowd_floor(cell * 0x1p-30) * 0x1p30),
                                     (float)((double)at - cell * (double)cell_size) };
    return place;
}

/// The nearest neighbours of the agent at `k` of the snapshot, the nearest first; returns how many there are, at most
/// the def's max_neighbors. Agents whose heights do not overlap are none.
uint32_t tl_crowd_find_neighbors(const tl_nav_crowd *crowd, uint32_t k, crowd_neighbor *neighbors_out);

/// Whether two agents have one goal: so near that they cannot both stand at theirs.
bool tl_crowd_has_goal_of(const tl_nav_crowd *crowd, uint32_t i, uint32_t other);

#endif
