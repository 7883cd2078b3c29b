// SPDX-License-Identifier: MIT
//
// Places by their numbers and by boxes, and the way between the level's coordinates, the file's and the frame's.

#include "base/arena.h"
#include "base/assert.h"
#include "nav_world/world.h"

#include <math.h>
#include <string.h>

// The first place that is not before (x, z), or the number of places.
static uint32_t first_from(const tl_nav_world *world, int64_t x, int64_t z)
{
    uint32_t low = 0, high = world->place_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        const tl_nav_world_place *place = &world->places[middle];
        const bool before = place->z != z ? place->z < z : place->x < x;
        low = before ? middle + 1 : low;
        high = before ? high : middle;
    }
    return low;
}

uint32_t tl_nav_world_find_place(const tl_nav_world *world, int64_t x, int64_t z)
{
    const uint32_t at = first_from(world, x, z);
    return at < world->place_count && world->places[at].x == x && world->places[at].z == z ? at : TL_NAV_WORLD_NO_PLACE;
}

// The number of the tile along one axis in which a coordinate lies, within the grid.
static int64_t grid_index_at(const tl_nav_world *world, double at, float origin, uint32_t tiles)
{
    if (world->tile_size == 0) {
        return 0;
    }
    const double index = floor((at - (double)origin) / ((double)world->tile_size * (double)world->cell_size));
    return index < 0.0 ? 0 : index >= (double)tiles ? (int64_t)tiles - 1 : (int64_t)index;
}

void tl_nav_world_visit_box(const tl_nav_world *world, const double low[2], const double high[2],
                            tl_nav_world_visit_fn *visit, void *user)
{
    const double margin = (double)world->cell_size;
    const int64_t first_x = grid_index_at(world, low[0] - margin, world->lattice_origin.x, world->tiles_x);
    const int64_t last_x = grid_index_at(world, high[0] + margin, world->lattice_origin.x, world->tiles_x);
    const int64_t last_z = grid_index_at(world, high[1] + margin, world->lattice_origin.z, world->tiles_z);
    int64_t z = grid_index_at(world, low[1] - margin, world->lattice_origin.z, world->tiles_z);
    // Row by row; rows without places are jumped over.
    for (uint32_t at = first_from(world, first_x, z); at < world->place_count && z <= last_z;
         at = first_from(world, first_x, z)) {
        z = world->places[at].z;
        for (; at < world->place_count && world->places[at].z == z && world->places[at].x <= last_x && z <= last_z;
             at++) {
            if (world->places[at].x >= first_x && !visit(world, at, user)) {
                return;
            }
        }
        z = at < world->place_count && world->places[at].z == z ? z + 1
            : at < world->place_count                           ? world->places[at].z
                                                                : last_z + 1;
    }
}

// The level's axes turned to those of what was baked, as tl_pack_turn_in does, in double.
static void turn_in(uint32_t axes, const double v[3], double out[3])
{
    const double x = v[0], y = v[1], z = v[2];
    out[0] = x;
    out[1] = axes == TL_PACK_AXES_Z_UP || axes == TL_PACK_AXES_Z_UP_LEFT ? z : y;
    out[2] = axes == TL_PACK_AXES_Z_UP        ? 0.0 - y
             : axes == TL_PACK_AXES_Y_UP_LEFT ? 0.0 - z
             : axes == TL_PACK_AXES_Z_UP_LEFT ? y
                                              : z;
}

static void turn_out(uint32_t axes, const double v[3], double out[3])
{
    if (axes != TL_PACK_AXES_Z_UP) {
        turn_in(axes, v, out); // its own inverse
        return;
    }
    const double y = v[1];
    out[0] = v[0];
    out[1] = 0.0 - v[2];
    out[2] = y;
}

void tl_nav_world_to_file(const tl_nav_world *world, const double point[3], double out[3])
{
    const double from_origin[3] = { point[0] - world->origin[0], point[1] - world->origin[1],
                                    point[2] - world->origin[2] };
    turn_in(world->axes, from_origin, out);
}

void tl_nav_world_from_file(const tl_nav_world *world, const double at[3], double out[3])
{
    turn_out(world->axes, at, out);
    for (int i = 0; i < 3; i++) {
        out[i] += world->origin[i];
    }
}

void tl_nav_world_frame_origin(const tl_nav_world *world, double out[2])
{
    const double cell = (double)world->cell_size;
    const int64_t x = (int64_t)world->frame_x * (int64_t)world->tile_size;
    const int64_t z = (int64_t)world->frame_z * (int64_t)world->tile_size;
    out[0] = (double)world->lattice_origin.x + (double)x * cell;
    out[1] = (double)world->lattice_origin.z + (double)z * cell;
}

tl_vec3 tl_nav_world_place_in(const tl_nav_world *world, const double point[3])
{
    double at[3], origin[2];
    TL_ASSERT(world != NULL && point != NULL);
    tl_nav_world_to_file(world, point, at);
    tl_nav_world_frame_origin(world, origin);
    return tl_vec3_make((float)(at[0] - origin[0]), (float)at[1], (float)(at[2] - origin[1]));
}

void tl_nav_world_place_out(const tl_nav_world *world, tl_vec3 point, double out[3])
{
    double origin[2];
    TL_ASSERT(world != NULL && out != NULL);
    tl_nav_world_frame_origin(world, origin);
    const double at[3] = { (double)point.x + origin[0], (double)point.y, (double)point.z + origin[1] };
    tl_nav_world_from_file(world, at, out);
}

const tl_navmesh *tl_nav_world_navmesh(const tl_nav_world *world)
{
    TL_ASSERT(world != NULL);
    return world->navmesh;
}
