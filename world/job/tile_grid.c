// SPDX-License-Identifier: MIT

#include "world/job/tile_grid.h"

#include "world/bytes/little_endian.h"

#include <math.h>
#include <string.h>

tl_result tl_world_grid_make(const tl_nav_def *def, const double origin[3], double cell_size, tl_world_grid *grid_out,
                             tl_report *report_out)
{
    tl_nav_config config;
    memset(grid_out, 0, sizeof *grid_out);
    grid_out->def = *def;
    memset(&grid_out->def.host, 0, sizeof grid_out->def.host);
    memcpy(grid_out->origin, origin, sizeof grid_out->origin);
    grid_out->cell_size = cell_size;
    tl_result result = tl_nav_tile_grid(def, def->bounds, &grid_out->tiles_x, &grid_out->tiles_z, report_out);
    if (result == TL_OK) {
        result = tl_nav_config_from_def(def, def->bounds, 0, 0, &config, report_out);
    }
    if (result == TL_OK) {
        grid_out->margin = (double)config.border_size + 2.0;
    }
    return result;
}

static bool tiles_along(double low, double high, double margin, uint32_t size, uint32_t count, uint32_t *first,
                        uint32_t *number)
{
    const double begin = floor((low - margin) / (double)size), end = floor((high + margin) / (double)size);
    if (!(end >= 0.0 && begin < (double)count)) {
        return false;
    }
    *first = begin > 0.0 ? (uint32_t)begin : 0;
    *number = (end < (double)count ? (uint32_t)end : count - 1) - *first + 1;
    return true;
}

bool tl_world_grid_tiles(const tl_world_grid *grid, const double low[2], const double high[2],
                         tl_nav_tile_range *range_out)
{
    const double cell = (double)grid->def.cell_size;
    const double x = grid->origin[0] + (double)grid->def.bounds.min.x;
    const double z = grid->origin[2] + (double)grid->def.bounds.min.z;
    const uint32_t size = grid->def.tile_size;
    return tiles_along((low[0] - x) / cell, (high[0] - x) / cell, grid->margin, size, grid->tiles_x, &range_out->x,
                       &range_out->count_x) &&
           tiles_along((low[1] - z) / cell, (high[1] - z) / cell, grid->margin, size, grid->tiles_z, &range_out->z,
                       &range_out->count_z);
}

bool tl_world_grid_tiles_of_cell(const tl_world_grid *grid, const tl_world_segment_cell *cell,
                                 tl_nav_tile_range *range_out)
{
    double origin[3];
    tl_world_cell_origin(&cell->cell, grid->cell_size, origin);
    const double low[2] = { origin[0] + (double)cell->bounds.min.x, origin[2] + (double)cell->bounds.min.z };
    const double high[2] = { origin[0] + (double)cell->bounds.max.x, origin[2] + (double)cell->bounds.max.z };
    return tl_world_grid_tiles(grid, low, high, range_out);
}

bool tl_world_grid_tiles_of_record(const tl_world_grid *grid, const double cell_origin[3], const unsigned char *record,
                                   tl_nav_tile_range *range_out)
{
    double low[2], high[2];
    for (int i = 0; i < 2; i++) {
        const float a = tl_get_float(record + 8 * i), b = tl_get_float(record + 12 + 8 * i),
                    c = tl_get_float(record + 24 + 8 * i);
        low[i] = cell_origin[2 * i] + (double)tl_minf(a, tl_minf(b, c));
        high[i] = cell_origin[2 * i] + (double)tl_maxf(a, tl_maxf(b, c));
    }
    return tl_world_grid_tiles(grid, low, high, range_out);
}
