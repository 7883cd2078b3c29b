// SPDX-License-Identifier: MIT
//
// Which cells of a grid a hull holds or touches, row by row.

#ifndef TALUS_SRC_DECOMPOSE_HULL_ROWS_H
#define TALUS_SRC_DECOMPOSE_HULL_ROWS_H

#include "decompose/distance_grid.h"

/// A plane of a hull as a bound along x: x <= c + a y + b z, or >=; metres.
typedef struct tl_row_plane {
    double a, b, c;
    double wider; ///< by so much the bound is wider for a cube that only touches
} tl_row_plane;

typedef struct tl_hull_rows {
    const tl_distance_grid *grid;
    uint32_t low[3], high[3]; ///< cells of the hull's box
    tl_row_plane *planes;     ///< [plane_count]: upper bounds, lower bounds, then planes along x
    uint32_t upper_end, lower_end, plane_count;
} tl_hull_rows;

/// Cells of one row, by their index along x; none: first > last.
typedef struct tl_cell_run {
    int32_t first, last;               ///< may touch the hull
    int32_t first_inside, last_inside; ///< their centre lies in the hull
} tl_cell_run;

/// `planes` is the arena's. TL_ERR_MEMORY.
tl_result tl_hull_rows_make(const tl_hull *hull, const tl_distance_grid *grid, tl_arena *arena, tl_hull_rows *rows);

/// The cells of row (y, z). O(faces).
tl_cell_run tl_hull_rows_run(const tl_hull_rows *rows, uint32_t y, uint32_t z);

#endif
