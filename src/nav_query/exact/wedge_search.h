// SPDX-License-Identifier: MIT
//
// The state of an exact search, and how a wedge comes into it.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_SEARCH_H
#define TALUS_SRC_NAV_QUERY_WEDGE_SEARCH_H

#include "math/tolerance.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_query/search/open_items.h"
#include "nav_query/search/root_table.h"

typedef struct wedge_search {
    tl_nav_shortest_search *in;
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    double goal_x, goal_z;
    double rounding;           // metres
    double weight;             // 1 + slack; 1: the shortest path of all is sought
    double detour;             // metres at least from the end of a short cut to the goal; INFINITY: there is none
    tl_nav_search_end trouble; // FOUND: none
    uint32_t only;             // wedge of the current step, while it is the only one
    seen_edge only_edge;       // that it looks through
    uint32_t best;             // the best of several, kept out of the heap
    float best_total;
    bool puts_off;             // wedges that are added are ordered by what the proof needs (total_by)
    const tl_nav_sight *sight; // NULL: a search; else all that is seen from the start is looked for, and no turn taken
} wedge_search;

// Whether a search may go from a polygon into another.
static inline bool may_go(const wedge_search *s, tl_nav_ring_seam from, tl_nav_ring_seam to)
{
    const tl_nav_shortest_search *in = s->in;
    const tl_nav_ring_seam goal = { in->goal_slot, in->goal_polygon };
    if (s->sight != NULL) {
        return true;
    }
    return !tl_nav_leads_astray(s->navmesh, from, to, goal) &&
           (in->filter == NULL || tl_nav_passes(in->filter, s->navmesh->slots[to.slot].tile, to.polygon));
}

// What a wedge is ordered by; `cost`: metres to its root, `rest`: at least from there to the goal.
//
// Without slack it is the least length of a path through the wedge. With slack, and w = 1 + slack, any order will do in
// which no total is above w * (cost + rest), and a path that has arrived counts its length. Wedges end only where a
// path that is known is shorter to all that they see, or as long and sees as much, whatever the order. So until the
// goal is reached some wedge is open, of exact cost, through which a shortest path of all leads, of length L say. Its
// total is at most w * L; and so is the length of the first path that comes out of the heap.
//
// Here wedges stand in the order of the proof while they are nearer to the start, and are expanded if they must be;
// from the middle on the search hurries to the goal. What turns where a longer path has turned already is put off: it
// is searched from where the proof needs it. Source: Pohl, Heuristic Search Viewed as Path Finding in a Graph, 1970;
// Chen, Sturtevant, Necessary and Sufficient Conditions for Avoiding Reopenings in Best First Suboptimal Search with
// General Bounding Functions, AAAI 2021 (such orders; of theirs this is the piecewise convex downward one).
static inline float total_by(const wedge_search *s, double cost, double rest)
{
    const double proof = s->weight * (cost + rest), hurry = cost + (2.0 * s->weight - 1.0) * rest;
    return (float)(s->puts_off || proof < hurry ? proof : hurry);
}

static inline uint32_t new_wedge(wedge_search *s)
{
    tl_nav_query *query = s->query;
    if (query->wedge_count == query->max_nodes) {
        s->trouble = TL_NAV_SEARCH_OUT_OF_NODES;
        return TL_NAV_NO_NODE;
    }
    return query->wedge_count++;
}

// How a way to a vertex compares with those that are known. Where no more can be known, the search is in trouble.
static inline tl_nav_root_rank rank_root(wedge_search *s, uint64_t number, double cost)
{
    tl_nav_root_rank rank = tl_nav_root_rank_of(s->query, number, cost);
    if (rank == TL_NAV_ROOT_NO_ENTRY) {
        s->trouble = TL_NAV_SEARCH_OUT_OF_NODES;
        return TL_NAV_ROOT_WORSE;
    }
    return rank;
}

static inline bool is_first_root(wedge_search *s, uint64_t number, double cost)
{
    bool is_full = false;
    bool is_first = tl_nav_root_is_first(s->query, number, cost, &is_full);
    s->trouble = is_full ? TL_NAV_SEARCH_OUT_OF_NODES : s->trouble;
    return is_first;
}

// Gives a wedge to the heap, or keeps it at hand when it is the best of its step; then the one before goes there.
static inline void offer_wedge(wedge_search *s, uint32_t wedge, float total)
{
    if (s->best == TL_NAV_NO_NODE) {
        s->best = wedge;
        s->best_total = total;
    } else if (total < s->best_total) {
        tl_nav_open_push(s->query, s->best_total, s->best);
        s->best = wedge;
        s->best_total = total;
    } else {
        tl_nav_open_push(s->query, total, wedge);
    }
}

// A wedge that is never expanded: a turn on the way to another one, for whoever reads the path.
static inline uint32_t add_turn(wedge_search *s, uint32_t parent, float root_x, float root_z, double cost)
{
    uint32_t index = new_wedge(s);
    if (index != TL_NAV_NO_NODE) {
        tl_nav_wedge *wedge = &s->query->wedges[index];
        *wedge = s->query->wedges[parent];
        wedge->root_x = root_x;
        wedge->root_z = root_z;
        wedge->cost = cost;
        wedge->parent = parent;
    }
    return index;
}

#endif
