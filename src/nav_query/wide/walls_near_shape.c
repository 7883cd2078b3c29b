// SPDX-License-Identifier: MIT
//
// The walls near a convex shape that may lie over several polygons: those near its part in each of them.

#include "nav_query/wide/walls_near_shape.h"
#include "nav_query/wide/wall_cell.h"

#include "nav_query/filter/nav_filter.h"
#include "nav_query/plane/surface.h"
#include "nav_query/search/local_search.h"

#include <string.h>

// Adds a polygon that was not met yet: met polygons grow downwards.
static bool meet_polygon(tl_nav_clearance *clearance, tl_nav_near_walls *near, uint32_t slot, uint32_t polygon)
{
    bool found = false;
    if (near->met_count == clearance->query->max_nodes ||
        (char *)(near->met - near->met_count) < clearance->scratch.low) {
        return false;
    }
    const bool fits = tl_nav_find_root(clearance->query, tl_nav_polygon_number(slot, polygon), &found) != NULL;
    if (fits && !found) {
        tl_nav_met met = { slot, polygon };
        *(near->met - near->met_count++) = met;
    }
    return fits;
}

static bool outline_holds(const tl_nav_spot *corners, uint32_t count, tl_nav_spot spot)
{
    bool left = false;
    bool right = false;
    for (uint32_t i = 0; i < count; i++) {
        double turn = tl_nav_spot_turn(corners[i], corners[i + 1 < count ? i + 1 : 0], spot);
        left = left || turn < 0.0;
        right = right || turn > 0.0;
    }
    return !(left && right);
}

// The lines of a shape's sides: unit, outward. None of a shape with more sides, or without an inside.
enum { MAX_SHAPE_SIDES = 4 };

typedef struct side_lines {
    double x[MAX_SHAPE_SIDES], z[MAX_SHAPE_SIDES], offset[MAX_SHAPE_SIDES];
    uint32_t count;
} side_lines;

static side_lines lines_of(const tl_nav_shape *shape)
{
    side_lines lines;
    lines.count = 0;
    double area = shape->count >= 3 ? tl_nav_spot_turn(shape->corners[0], shape->corners[1], shape->corners[2]) : 0.0;
    for (uint32_t i = 0; i < shape->count && shape->count <= MAX_SHAPE_SIDES && area != 0.0; i++) {
        tl_nav_spot p = shape->corners[i];
        tl_nav_spot q = shape->corners[i + 1 < shape->count ? i + 1 : 0];
        double length = area > 0.0 ? sqrt(tl_nav_spot_distance_sq(p, q)) : -sqrt(tl_nav_spot_distance_sq(p, q));
        if (length != 0.0) {
            lines.x[lines.count] = (q.z - p.z) / length;
            lines.z[lines.count] = -(q.x - p.x) / length;
            lines.offset[lines.count] = lines.x[lines.count] * p.x + lines.z[lines.count] * p.z;
            lines.count++;
        }
    }
    return lines;
}

// Whether a segment lies farther than a distance beyond one of the lines: then it is farther from the shape.
static bool is_beyond_lines(const side_lines *lines, tl_nav_segment segment, double distance)
{
    for (uint32_t i = 0; i < lines->count; i++) {
        double margin = distance + lines->offset[i];
        if (lines->x[i] * segment.a.x + lines->z[i] * segment.a.z > margin &&
            lines->x[i] * segment.b.x + lines->z[i] * segment.b.z > margin) {
            return true;
        }
    }
    return false;
}

// Whether some of the shape lies beyond an edge's line: if none does, a polygon across has no part in it. And whether
// all of it does.
static bool leads_on(const tl_nav_shape *touch, tl_nav_segment edge, bool *all_out)
{
    double min_sq = touch->distance_sq * tl_nav_spot_distance_sq(edge.a, edge.b);
    bool some = false;
    *all_out = true;
    for (uint32_t i = 0; i < touch->count; i++) {
        double turn = tl_nav_spot_turn(edge.a, edge.b, touch->corners[i]);
        bool is_over = turn > 0.0 && turn * turn > min_sq;
        some = some || is_over;
        *all_out = *all_out && is_over;
    }
    return some;
}

// Whether the shape has a part beyond an edge. Near its corners a little more than that; a polygon more does no harm.
static bool reaches_over(const tl_nav_shape *touch, const side_lines *lines, double slack, tl_nav_segment edge)
{
    bool all = false;
    if (tl_nav_shape_is_far(touch, edge) || is_beyond_lines(lines, edge, slack) || !leads_on(touch, edge, &all)) {
        return false;
    }
    return lines->count > 0 ? !all : tl_nav_shape_distance_sq(touch, edge) <= touch->distance_sq;
}

// Meets all polygons that the shape touches, from the first on.
static bool meet_touched(tl_nav_clearance *clearance, const tl_nav_shape *touch, tl_nav_near_walls *near)
{
    const side_lines lines = lines_of(touch);
    bool fits = true;
    for (uint32_t at = 0; fits && at < near->met_count; at++) {
        tl_nav_met met = *(near->met - at);
        const tl_nav_ring ring = tl_nav_ring_at(clearance->navmesh, met.slot, met.polygon);
        for (uint32_t i = 0; fits && i < ring.count; i++) {
            const tl_vec3 *end = &ring.points[i + 1 < ring.count ? i + 1 : 0];
            tl_nav_segment edge = { tl_nav_spot_of(ring.points[i]), tl_nav_spot_of(*end) };
            if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, i)) ||
                !reaches_over(touch, &lines, clearance->slack, edge)) {
                continue;
            }
            tl_nav_ring_seam to = tl_nav_ring_across(clearance->navmesh, met.slot, tl_nav_ring_to(&ring, i));
            if (clearance->filter == NULL ||
                tl_nav_passes(clearance->filter, clearance->navmesh->slots[to.slot].tile, to.polygon)) {
                fits = meet_polygon(clearance, near, to.slot, to.polygon);
            }
        }
    }
    return fits;
}

// The part of a convex shape in a polygon, its outline included with some slack; `cut` holds both their corners.
static uint32_t cut_shape(const tl_navmesh *navmesh, tl_nav_met at, const tl_nav_spot *shape, uint32_t count,
                          double slack, tl_nav_spot cut[2 * TL_NAV_MAX_CORNERS])
{
    tl_nav_spot sides[TL_NAV_MAX_CORNERS];
    tl_nav_spot old[2 * TL_NAV_MAX_CORNERS];
    uint32_t side_count = tl_nav_corner_spots(navmesh, at.slot, at.polygon, sides);
    memcpy(cut, shape, count * sizeof *shape);
    for (uint32_t s = 0; s < side_count && count > 0; s++) {
        tl_nav_spot p = sides[s];
        tl_nav_spot q = sides[s + 1 < side_count ? s + 1 : 0];
        double margin = slack * sqrt(tl_nav_spot_distance_sq(p, q));
        uint32_t old_count = count;
        memcpy(old, cut, count * sizeof *cut);
        count = 0;
        for (uint32_t i = 0; i < old_count; i++) {
            tl_nav_spot a = old[i];
            tl_nav_spot b = old[i + 1 < old_count ? i + 1 : 0];
            double own = tl_nav_spot_turn(p, q, a) - margin;
            double next = tl_nav_spot_turn(p, q, b) - margin;
            if (own <= 0.0) {
                cut[count++] = a;
            }
            if (old_count > 1 && ((own < 0.0 && next > 0.0) || (own > 0.0 && next < 0.0))) {
                cut[count++] = tl_nav_spot_lerp(a, b, own / (own - next));
            }
        }
    }
    return count;
}

bool tl_nav_find_walls_near_shape(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon,
                                  const tl_nav_spot *shape, uint32_t count, double distance,
                                  tl_nav_near_walls *near_out)
{
    tl_nav_shape touch = tl_nav_shape_make(shape, count, clearance->slack, clearance->slack);
    tl_nav_begin_walls(clearance, near_out);
    bool fits = meet_polygon(clearance, near_out, slot, polygon) && meet_touched(clearance, &touch, near_out);
    clearance->scratch.high = (char *)(near_out->met - near_out->met_count + 1);
    clearance->is_full = clearance->is_full || !fits;
    for (uint32_t i = 0; fits && i < near_out->met_count; i++) {
        tl_nav_met at = *(near_out->met - i);
        tl_nav_spot part[2 * TL_NAV_MAX_CORNERS];
        uint32_t part_count = cut_shape(clearance->navmesh, at, shape, count, clearance->slack, part);
        fits = part_count == 0 || tl_nav_add_visible_walls(clearance, at, part, part_count, distance, near_out);
    }
    tl_nav_end_walls(clearance, near_out);
    return fits;
}

static bool is_known_wall(const tl_nav_near_wall *walls, uint32_t count, const tl_nav_near_wall *wall)
{
    for (uint32_t i = 0; i < count; i++) {
        if (walls[i].a_x == wall->a_x && walls[i].a_z == wall->a_z && walls[i].b_x == wall->b_x &&
            walls[i].b_z == wall->b_z) {
            return true;
        }
    }
    return false;
}

// Whether a segment comes nearer to the shape than its distance.
static bool is_near_shape(const tl_nav_shape *reach, const side_lines *lines, double distance, tl_nav_segment segment)
{
    if (tl_nav_shape_is_far(reach, segment) || is_beyond_lines(lines, segment, distance)) {
        return false;
    }
    for (uint32_t i = 0; i < (reach->count > 2 ? reach->count : 1); i++) {
        tl_nav_segment side = { reach->corners[i], reach->corners[i + 1 < reach->count ? i + 1 : 0] };
        if (tl_nav_segments_distance_sq(side, segment) < reach->distance_sq) {
            return true;
        }
    }
    return reach->count > 2 && outline_holds(reach->corners, reach->count, segment.a);
}

// All walls around a polygon, kept or gathered. What lies beyond a wall that forbids all of the polygon is not kept,
// but may be near to the shape's parts in other polygons.
static bool find_all_walls(tl_nav_clearance *clearance, tl_nav_met at, tl_nav_wall_cell *cell_out)
{
    const double reach = clearance->reach;
    return tl_nav_wall_cell_of(clearance, at.slot, at.polygon, reach, cell_out) &&
           (cell_out->near.within >= reach || tl_nav_gather_cell(clearance, at.slot, at.polygon, reach, cell_out));
}

bool tl_nav_find_kept_walls_near_shape(tl_nav_clearance *clearance, uint32_t slot, uint32_t polygon,
                                       const tl_nav_spot *shape, uint32_t count, tl_nav_near_walls *near_out)
{
    tl_nav_shape touch = tl_nav_shape_make(shape, count, clearance->slack, clearance->slack);
    tl_nav_shape reach = tl_nav_shape_make(shape, count, clearance->reach, clearance->slack);
    tl_nav_begin_walls(clearance, near_out);
    bool fits = meet_polygon(clearance, near_out, slot, polygon) && meet_touched(clearance, &touch, near_out);
    clearance->scratch.high = (char *)(near_out->met - near_out->met_count + 1);
    tl_nav_near_wall *walls = (tl_nav_near_wall *)(void *)clearance->scratch.low;
    const side_lines lines = lines_of(&reach);
    for (uint32_t i = 0; fits && i < near_out->met_count; i++) {
        tl_nav_met at = *(near_out->met - i);
        tl_nav_scratch scratch = clearance->scratch;
        tl_nav_wall_cell cell;
        fits = tl_nav_take_scratch(clearance, near_out->wall_count, sizeof *walls) != NULL &&
               find_all_walls(clearance, at, &cell);
        clearance->scratch = scratch;
        for (uint32_t k = 0; fits && k < cell.near.wall_count; k++) {
            // What was gathered lies behind the list, and moves to its end.
            const tl_nav_near_wall wall = cell.near.walls[k];
            tl_nav_segment segment = tl_nav_segment_of_wall(&wall);
            if (!is_known_wall(walls, near_out->wall_count, &wall) &&
                is_near_shape(&reach, &lines, clearance->reach + clearance->slack, segment)) {
                fits = (char *)(walls + near_out->wall_count + 1) <= clearance->scratch.high;
                if (fits) {
                    walls[near_out->wall_count++] = wall;
                }
            }
        }
    }
    clearance->is_full = clearance->is_full || !fits;
    return fits && tl_nav_take_scratch(clearance, near_out->wall_count, sizeof *walls) != NULL;
}

tl_nav_location tl_nav_spot_on_surface(tl_nav_clearance *clearance, tl_nav_met home, tl_nav_spot spot)
{
    const tl_navmesh *navmesh = clearance->navmesh;
    tl_nav_location at = { TL_NAV_NO_REF, { (float)spot.x, 0.0f, (float)spot.z } };
    tl_nav_scratch scratch = clearance->scratch;
    tl_nav_near_walls near;
    // All polygons of a small square around it.
    double half = 4.0 * clearance->slack;
    tl_nav_spot square[4] = { { spot.x - half, spot.z - half },
                              { spot.x - half, spot.z + half },
                              { spot.x + half, spot.z + half },
                              { spot.x + half, spot.z - half } };
    tl_nav_shape touch = tl_nav_shape_make(square, 4, clearance->slack, clearance->slack);
    if (!tl_nav_is_over(navmesh->slots[home.slot].tile, home.polygon, at.point)) {
        tl_nav_begin_walls(clearance, &near);
        if (meet_polygon(clearance, &near, home.slot, home.polygon) && meet_touched(clearance, &touch, &near)) {
            for (uint32_t i = 0; i < near.met_count; i++) {
                tl_nav_met met = *(near.met - i);
                home = tl_nav_is_over(navmesh->slots[met.slot].tile, met.polygon, at.point) ? met : home;
            }
        }
    }
    clearance->scratch = scratch;
    at.polygon = tl_nav_make_ref(navmesh, home.slot, home.polygon);
    at.point.y = tl_nav_surface_height(navmesh->slots[home.slot].tile, home.polygon, at.point.x, at.point.z);
    return at;
}
