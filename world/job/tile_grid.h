// SPDX-License-Identifier: MIT
//
// Which tiles a triangle can touch: the one rule by which plan, bake and balance count.
//
// A tile's bake reads the columns of the tile, of its border, and one more on each side; the rule takes two more than
// the border, so that rounding of coordinates to floats cannot matter.

#ifndef TALUS_WORLD_TILE_GRID_H
#define TALUS_WORLD_TILE_GRID_H

#include "io/files/io_error.h"
#include "world/store/segment_file.h"

#include <talus/nav_bake.h>

typedef struct tl_world_grid {
    tl_nav_def def;   ///< with bounds, from `origin` on; its host is empty
    double origin[3]; ///< metres in the world: what is baked counts from here
    double cell_size; ///< of the store's cells, metres
    uint32_t tiles_x, tiles_z;
    double margin; ///< columns
} tl_world_grid;

/// Checks the settings. TL_ERR_ARGUMENT and others of tl_nav_config_from_def, with the option's name.
tl_result tl_world_grid_make(const tl_nav_def *def, const double origin[3], double cell_size, tl_world_grid *grid_out,
                             tl_report *report_out);

/// The tiles that a box on x and z, metres in the world, can touch. False: none.
bool tl_world_grid_tiles(const tl_world_grid *grid, const double low[2], const double high[2],
                         tl_nav_tile_range *range_out);
/// Those of a cell's box, and of a record in it.
bool tl_world_grid_tiles_of_cell(const tl_world_grid *grid, const tl_world_segment_cell *cell,
                                 tl_nav_tile_range *range_out);
/// The lowest and highest coordinates on x and z of a record in a cell with that origin, and its tiles.
bool tl_world_grid_tiles_of_record(const tl_world_grid *grid, const double cell_origin[3], const unsigned char *record,
                                   tl_nav_tile_range *range_out);

#endif
