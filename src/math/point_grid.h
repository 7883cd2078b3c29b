// SPDX-License-Identifier: MIT
//
// A hash grid of points that were kept, with cells as wide as a distance, to find those within the distance of a point.
//
// Where kept points lie more than the distance apart, as in greedy welding, a cell holds a bounded number of them and a
// look-up is O(1). Rejected: sorting along an axis, quadratic on a flat wall.

#ifndef TALUS_SRC_MATH_POINT_GRID_H
#define TALUS_SRC_MATH_POINT_GRID_H

#include "base/exact_floats.h"
#include "base/hash.h"

#include <talus/vec.h>

#include <math.h>
#include <string.h>

#define TL_POINT_GRID_NONE UINT32_MAX

typedef struct tl_point_grid {
    double distance;
    uint32_t *slots; // [mask + 1] the newest kept point of the slot
    uint32_t *next;  // [number of points] the kept one before it
    uint32_t mask;
} tl_point_grid;

// Slots for so many points, below 2^31: at most half full.
static inline uint32_t tl_point_grid_slots(uint32_t count)
{
    uint32_t size = 16;
    while (size / 2 < count && size < 0x80000000u) {
        size *= 2;
    }
    return size;
}

static inline tl_point_grid tl_point_grid_make(double distance, uint32_t *slots, uint32_t slot_count, uint32_t *next)
{
    tl_point_grid grid = { distance, slots, next, slot_count - 1 };
    memset(slots, 0xff, (size_t)slot_count * sizeof *slots);
    return grid;
}

// Cells are numbered in double: where a coordinate is so large that cell numbers lose their last bits, distinct floats
// are farther apart than the distance anyway, and equal ones still get the same number.
typedef struct tl_point_cell {
    double x, y, z;
} tl_point_cell;

static inline tl_point_cell tl_point_grid_cell(const tl_point_grid *grid, tl_vec3 p)
{
    tl_point_cell cell = { floor((double)p.x / grid->distance), floor((double)p.y / grid->distance),
                           floor((double)p.z / grid->distance) };
    return cell;
}

static inline uint64_t tl_point_grid_hash(double number, uint64_t hash)
{
    const double without_sign_of_zero = number + 0.0;
    uint64_t bits;
    memcpy(&bits, &without_sign_of_zero, sizeof bits);
    return tl_hash_mix(hash ^ bits);
}

// Slot `around` of the 27 of a cell and those around it; 13 is its own.
static inline uint32_t tl_point_grid_slot(const tl_point_grid *grid, tl_point_cell cell, int around)
{
    uint64_t hash = tl_point_grid_hash(cell.x + (around % 3 - 1), 0);
    hash = tl_point_grid_hash(cell.y + (around / 3 % 3 - 1), hash);
    hash = tl_point_grid_hash(cell.z + (around / 9 - 1), hash);
    return (uint32_t)hash & grid->mask;
}

static inline void tl_point_grid_keep(tl_point_grid *grid, tl_point_cell cell, uint32_t index)
{
    const uint32_t slot = tl_point_grid_slot(grid, cell, 13);
    grid->next[index] = grid->slots[slot];
    grid->slots[slot] = index;
}

static inline bool tl_points_are_within(tl_vec3 a, tl_vec3 b, double distance)
{
    const double x = (double)a.x - (double)b.x, y = (double)a.y - (double)b.y, z = (double)a.z - (double)b.z;
    return x * x + y * y + z * z <= distance * distance;
}

#endif
