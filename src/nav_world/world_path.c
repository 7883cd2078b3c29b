// SPDX-License-Identifier: MIT
//
// Shortest paths over the tiles in memory, and the proof that no tile that is not there could make them shorter.
//
// A path that uses other tiles leaves through an open edge, one behind which the world goes on, on the island of its
// start, and comes back through one on the island of its goal. Its length is at least that of the straight lines from
// start to such an edge to goal: so open edges outside the ellipse around both whose sum of distances is the length
// found cannot matter, nor those across which the other place has no floor. That is exact for a world without
// obstacles, and asks only edges at the rim of what is loaded.
//
// Rejected: to let the search itself note open edges that it would have expanded; it misses those that a prepared
// navmesh never touches, and gives no bound.

#include "base/assert.h"
#include "nav_world/world.h"

#include <math.h>
#include <string.h>

// The ends of paths, in the plane of the frame.
typedef struct open_search {
    double start[2], goal[2]; // x, z
    uint32_t start_island, goal_island;
    double leave, enter; // least lengths over open edges on the island of the start, and of the goal
} open_search;

// The least sum of the distances from two points to a point of a piece of a line x = `at` (axis 0) or z = `at` (axis
// 1). The point is where the line from the one to the mirror image of the other crosses, moved into the piece: the sum
// is convex along the line.
static double least_detour(const open_search *search, int axis, double at, double low, double high)
{
    const double ahead_start = fabs(search->start[axis] - at), ahead_goal = fabs(search->goal[axis] - at);
    const double along_start = search->start[1 - axis], along_goal = search->goal[1 - axis];
    const double sum = ahead_start + ahead_goal;
    double along = sum > 0.0 ? along_start + (along_goal - along_start) * (ahead_start / sum) : along_start;
    along = along < low ? low : along > high ? high : along;
    const double from = along - along_start, to = along - along_goal;
    return sqrt(ahead_start * ahead_start + from * from) + sqrt(ahead_goal * ahead_goal + to * to);
}

// The plane's box of a place's floor in the frame, with a cell of margin for rounding: x, then z.
typedef struct floor_box {
    double low[2], high[2];
} floor_box;

static floor_box find_floor(const tl_nav_world *world, uint32_t place)
{
    const tl_aabb *bounds = &world->places[place].bounds;
    double origin[2];
    tl_nav_world_frame_origin(world, origin);
    const double margin = (double)world->cell_size;
    const floor_box box = { { (double)bounds->min.x - origin[0] - margin, (double)bounds->min.z - origin[1] - margin },
                            { (double)bounds->max.x - origin[0] + margin,
                              (double)bounds->max.z - origin[1] + margin } };
    return box;
}

// `beside`: the floor of the place across the side.
static void look_at_portal(const tl_nav_world *world, const tl_nav_world_tile *at, uint32_t side, uint32_t portal,
                           const floor_box *beside, open_search *search)
{
    const tl_nav_tile *tile = at->blob;
    const tl_nav_portal *edge = &tl_nav_tile_portals(tile)[portal];
    const uint32_t first = tl_nav_tile_first_corner(tile, edge->polygon);
    uint32_t count = 0, island = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, edge->polygon, &count);
    const uint32_t begin = edge->corner - first;
    const tl_vec3 a = corners[begin], b = corners[begin + 1 < count ? begin + 1 : 0];
    const int axis = (side & 1u) != 0;
    const double line = axis == 0 ? (double)a.x : (double)a.z;
    const double end_a = axis == 0 ? (double)a.z : (double)a.x, end_b = axis == 0 ? (double)b.z : (double)b.x;
    double low = end_a < end_b ? end_a : end_b, high = end_a < end_b ? end_b : end_a;
    low = low > beside->low[1 - axis] ? low : beside->low[1 - axis];
    high = high < beside->high[1 - axis] ? high : beside->high[1 - axis];
    if (low > high || line < beside->low[axis] || line > beside->high[axis]) {
        return; // nothing there to go on to
    }
    const double length = least_detour(search, axis, line, low, high);
    if (length >= search->leave && length >= search->enter) {
        return;
    }
    const tl_nav_ref ref = tl_navmesh_polygon_ref(world->navmesh, at->slot, edge->polygon);
    if (tl_navmesh_island(world->navmesh, ref, &island) != TL_OK) {
        return;
    }
    if (island == search->start_island && length < search->leave) {
        search->leave = length;
    }
    if (island == search->goal_island && length < search->enter) {
        search->enter = length;
    }
}

// The least length of a path that leaves what is in memory; INFINITY: there is none.
static double least_open_length(const tl_nav_world *world, open_search *search)
{
    search->leave = (double)INFINITY;
    search->enter = (double)INFINITY;
    for (uint32_t i = 0; i < world->open_count; i++) {
        const tl_nav_world_place *place = &world->places[world->open[i]];
        for (uint32_t side = 0; side < 4; side++) {
            const uint32_t beside = place->neighbour[side];
            if (beside == TL_NAV_WORLD_NO_PLACE || tl_nav_world_is_present(world, beside)) {
                continue;
            }
            const floor_box across = find_floor(world, beside);
            for (uint32_t t = 0; t < place->tile_count; t++) {
                const tl_nav_world_tile *tile = &world->tiles[place->first_tile + t];
                const uint32_t end = tl_nav_tile_side_first(tile->blob, side + 1);
                for (uint32_t p = tl_nav_tile_side_first(tile->blob, side); p < end; p++) {
                    look_at_portal(world, tile, side, p, &across, search);
                }
            }
        }
    }
    return search->leave > search->enter ? search->leave : search->enter;
}

static tl_result begin_open_search(const tl_nav_world *world, const tl_nav_path_request *request, open_search *search)
{
    tl_vec3 start, goal;
    TL_TRY(tl_navmesh_closest_point(world->navmesh, request->start.polygon, request->start.point, &start, NULL));
    TL_TRY(tl_navmesh_closest_point(world->navmesh, request->goal.polygon, request->goal.point, &goal, NULL));
    TL_TRY(tl_navmesh_island(world->navmesh, request->start.polygon, &search->start_island));
    TL_TRY(tl_navmesh_island(world->navmesh, request->goal.polygon, &search->goal_island));
    search->start[0] = (double)start.x;
    search->start[1] = (double)start.z;
    search->goal[0] = (double)goal.x;
    search->goal[1] = (double)goal.z;
    return TL_OK;
}

tl_result tl_nav_world_find_path(const tl_nav_world *world, tl_nav_query *query, const tl_nav_path_request *request,
                                 const tl_nav_path_buffers *buffers, tl_nav_shortest_path *path_out)
{
    if (path_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(path_out, 0, sizeof *path_out);
    if (world == NULL) {
        return TL_ERR_ARGUMENT;
    }
    const tl_result result = tl_nav_query_find_shortest_path(query, world->navmesh, request, buffers, path_out);
    if (tl_is_error(result)) {
        return result;
    }
    open_search search;
    const tl_result begun = begin_open_search(world, request, &search);
    if (begun != TL_OK) {
        memset(path_out, 0, sizeof *path_out);
        return begun;
    }
    const double open_length = least_open_length(world, &search);
    switch (path_out->status) {
    case TL_NAV_PATH_COMPLETE:
        if (!(open_length < path_out->lower_bound)) {
            return result;
        }
        path_out->lower_bound = open_length;
        return TL_NOT_LOADED;
    case TL_NAV_PATH_UNREACHABLE:
        if (open_length == (double)INFINITY) {
            return result;
        }
        path_out->status = TL_NAV_PATH_UNFINISHED;
        path_out->lower_bound = open_length;
        return TL_NOT_LOADED;
    default: // out of nodes: its bound holds for the world where no open edge is nearer
        path_out->lower_bound = open_length < path_out->lower_bound ? open_length : path_out->lower_bound;
        return result;
    }
}
