// SPDX-License-Identifier: MIT
//
// What reading a set and reading a tile share.

#ifndef TALUS_SRC_NAV_FORMAT_DETOUR_READ_H
#define TALUS_SRC_NAV_FORMAT_DETOUR_READ_H

#include "nav_format/detour_layout.h"

#include <math.h>

// How far a corner may lie from its lattice point. Recast computes corners in floats, whose steps are below a hundredth
// of a cell wherever a navmesh makes sense; a mesh that was not made on a lattice is off by up to half a cell.
#define TL_DETOUR_ON_LATTICE 0.05 // cells

// One tile's bytes, and where it lies in the grid.
typedef struct tl_detour_tile_bytes {
    const uint8_t *bytes;
    tl_detour_header header;
    tl_detour_offsets at;
    tl_vec3 origin;     // of the grid
    uint32_t tile_size; // cells; 0: the only tile
} tl_detour_tile_bytes;

// The lattice step nearest to a coordinate, and how far off it is.
static inline int32_t tl_detour_nearest_step(double along, double *off)
{
    double rounded = floor(along + 0.5);
    *off = fabs(along - rounded);
    return fabs(rounded) <= (double)TL_MAX_CONTOUR_COORDINATE ? (int32_t)rounded : INT32_MAX;
}

static inline bool tl_detour_is_finite(const float v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/// Detour's data in this machine's byte order: the caller's own bytes, or a copy that was turned round.
typedef struct tl_detour_bytes {
    const uint8_t *bytes;
    uint8_t *copy; // NULL: none was needed
    uint64_t copy_size;
    tl_allocator allocator;
} tl_detour_bytes;

/// Closed with tl_detour_close_bytes, after a failure too. TL_ERR_MEMORY.
tl_result tl_detour_open_bytes(const void *bytes, uint64_t size, const tl_allocator *allocator,
                               tl_detour_bytes *open_out);
void tl_detour_close_bytes(tl_detour_bytes *open);

/// Turns a set or a tile round in place. `to_host`: the bytes have the order that this machine has not; false: the
/// other way. False: a count does not fit the size.
bool tl_detour_swap(uint8_t *bytes, uint64_t size, bool to_host);

/// Takes a tile's header apart and checks every count of it against the size. The place in the grid is left alone.
tl_result tl_detour_open_tile(const uint8_t *bytes, uint64_t size, tl_detour_tile_bytes *tile,
                              tl_detour_report *report);

/// Bakes an open tile; counts add to `report`.
tl_result tl_detour_read_tile(const tl_detour_tile_bytes *tile, const tl_detour_read_def *def, tl_detour_report *report,
                              tl_nav_tile **tile_out);

#endif
