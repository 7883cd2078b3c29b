// SPDX-License-Identifier: MIT
//
// The path of an exact search that was found: its corners and polygons, read off the wedges.

#include "nav_query/exact/shortest_search.h"
#include "nav_query/navmesh/ring_step.h"

#include <math.h>
#include <string.h>

static bool turns(const tl_nav_wedge *wedge, const tl_nav_wedge *parent)
{
    return wedge->root_x != parent->root_x || wedge->root_z != parent->root_z;
}

// Where a wedge's root lies: a vertex of its parent's polygon. `*is_left_out`: it is the left end of the edge by which
// that one was entered.
static tl_vec3 root_point(const tl_navmesh *navmesh, const tl_nav_wedge *wedge, const tl_nav_wedge *parent,
                          bool *is_left_out)
{
    const tl_nav_ring ring = tl_nav_ring_at(navmesh, parent->slot, parent->polygon);
    uint32_t i = 0;
    while (i + 1 < ring.count && (ring.points[i].x != wedge->root_x || ring.points[i].z != wedge->root_z)) {
        i++;
    }
    *is_left_out = i == parent->edge;
    return tl_vec3_make(wedge->root_x, ring.points[i].y, wedge->root_z);
}

static double distance_in_plane(tl_vec3 a, tl_vec3 b)
{
    double x = (double)b.x - (double)a.x;
    double z = (double)b.z - (double)a.z;
    return sqrt(x * x + z * z);
}

// > 0: the path turns right at b. 0: it goes straight on, or straight back: around the end of a wall between two floors
// to a place above or below the one that it came from.
static double turn_between(tl_vec3 a, tl_vec3 b, tl_vec3 c, bool is_left)
{
    double x = (double)b.x - (double)a.x;
    double z = (double)b.z - (double)a.z;
    double on_x = (double)c.x - (double)b.x;
    double on_z = (double)c.z - (double)b.z;
    double turn = x * on_z - z * on_x;
    bool is_back = turn == 0.0 && x * on_x + z * on_z < 0.0;
    return !is_back ? turn : is_left ? -1.0 : 1.0;
}

// Corners are met from the goal back to the start. One that is met is held until the next one says how it turns.
typedef struct corner_walk {
    tl_nav_corner *corners; // NULL: only counted
    uint32_t capacity;
    uint32_t at; // the place of the corner that was written last, from the end of the whole path
    tl_nav_corner held;
    uint32_t count; // of corners so far
    tl_nav_shortest_path *path;
} corner_walk;

static void write_corner(corner_walk *walk, const tl_nav_corner *corner)
{
    walk->at--;
    if (walk->corners != NULL && walk->at < walk->capacity) {
        walk->corners[walk->at] = *corner;
    }
}

// Takes up the corner before the one that is held: it is written, and the way between them counted.
static void hold_corner(corner_walk *walk, const tl_nav_corner *corner, double length)
{
    write_corner(walk, &walk->held);
    walk->path->length += length;
    walk->path->surface_length += (double)tl_distance(corner->point, walk->held.point);
    walk->held = *corner;
    walk->count++;
}

// The two ends of the link by which a wedge has come, from the far one back.
static void walk_link(const tl_nav_shortest_search *search, const tl_nav_wedge *wedge, corner_walk *walk)
{
    const tl_nav_offmesh_table *table = &search->navmesh->offmesh;
    uint32_t end = wedge->edge & ~TL_NAV_WEDGE_LANDS;
    const tl_nav_offmesh_entry *link = &table->entries[end / 2];
    const tl_nav_anchor *from = &link->ends[end % 2];
    const tl_nav_anchor *to = &link->ends[1 - end % 2];
    tl_nav_corner landing = { to->point, tl_nav_make_ref(search->navmesh, to->slot, to->polygon), 0, TL_NAV_NO_REF };
    tl_nav_corner leaving = { from->point, tl_nav_make_ref(search->navmesh, from->slot, from->polygon),
                              TL_NAV_CORNER_LINK, tl_nav_offmesh_ref(table, end) };
    hold_corner(walk, &landing, distance_in_plane(landing.point, walk->held.point));
    hold_corner(walk, &leaving, link->cost);
}

// Goes through the corners behind the start; returns how many there are. A vertex that the path only passes is none.
static uint32_t walk_corners(const tl_nav_shortest_search *search, corner_walk *walk)
{
    const tl_nav_wedge *wedges = search->query->wedges;
    tl_nav_ref goal_ref = tl_nav_make_ref(search->navmesh, search->goal_slot, search->goal_polygon);
    tl_nav_corner goal = { search->goal, goal_ref, TL_NAV_CORNER_END, TL_NAV_NO_REF };
    walk->held = goal;
    walk->count = 1;
    for (uint32_t i = search->last; wedges[i].parent != TL_NAV_NO_NODE; i = wedges[i].parent) {
        const tl_nav_wedge *parent = &wedges[wedges[i].parent];
        if (tl_nav_wedge_lands(&wedges[i])) {
            walk_link(search, &wedges[i], walk);
            continue;
        }
        if (!turns(&wedges[i], parent)) {
            continue;
        }
        // The vertex is the parent's, and through its polygon the path goes on.
        bool is_left = false;
        tl_nav_corner corner = { root_point(search->navmesh, &wedges[i], parent, &is_left),
                                 tl_nav_make_ref(search->navmesh, parent->slot, parent->polygon), 0, TL_NAV_NO_REF };
        tl_vec3 before = { parent->root_x, 0.0f, parent->root_z };
        double turn = turn_between(before, corner.point, walk->held.point, is_left);
        if (turn == 0.0) {
            continue;
        }
        corner.flags = turn < 0.0 ? TL_NAV_CORNER_LEFT : TL_NAV_CORNER_RIGHT;
        hold_corner(walk, &corner, distance_in_plane(corner.point, walk->held.point));
    }
    write_corner(walk, &walk->held);
    walk->path->length += distance_in_plane(search->start, walk->held.point);
    walk->path->surface_length += (double)tl_distance(search->start, walk->held.point);
    return walk->count;
}

void tl_nav_write_wedge_corners(const tl_nav_shortest_search *search, tl_nav_corner *corners, uint32_t capacity,
                                tl_nav_shortest_path *path)
{
    // First to count: the path is read backwards.
    corner_walk walk;
    memset(&walk, 0, sizeof walk);
    walk.path = path;
    path->corner_count = 1 + walk_corners(search, &walk);
    if (capacity > 0) {
        path->length = 0.0;
        path->surface_length = 0.0;
        walk.corners = corners;
        walk.capacity = capacity;
        walk.at = path->corner_count;
        walk_corners(search, &walk);
        tl_nav_corner start = { search->start,
                                tl_nav_make_ref(search->navmesh, search->start_slot, search->start_polygon),
                                TL_NAV_CORNER_START, TL_NAV_NO_REF };
        corners[0] = start;
    }
}

double tl_nav_shortest_length(const tl_nav_shortest_search *search)
{
    const tl_nav_wedge *last = &search->query->wedges[search->last];
    return last->cost + distance_in_plane(tl_vec3_make(last->root_x, 0.0f, last->root_z), search->goal);
}

// Whether the path enters a polygon by a wedge. A turn within a polygon has a wedge of its own there.
static bool enters_by(const tl_nav_wedge *wedges, uint32_t wedge)
{
    uint32_t parent = wedges[wedge].parent;
    return parent == TL_NAV_NO_NODE || tl_nav_wedge_lands(&wedges[wedge]) ||
           wedges[parent].slot != wedges[wedge].slot || wedges[parent].polygon != wedges[wedge].polygon;
}

uint32_t tl_nav_write_wedge_polygons(const tl_nav_shortest_search *search, tl_nav_ref *polygons, uint32_t capacity)
{
    const tl_nav_wedge *wedges = search->query->wedges;
    uint32_t count = 0;
    for (uint32_t i = search->last; i != TL_NAV_NO_NODE; i = wedges[i].parent) {
        count += !enters_by(wedges, i) ? 0 : tl_nav_wedge_lands(&wedges[i]) ? 2 : 1;
    }
    uint32_t at = count;
    for (uint32_t i = search->last; i != TL_NAV_NO_NODE && capacity > 0; i = wedges[i].parent) {
        if (enters_by(wedges, i) && --at < capacity) {
            polygons[at] = tl_nav_make_ref(search->navmesh, wedges[i].slot, wedges[i].polygon);
        }
        if (tl_nav_wedge_lands(&wedges[i]) && --at < capacity) {
            polygons[at] = tl_nav_offmesh_ref(&search->navmesh->offmesh, wedges[i].edge & ~TL_NAV_WEDGE_LANDS);
        }
    }
    return count;
}
