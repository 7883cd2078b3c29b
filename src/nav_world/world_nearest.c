// SPDX-License-Identifier: MIT
//
// The nearest polygon, whether a circle is covered, and rays along the surface: what tiles that are not in memory could
// change about them.

#include "base/assert.h"
#include "math/tolerance.h"
#include "nav_world/world.h"

#include <math.h>
#include <string.h>

typedef struct unseen_search {
    double center[3]; // metres of the file
    double half[3];   // of the box
    double best;      // squared: what was found, or INFINITY
    bool in_plane;    // heights do not count
    bool matters;
} unseen_search;

// How far the surface of a tile, put into a frame, may lie outside the box that the file says, along one axis: by a
// step of a cell (tile_frame.c), and by the rounding of the file's floats.
static double box_margin(const tl_nav_world *world, double low, double high)
{
    const double size = fabs(low) > fabs(high) ? fabs(low) : fabs(high);
    return (double)world->cell_size / (double)TL_NAV_WORLD_STEPS_A_CELL + size * TL_FLOAT_OUTWARD;
}

// Whether a tile that is not in memory may hold a point of the box that is as near as what was found.
static bool look_at_unseen(const tl_nav_world *world, uint32_t index, void *user)
{
    unseen_search *search = user;
    const tl_nav_world_place *place = &world->places[index];
    if (tl_nav_world_is_present(world, index)) {
        return true;
    }
    for (uint32_t i = 0; i < place->tile_count && !search->matters; i++) {
        const tl_aabb *box = &world->tiles[place->first_tile + i].bounds;
        const double low[3] = { (double)box->min.x, (double)box->min.y, (double)box->min.z };
        const double high[3] = { (double)box->max.x, (double)box->max.y, (double)box->max.z };
        double squared = 0.0;
        bool reaches = true;
        for (int axis = 0; axis < 3; axis += search->in_plane ? 2 : 1) {
            const double margin = box_margin(world, low[axis], high[axis]);
            const double apart = tl_nav_world_gap(search->center[axis], low[axis] - margin, high[axis] + margin);
            reaches = reaches && apart <= search->half[axis];
            squared += apart * apart;
        }
        search->matters = reaches && squared <= search->best;
    }
    return !search->matters;
}

// The square of the measure by which tl_navmesh_find_nearest compares.
static double measure_of(const tl_nav_world *world, const tl_nav_location *location, tl_vec3 center)
{
    const tl_nav_tile *tile = NULL;
    if (tl_navmesh_resolve(world->navmesh, location->polygon, &tile, NULL) != TL_OK) {
        return (double)INFINITY;
    }
    const double dx = (double)location->point.x - (double)center.x, dz = (double)location->point.z - (double)center.z;
    double dy = (double)location->point.y - (double)center.y;
    dy += dy > (double)tile->agent_max_climb ? (double)tile->agent_height : 0.0;
    return dx * dx + dy * dy + dz * dz;
}

tl_result tl_nav_world_find_nearest(const tl_nav_world *world, const tl_nav_filter *filter, const double point[3],
                                    tl_vec3 half_extents, tl_nav_location *location_out)
{
    if (location_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(location_out, 0, sizeof *location_out);
    if (world == NULL || point == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_world_is_finite(point)) {
        return TL_ERR_NOT_FINITE;
    }
    const tl_vec3 turned = tl_pack_turn_in((tl_pack_axes)world->axes, half_extents);
    const tl_vec3 half = tl_vec3_make(fabsf(turned.x), fabsf(turned.y), fabsf(turned.z));
    if (half_extents.x < 0.0f || half_extents.y < 0.0f || half_extents.z < 0.0f) {
        return TL_ERR_ARGUMENT;
    }
    const tl_vec3 center = tl_nav_world_place_in(world, point);
    const tl_result result = tl_navmesh_find_nearest(world->navmesh, filter, center, half, location_out);
    if (tl_is_error(result)) {
        return result;
    }
    unseen_search search;
    memset(&search, 0, sizeof search);
    tl_nav_world_to_file(world, point, search.center);
    search.half[0] = (double)half.x;
    search.half[1] = (double)half.y;
    search.half[2] = (double)half.z;
    search.best = result == TL_OK ? measure_of(world, location_out, center) : (double)INFINITY;
    const double low[2] = { search.center[0] - search.half[0], search.center[2] - search.half[2] };
    const double high[2] = { search.center[0] + search.half[0], search.center[2] + search.half[2] };
    tl_nav_world_visit_box(world, low, high, look_at_unseen, &search);
    return search.matters ? TL_NOT_LOADED : result;
}

tl_result tl_nav_world_covers(const tl_nav_world *world, const double center[3], double radius)
{
    if (world == NULL || center == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_world_is_finite(center) || !isfinite(radius)) {
        return TL_ERR_NOT_FINITE;
    }
    if (radius < 0.0) {
        return TL_ERR_ARGUMENT;
    }
    unseen_search search;
    memset(&search, 0, sizeof search);
    tl_nav_world_to_file(world, center, search.center);
    search.half[0] = radius;
    search.half[2] = radius;
    search.best = radius * radius;
    search.in_plane = true;
    const double low[2] = { search.center[0] - radius, search.center[2] - radius };
    const double high[2] = { search.center[0] + radius, search.center[2] + radius };
    tl_nav_world_visit_box(world, low, high, look_at_unseen, &search);
    return search.matters ? TL_NOT_LOADED : TL_OK;
}

// Whether behind an edge of a polygon lies a tile of the file that is not in memory.
static bool leads_to_unseen(const tl_nav_world *world, tl_nav_ref polygon, uint32_t edge)
{
    const tl_nav_tile *tile = NULL;
    uint32_t index = 0, corners = 0;
    if (tl_navmesh_resolve(world->navmesh, polygon, &tile, &index) != TL_OK) {
        return false;
    }
    (void)tl_nav_tile_corners(tile, index, &corners);
    if (edge >= corners) {
        return false;
    }
    const uint32_t link = tl_nav_tile_edge_link(tile, index, edge);
    if (!tl_nav_is_portal(link)) {
        return false;
    }
    const uint32_t side = tl_nav_tile_side_of(tile, tl_nav_link_portal(link));
    const uint32_t place =
        tl_nav_world_find_place(world, (int64_t)tile->tile_x + world->frame_x, (int64_t)tile->tile_z + world->frame_z);
    if (side >= TL_NAV_SIDE_CUT || place == TL_NAV_WORLD_NO_PLACE) {
        return false;
    }
    const uint32_t beside = world->places[place].neighbour[side];
    return beside != TL_NAV_WORLD_NO_PLACE && !tl_nav_world_is_present(world, beside);
}

tl_result tl_nav_world_cast_ray(const tl_nav_world *world, const tl_nav_filter *filter, const tl_nav_location *start,
                                const double end[3], tl_nav_ray_hit *hit_out)
{
    if (hit_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(hit_out, 0, sizeof *hit_out);
    if (world == NULL || start == NULL || end == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_world_is_finite(end)) {
        return TL_ERR_NOT_FINITE;
    }
    const tl_result result =
        tl_navmesh_cast_ray(world->navmesh, filter, start, tl_nav_world_place_in(world, end), NULL, 0, hit_out);
    // The buffer was left out: no TL_INCOMPLETE.
    if (result == TL_OK && hit_out->hit && leads_to_unseen(world, hit_out->polygon, hit_out->edge)) {
        return TL_NOT_LOADED;
    }
    return result;
}
