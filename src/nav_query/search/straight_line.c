// SPDX-License-Identifier: MIT
//
// From polygon to polygon along a line: out of each by the edge whose one end lies right of the line, the other left.
//
// Where a vertex lies on the line no edge does, or two do: from there all polygons that touch the line are gone
// through, each no earlier along it than the one before. A line that only touches walls arrives.

#include "nav_query/search/straight_line.h"

#include "nav_query/plane/nearest_on_edge.h"

#include <math.h>

// Polygons that a line may touch behind the first vertex on it.
enum { MAX_TOUCHED = 256 };

// ---------------------------------------------------------------------------------------------------------
// The polygons that touch the line.

typedef struct touched_polygon {
    uint32_t slot, polygon;
    uint32_t before; // in the list
    double from;     // metres along the line where it is met
} touched_polygon;

typedef struct touched_list {
    const tl_nav_line *line;
    double length;
    uint32_t count;
    touched_polygon polygons[MAX_TOUCHED];
} touched_list;

static bool is_near_line(const tl_nav_line *line, const tl_vec3 *a, const tl_vec3 *b, double x, double z)
{
    return tl_nav_nearest_on_edge(a, b, x, z).distance_sq <= line->rounding * line->rounding;
}

// Where an edge meets the line: between which metres along it. False: it does not. An edge that is met at a small angle
// may be near the line's end, and meet it far off.
static bool meets(const touched_list *list, const tl_vec3 *a, const tl_vec3 *b, double *first_out, double *last_out)
{
    const tl_nav_line *line = list->line;
    const tl_vec3 *ends[2] = { a, b };
    double along[2], off[2];
    for (int i = 0; i < 2; i++) {
        double x = (double)ends[i]->x - line->x;
        double z = (double)ends[i]->z - line->z;
        along[i] = (x * line->on_x + z * line->on_z) / list->length;
        off[i] = (line->on_x * z - line->on_z * x) / list->length;
    }
    double slack = line->rounding;
    if (fabs(off[0]) <= slack && fabs(off[1]) <= slack) {
        *first_out = fmin(along[0], along[1]);
        *last_out = fmax(along[0], along[1]);
    } else if ((off[0] > slack && off[1] > slack) || (off[0] < -slack && off[1] < -slack)) {
        return false;
    } else {
        double t = fmin(fmax(off[0] / (off[0] - off[1]), 0.0), 1.0);
        *first_out = along[0] + t * (along[1] - along[0]);
        *last_out = *first_out;
    }
    if (*first_out > list->length && is_near_line(line, a, b, line->x + line->on_x, line->z + line->on_z)) {
        *first_out = list->length;
        *last_out = fmax(*last_out, list->length);
    }
    if (*last_out < 0.0 && is_near_line(line, a, b, line->x, line->z)) {
        *last_out = 0.0;
    }
    return *first_out <= list->length + slack;
}

static bool is_in(const touched_list *list, uint32_t slot, uint32_t polygon)
{
    for (uint32_t i = 0; i < list->count; i++) {
        if (list->polygons[i].slot == slot && list->polygons[i].polygon == polygon) {
            return true;
        }
    }
    return false;
}

// Whether the line ends in a polygon.
static bool ends_in(const tl_nav_line *line, uint32_t slot, uint32_t polygon, const tl_nav_ring *ring)
{
    const tl_nav_rings *rings = &line->navmesh->slots[slot].rings;
    if (line->turn == 0) {
        return slot == line->slot && polygon == line->polygon;
    }
    for (uint32_t i = 0; i < ring->count; i++) {
        if (tl_nav_turn_of(rings, tl_nav_ring_edge_at(ring, i)) == line->turn) {
            return true;
        }
    }
    return false;
}

static void add_from_last(tl_nav_trail *trail, const touched_list *list, uint32_t last)
{
    uint32_t order[MAX_TOUCHED];
    uint32_t count = 0;
    for (uint32_t i = last; i != UINT32_MAX; i = list->polygons[i].before) {
        order[count++] = i;
    }
    while (count > 0) {
        const touched_polygon *p = &list->polygons[order[--count]];
        tl_nav_add_to_trail(trail, list->line->navmesh, p->slot, p->polygon);
    }
}

// Adds the neighbours of a polygon of the list. False: the list is full.
static bool touch_neighbours(touched_list *list, uint32_t at, const tl_nav_ring *ring)
{
    const touched_polygon from = list->polygons[at];
    for (uint32_t i = 0; i < ring->count; i++) {
        const tl_vec3 *end = &ring->points[i + 1 < ring->count ? i + 1 : 0];
        double first = 0.0;
        double last = 0.0;
        if (!tl_nav_ring_is_open(tl_nav_ring_to(ring, i)) || !meets(list, &ring->points[i], end, &first, &last) ||
            last < from.from - list->line->rounding) {
            continue;
        }
        tl_nav_ring_seam to = tl_nav_ring_across(list->line->navmesh, from.slot, tl_nav_ring_to(ring, i));
        if (is_in(list, to.slot, to.polygon)) {
            continue;
        }
        if (list->count == MAX_TOUCHED) {
            return false;
        }
        touched_polygon next = { to.slot, to.polygon, at, fmax(first, from.from) };
        list->polygons[list->count++] = next;
    }
    return true;
}

static tl_nav_line_end walk_touching(const tl_nav_line *line, uint32_t slot, uint32_t polygon, tl_nav_trail *trail)
{
    touched_list list;
    list.line = line;
    list.length = sqrt(line->on_x * line->on_x + line->on_z * line->on_z);
    list.count = 1;
    touched_polygon begin = { slot, polygon, UINT32_MAX, 0.0 };
    list.polygons[0] = begin;
    for (uint32_t at = 0; at < list.count; at++) {
        const touched_polygon *p = &list.polygons[at];
        const tl_nav_ring ring = tl_nav_ring_at(line->navmesh, p->slot, p->polygon);
        if (ends_in(line, p->slot, p->polygon, &ring)) {
            if (trail != NULL) {
                add_from_last(trail, &list, at);
            }
            return TL_NAV_LINE_ARRIVES;
        }
        if (list.length > 0.0 && !touch_neighbours(&list, at, &ring)) {
            return TL_NAV_LINE_UNCLEAR;
        }
    }
    return TL_NAV_LINE_BLOCKED;
}

// ---------------------------------------------------------------------------------------------------------
// While no vertex is on the line.

// The edge by which the line leaves the polygon in which it begins; `ring->count` when no edge is clearly the one.
static uint32_t first_exit(const tl_nav_line *line, const tl_nav_ring *ring, double slack)
{
    bool was_right = tl_nav_right_of_line(line, &ring->points[ring->count - 1]) > slack;
    for (uint32_t i = 0; i < ring->count; i++) {
        double right = tl_nav_right_of_line(line, &ring->points[i]);
        if (was_right && right < -slack) {
            return i > 0 ? i - 1 : ring->count - 1;
        }
        was_right = right > slack;
    }
    return ring->count;
}

// The same in a polygon that was entered by an edge. Looking in, that starts at its left end.
static uint32_t next_exit(const tl_nav_line *line, const tl_nav_ring *ring, uint32_t entry, double slack)
{
    uint32_t edge = entry + 1 < ring->count ? entry + 1 : 0;
    for (;;) {
        uint32_t end = edge + 1 < ring->count ? edge + 1 : 0;
        double right = tl_nav_right_of_line(line, &ring->points[end]);
        if (right < -slack || end == entry) {
            return edge;
        }
        if (!(right > slack)) {
            return ring->count;
        }
        edge = end;
    }
}

// Whether the line ends beyond an edge.
static bool leaves(const tl_nav_line *line, const tl_vec3 *a, const tl_vec3 *b)
{
    double x = line->x + line->on_x - (double)a->x;
    double z = line->z + line->on_z - (double)a->z;
    return ((double)b->x - (double)a->x) * z - ((double)b->z - (double)a->z) * x > 0.0;
}

tl_nav_line_end tl_nav_walk_line(const tl_nav_line *line, uint32_t slot, uint32_t polygon, tl_nav_trail *trail)
{
    const tl_navmesh *navmesh = line->navmesh;
    double slack = line->rounding * (fabs(line->on_x) + fabs(line->on_z));
    tl_nav_ring_place at = { slot, polygon, UINT32_MAX };
    // A line that does not wind enters no polygon twice.
    for (uint64_t step = 0; step <= navmesh->polygon_count; step++) {
        if (line->turn == 0 && at.slot == line->slot && at.polygon == line->polygon) {
            if (trail != NULL) {
                tl_nav_add_to_trail(trail, navmesh, at.slot, at.polygon);
            }
            return TL_NAV_LINE_ARRIVES;
        }
        const tl_nav_ring ring = tl_nav_ring_at(navmesh, at.slot, at.polygon);
        uint32_t edge = at.edge == UINT32_MAX ? first_exit(line, &ring, slack) : next_exit(line, &ring, at.edge, slack);
        if (edge == ring.count ||
            !leaves(line, &ring.points[edge], &ring.points[edge + 1 < ring.count ? edge + 1 : 0])) {
            return walk_touching(line, at.slot, at.polygon, trail);
        }
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, edge))) {
            return TL_NAV_LINE_BLOCKED;
        }
        if (trail != NULL) {
            tl_nav_add_to_trail(trail, navmesh, at.slot, at.polygon);
        }
        at = tl_nav_ring_twin(navmesh, at.slot, at.polygon, &ring, edge);
    }
    return TL_NAV_LINE_UNCLEAR;
}
