// SPDX-License-Identifier: MIT
//
// A tile in another frame (floating origin): its integers are counted from another place of the grid, and its floats
// are made from them again.
//
// Corners come from the lattice by tl_nav_tile_position, as in the bake, so that a tile 10,000 km away has the bits
// that it would have beside the origin, and both sides of a seam agree. Inner points of the surface lie on 512ths of a
// cell, where the bake puts them: they are rounded to these, so that moving there and back changes nothing, as far as a
// float tells 512ths apart (16,384 cells from the frame's origin). Rejected: an origin a tile, which each query would
// have to add to each corner that it reads.

#include "nav_world/world.h"

#include <math.h>

// Along one axis: from metres of the old frame to metres of the new one.
typedef struct axis_move {
    double old_origin, cell;
    double new_steps; // 512ths of a cell from the old lattice origin to the new one
} axis_move;

static axis_move axis_move_of(float origin, int32_t step, uint32_t tile_size, float cell)
{
    const axis_move move = { (double)origin, (double)cell,
                             (double)((int64_t)step * (int64_t)tile_size) * (double)TL_NAV_WORLD_STEPS_A_CELL };
    return move;
}

static float moved(const axis_move *move, float at)
{
    const double step = move->cell / (double)TL_NAV_WORLD_STEPS_A_CELL;
    const double steps = floor(((double)at - move->old_origin) / step + 0.5);
    return (float)((steps - move->new_steps) * step);
}

// A polygon's surface, whose first points are its corners: these from the lattice.
static void move_polygon(tl_nav_tile *tile, uint32_t polygon, const axis_move *x, const axis_move *z)
{
    const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, polygon),
                           vertices = tl_nav_tile_part_of(tile, tile->detail_first_vertex, polygon);
    const uint32_t corner_count = corners.end - corners.begin, count = vertices.end - vertices.begin;
    tl_vec3 *points = (tl_vec3 *)tl_nav_tile_to_write(tile, tile->detail_vertices) + vertices.begin;
    for (uint32_t i = 0; i < corner_count; i++) {
        const tl_nav_lattice_point v = tl_nav_tile_lattice(tile, polygon, i);
        points[i].x = tl_nav_tile_position(tile->origin.x, tile->tile_x, tile->tile_size, v.at[0], tile->cell_size);
        points[i].z = tl_nav_tile_position(tile->origin.z, tile->tile_z, tile->tile_size, v.at[2], tile->cell_size);
    }
    for (uint32_t i = corner_count; i < count; i++) {
        points[i].x = moved(x, points[i].x);
        points[i].z = moved(z, points[i].z);
    }
}

void tl_nav_world_move_tile(tl_nav_tile *tile, int32_t step_x, int32_t step_z)
{
    const axis_move x = axis_move_of(tile->origin.x, step_x, tile->tile_size, tile->cell_size);
    const axis_move z = axis_move_of(tile->origin.z, step_z, tile->tile_size, tile->cell_size);
    tile->tile_x -= step_x;
    tile->tile_z -= step_z;
    tile->origin.x = 0.0f;
    tile->origin.z = 0.0f;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        move_polygon(tile, p, &x, &z);
    }
    tl_nav_tile_fit_boxes(tile);
}
