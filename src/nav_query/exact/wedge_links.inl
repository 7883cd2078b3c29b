// SPDX-License-Identifier: MIT
//
// Off-mesh links in the exact search: straight to one end within a wedge's polygon, over, and on from the other end.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_LINKS_INL
#define TALUS_SRC_NAV_QUERY_WEDGE_LINKS_INL

#include "nav_query/exact/wedge_search.h"
#include "nav_query/navmesh/offmesh_anchor.h"

// How a wedge comes to a point of its polygon.
typedef struct wedge_way {
    bool reaches; // false: it does not. Another wedge lies beside it, which does
    bool turns;   // at a vertex of its edge of entry
    float x, z;   // the vertex
    double to_vertex;
    double length; // metres from the root, by way of the vertex
} wedge_way;

static inline wedge_way way_to(const wedge_search *s, const tl_nav_wedge *wedge, double x, double z)
{
    tl_nav_direction point = { x - (double)wedge->root_x, z - (double)wedge->root_z };
    wedge_way way = { true, false, wedge->root_x, wedge->root_z, 0.0, length_of(point) };
    if (wedge->edge >= TL_NAV_WEDGE_LANDS) {
        return way;
    }
    // A point on the wedge's border, as one on the edge of entry may be, lies beside it by rounding only.
    double left_slack = s->rounding * (fabs(wedge->left.x) + fabs(wedge->left.z));
    double right_slack = s->rounding * (fabs(wedge->right.x) + fabs(wedge->right.z));
    bool is_left_of = wedge_cross(wedge->left, point) < -left_slack;
    if (!is_left_of && !(wedge_cross(wedge->right, point) > right_slack)) {
        return way;
    }
    const tl_nav_ring ring = tl_nav_ring_at(s->navmesh, wedge->slot, wedge->polygon);
    const tl_vec3 *vertex = &ring.points[is_left_of ? wedge->edge : wedge->edge + 1 < ring.count ? wedge->edge + 1 : 0];
    tl_nav_direction limit = is_left_of ? wedge->left : wedge->right;
    tl_nav_direction rest = { x - (double)vertex->x, z - (double)vertex->z };
    way.reaches =
        limit.x == (double)vertex->x - (double)wedge->root_x && limit.z == (double)vertex->z - (double)wedge->root_z;
    way.turns = true;
    way.x = vertex->x;
    way.z = vertex->z;
    way.to_vertex = length_of(limit);
    way.length = way.to_vertex + length_of(rest);
    return way;
}

// The wedge that goes straight to where `way` leads: this one, or one that turns.
static inline uint32_t turn_on(wedge_search *s, uint32_t index, const wedge_way *way)
{
    return way->turns ? add_turn(s, index, way->x, way->z, s->query->wedges[index].cost + way->to_vertex) : index;
}

// Numbers of links' ends as roots, beside those of fans and corners.
#define LANDING_NUMBER ((uint64_t)1 << 61)

// Goes to an end of an off-mesh link in a wedge's polygon, and over to the other one.
static inline void cross_wedge_link(wedge_search *s, uint32_t index, uint32_t end)
{
    const tl_nav_offmesh_entry *link = &s->navmesh->offmesh.entries[end / 2];
    const tl_nav_anchor *from = &link->ends[end % 2];
    const tl_nav_anchor *to = &link->ends[1 - end % 2];
    wedge_way way = way_to(s, &s->query->wedges[index], (double)from->point.x, (double)from->point.z);
    double cost = s->query->wedges[index].cost + way.length + link->cost;
    if (!way.reaches || !is_first_root(s, LANDING_NUMBER | end, cost)) {
        return;
    }
    uint32_t parent = turn_on(s, index, &way);
    uint32_t landing = new_wedge(s);
    if (parent == TL_NAV_NO_NODE || landing == TL_NAV_NO_NODE) {
        return;
    }
    tl_nav_wedge wedge = { { 0.0, 0.0 }, { 0.0, 0.0 }, cost,        to->point.x,
                           to->point.z,  to->slot,     to->polygon, TL_NAV_WEDGE_LANDS | end,
                           parent };
    s->query->wedges[landing] = wedge;
    tl_nav_direction goal = { s->goal_x - (double)to->point.x, s->goal_z - (double)to->point.z };
    double rest = length_of(goal);
    offer_wedge(s, landing, total_by(s, cost, rest < s->detour ? rest : s->detour));
}

// All links that can be taken from a wedge's polygon.
static inline void cross_wedge_links(wedge_search *s, uint32_t index)
{
    const tl_navmesh *navmesh = s->navmesh;
    uint32_t slot = s->query->wedges[index].slot;
    uint32_t polygon = s->query->wedges[index].polygon;
    if (s->sight != NULL) {
        return;
    }
    for (uint32_t end = tl_nav_first_anchor(navmesh, slot, polygon); end != TL_NAV_NO_END;) {
        const tl_nav_offmesh_entry *link = &navmesh->offmesh.entries[end / 2];
        const tl_nav_anchor *from = &link->ends[end % 2];
        const tl_nav_anchor *to = &link->ends[1 - end % 2];
        if (from->slot == slot && from->polygon == polygon && tl_nav_may_cross(link, end % 2, s->in->filter) &&
            (s->in->filter == NULL || tl_nav_passes(s->in->filter, navmesh->slots[to->slot].tile, to->polygon))) {
            cross_wedge_link(s, index, end);
        }
        end = from->next;
    }
}

// A path that takes a short cut has the way from its end to the goal before it still. Metres in the plane.
static inline double min_wedge_detour(const wedge_search *s)
{
    const tl_nav_offmesh_table *table = &s->navmesh->offmesh;
    double least = (double)INFINITY;
    for (uint32_t i = 0; i < table->short_count; i++) {
        const tl_nav_offmesh_entry *link = &table->entries[table->short_cuts[i]];
        for (int end = link->offmesh.both_ways ? 0 : 1; end < 2; end++) {
            tl_nav_direction way = { s->goal_x - (double)link->ends[end].point.x,
                                     s->goal_z - (double)link->ends[end].point.z };
            double length = length_of(way);
            least = length < least ? length : least;
        }
    }
    return least;
}

#endif
