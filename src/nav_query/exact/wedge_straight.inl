// SPDX-License-Identifier: MIT
//
// Straight to the goal: where a root sees it, the straight line is the shortest path of all that lead through the root,
// so its wedges need not be expanded one by one. A line costs a twentieth of them a polygon.
//
// Only a line that is clear of all vertices counts: what touches one within rounding is left to wedges, which know of
// turns. So an answer is the same with and without it.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_STRAIGHT_INL
#define TALUS_SRC_NAV_QUERY_WEDGE_STRAIGHT_INL

#include "nav_query/exact/wedge_links.inl"

// A line from a root to the goal, and where on it the walk is.
typedef struct goal_line {
    double x, z;          // the root
    double on_x, on_z;    // from there to the goal
    double slack;         // of what right_of says
    tl_nav_ring_place at; // the polygon, and the edge by which it was entered, or UINT32_MAX
} goal_line;

static inline goal_line line_to_goal(const wedge_search *s, float x, float z, uint32_t slot, uint32_t polygon)
{
    const tl_nav_ring_place at = { slot, polygon, UINT32_MAX };
    goal_line line = { (double)x, (double)z, s->goal_x - (double)x, s->goal_z - (double)z, 0.0, at };
    line.slack = 2.0 * s->rounding * (fabs(line.on_x) + fabs(line.on_z));
    return line;
}

// How far a vertex lies to the right of the line, times its length.
static inline double right_of_goal_line(const goal_line *line, const tl_vec3 *vertex)
{
    return line->on_x * ((double)vertex->z - line->z) - line->on_z * ((double)vertex->x - line->x);
}

// The edge by which the line leaves the polygon that it is in; `ring->count`: none is clearly the one.
static inline uint32_t clear_exit(const goal_line *line, const tl_nav_ring *ring)
{
    const uint32_t begin = line->at.edge == UINT32_MAX       ? ring->count - 1
                           : line->at.edge + 1 < ring->count ? line->at.edge + 1
                                                             : 0;
    bool was_right = line->at.edge != UINT32_MAX || right_of_goal_line(line, &ring->points[begin]) > line->slack;
    for (uint32_t edge = begin, k = 0; k < ring->count; k++) {
        const uint32_t next = edge + 1 < ring->count ? edge + 1 : 0;
        const double right = right_of_goal_line(line, &ring->points[next]);
        if (right < -line->slack && was_right) {
            return edge;
        }
        if (!(fabs(right) > line->slack)) {
            return ring->count;
        }
        was_right = right > 0.0;
        edge = next;
    }
    return ring->count;
}

// Whether the goal lies clearly beyond an edge, and the root clearly before it.
static inline bool parts_line(const goal_line *line, const tl_vec3 *a, const tl_vec3 *b, double rounding)
{
    const double along_x = (double)b->x - (double)a->x, along_z = (double)b->z - (double)a->z;
    const double root = along_x * (line->z - (double)a->z) - along_z * (line->x - (double)a->x);
    const double goal = root + (along_x * line->on_z - along_z * line->on_x);
    const double slack = 2.0 * rounding * (fabs(along_x) + fabs(along_z));
    return root < -slack && goal > slack;
}

// Takes the line on over an edge: into a wedge of its own. False: it ends there.
static inline bool follow_line(wedge_search *s, goal_line *line, uint32_t edge, const tl_nav_ring *ring)
{
    if (!tl_nav_ring_is_open(tl_nav_ring_to(ring, edge)) ||
        !parts_line(line, &ring->points[edge], &ring->points[edge + 1 < ring->count ? edge + 1 : 0], s->rounding)) {
        return false;
    }
    line->at = tl_nav_ring_twin(s->navmesh, line->at.slot, line->at.polygon, ring, edge);
    return s->in->filter == NULL ||
           tl_nav_passes(s->in->filter, s->navmesh->slots[line->at.slot].tile, line->at.polygon);
}

// The wedges along the line, behind `first`, whose root and limits they share, to the goal's polygon. Returns the last
// one; TL_NAV_NO_NODE: the line is not clear, or there is no room, and no wedge was added.
static inline uint32_t add_line_to_goal(wedge_search *s, goal_line *line, const tl_nav_wedge *first, uint32_t parent)
{
    tl_nav_query *query = s->query;
    const uint32_t before = query->wedge_count;
    for (;;) {
        const uint32_t index = query->wedge_count;
        if (index == query->max_nodes) {
            break;
        }
        tl_nav_wedge *wedge = &query->wedges[query->wedge_count++];
        *wedge = *first;
        wedge->slot = line->at.slot;
        wedge->polygon = line->at.polygon;
        wedge->edge = line->at.edge;
        wedge->parent = parent;
        if (wedge->polygon == s->in->goal_polygon && wedge->slot == s->in->goal_slot) {
            return index;
        }
        const tl_nav_ring ring = tl_nav_ring_at(s->navmesh, line->at.slot, line->at.polygon);
        const uint32_t edge = clear_exit(line, &ring);
        if (edge == ring.count || !follow_line(s, line, edge, &ring)) {
            break;
        }
        parent = index;
    }
    query->wedge_count = before;
    return TL_NAV_NO_NODE;
}

// Straight from the start to the goal, over an edge of its polygon.
static inline uint32_t find_line_from_start(wedge_search *s, uint32_t start)
{
    const tl_nav_wedge first = s->query->wedges[start];
    goal_line line = line_to_goal(s, first.root_x, first.root_z, first.slot, first.polygon);
    const tl_nav_ring ring = tl_nav_ring_at(s->navmesh, first.slot, first.polygon);
    if (s->detour != (double)INFINITY || (first.slot == s->in->goal_slot && first.polygon == s->in->goal_polygon)) {
        return TL_NAV_NO_NODE;
    }
    const uint32_t edge = clear_exit(&line, &ring);
    return edge < ring.count && follow_line(s, &line, edge, &ring) ? add_line_to_goal(s, &line, &first, start)
                                                                   : TL_NAV_NO_NODE;
}

#endif
