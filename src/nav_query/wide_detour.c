// SPDX-License-Identifier: MIT
//
// The shortest free way between two places of one polygon: straight, or from corner to corner of caps.
//
// A cap is the polygon of 32 corners written into the circle around a wall's end; the hull of a wall's two caps stands
// for what the wall forbids. It holds all that is nearer to the wall than 0.995 of the reach, and is held by all that
// is nearer than the reach: so where there is a free way at the reach there is one around the hulls, it bends at
// corners of caps only, and no place of it is nearer to a wall than 0.995 of the reach. It is found by A* over the
// corners in the polygon; which see which is asked of the walls themselves. There are few: ways between pieces are
// nearly always straight, and this is asked of the path alone.

#include "nav_query/wide_search.h"

#include "nav_query/circle_corners.h"

#include <string.h>

// A place where a way may bend.
typedef struct stop {
    tl_nav_spot spot;
    double cost, total; // metres from the first stop, and with those that are left at least
    uint32_t before;
    bool is_closed;
} stop;

typedef struct stops {
    stop *at; // [0] and [1]: the ends
    uint32_t count;
} stops;

static bool is_known(const tl_nav_near_walls *near, uint32_t wall, tl_nav_spot end)
{
    for (uint32_t i = 0; i < wall; i++) {
        const tl_nav_segment *other = &near->walls[i];
        if ((other->a.x == end.x && other->a.z == end.z) || (other->b.x == end.x && other->b.z == end.z)) {
            return true;
        }
    }
    return false;
}

static void add_stop(stops *all, tl_nav_spot spot)
{
    stop fresh = { spot, (double)INFINITY, (double)INFINITY, UINT32_MAX, false };
    all->at[all->count++] = fresh;
}

// The corners of all caps that are free and in the polygon.
static void add_caps(const tl_nav_clearance *clearance, const tl_nav_spot *corners, uint32_t count,
                     const tl_nav_near_walls *near, stops *all)
{
    for (uint32_t i = 0; i < near->wall_count; i++) {
        tl_nav_spot ends[2] = { near->walls[i].a, near->walls[i].b };
        for (int e = 0; e < 2; e++) {
            if (is_known(near, i, ends[e])) {
                continue;
            }
            for (uint32_t k = 0; k < TL_NAV_CIRCLE_CORNERS; k++) {
                tl_nav_spot spot = tl_nav_circle_corner(ends[e], clearance->reach, k);
                if (tl_nav_outside_by(corners, count, spot) <= clearance->slack &&
                    tl_nav_is_clear(near, spot, spot, clearance->least)) {
                    add_stop(all, spot);
                }
            }
        }
    }
}

static uint32_t cheapest(const stops *all)
{
    uint32_t best = UINT32_MAX;
    double total = (double)INFINITY;
    for (uint32_t i = 0; i < all->count; i++) {
        if (!all->at[i].is_closed && all->at[i].total < total) {
            best = i;
            total = all->at[i].total;
        }
    }
    return best;
}

// A* from stop 0 to stop 1, sight asked for only where it would pay. False: there is no way, which rounding alone can
// do.
static bool connect(const stops *all, const tl_nav_near_walls *near, double least)
{
    all->at[0].cost = 0.0;
    all->at[0].total = 0.0;
    for (uint32_t i = cheapest(all); i != UINT32_MAX; i = cheapest(all)) {
        stop *from = &all->at[i];
        from->is_closed = true;
        if (i == 1) {
            return true;
        }
        for (uint32_t k = 1; k < all->count; k++) {
            stop *to = &all->at[k];
            double cost = from->cost + sqrt(tl_nav_spot_distance_sq(from->spot, to->spot));
            if (!to->is_closed && cost < to->cost && tl_nav_is_clear(near, from->spot, to->spot, least)) {
                to->cost = cost;
                to->total = cost + sqrt(tl_nav_spot_distance_sq(to->spot, all->at[1].spot));
                to->before = i;
            }
        }
    }
    return false;
}

static bool is_straight(tl_nav_clearance *clearance, const tl_nav_bend *from, const tl_nav_bend *to)
{
    tl_nav_near_walls near;
    tl_nav_room room = clearance->room;
    tl_nav_spot ends[2] = { from->spot, to->spot };
    bool fits = tl_nav_find_near_walls(clearance, from->slot, from->polygon, ends, 2, clearance->least, &near);
    clearance->room = room;
    return fits && near.wall_count == 0;
}

bool tl_nav_wide_detour(tl_nav_clearance *clearance, tl_nav_bends *path, uint32_t behind)
{
    const tl_nav_bend from = path->bends[behind];
    const tl_nav_bend to = path->bends[from.next];
    if (is_straight(clearance, &from, &to)) {
        return true;
    }
    tl_nav_room room = clearance->room;
    tl_nav_spot corners[TL_NAV_MAX_CORNERS];
    tl_nav_near_walls near;
    uint32_t count = tl_nav_corner_spots(clearance->navmesh, from.slot, from.polygon, corners);
    if (!tl_nav_find_walls_of(clearance, from.slot, from.polygon, corners, count, clearance->reach, &near)) {
        return false;
    }
    stops all = { NULL, 0 };
    all.at = tl_nav_take(clearance, 2 + 2 * (uint64_t)near.wall_count * TL_NAV_CIRCLE_CORNERS, sizeof *all.at);
    if (all.at == NULL) {
        return false;
    }
    add_stop(&all, from.spot);
    add_stop(&all, to.spot);
    add_caps(clearance, corners, count, &near, &all);
    bool fits = true;
    if (connect(&all, &near, clearance->least)) {
        for (uint32_t i = all.at[1].before; i != 0 && fits; i = all.at[i].before) {
            fits = tl_nav_bend_add(path, behind, all.at[i].spot, from.slot, from.polygon) != TL_NAV_NO_NODE;
        }
    }
    clearance->room = room;
    clearance->is_full = clearance->is_full || !fits;
    return fits;
}
