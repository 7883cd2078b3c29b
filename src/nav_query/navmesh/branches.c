// SPDX-License-Identifier: MIT
//
// Branches: parts of a tile that hang by one edge.
//
// An edge is a bridge when the polygons on both sides of it are connected by no other way. A path that goes over a
// bridge and comes back over it is no shortest one, so of two sides only that of the goal need be searched. Without its
// bridges a tile falls into branches, which bridges join to trees: rooms behind their doors, corridors polygon by
// polygon. All that lies beyond the tile's seams counts as one polygon that is connected with every open seam, so the
// answer holds whatever tiles come and go around this one: they may be connected less than that, never more.
//
// Branches are numbered from the roots of the trees outward, each before those that hang on it; what lies beyond the
// seams, with all that is connected with it by two ways, is 0. Source: Tarjan, A Note on Finding the Bridges of a
// Graph, 1974: a depth-first search, and for each polygon how far back its part of the tree leads over other edges.

#include "nav_query/navmesh/ring_step.h"

#include "base/min_max.h"

#include <string.h>

#define NO_POLYGON UINT32_MAX
#define NO_EDGE    UINT32_MAX

// A depth-first search. What lies beyond the seams was met before all polygons: its place in the order is 0.
typedef struct branch_walk {
    tl_nav_rings *rings;
    uint32_t count;   // of polygons met
    uint32_t *order;  // those, as they were met
    uint32_t *number; // by polygon: its place in the order, from 1; 0: it has not been met
    uint32_t *low;    // the lowest place that it, or what was met from it, leads to over an edge not gone over
    uint32_t *parent; // from which it was met, or NO_POLYGON
    uint32_t *back;   // the edge that leads there, of all the tile's, or NO_EDGE
    uint32_t *next;   // the edge to look at next
} branch_walk;

static void note_met(branch_walk *walk, uint32_t polygon, uint32_t parent, uint32_t back)
{
    walk->order[walk->count++] = polygon;
    walk->number[polygon] = walk->count;
    walk->low[polygon] = walk->count;
    walk->parent[polygon] = parent;
    walk->back[polygon] = back;
    walk->next[polygon] = tl_nav_ring_first(walk->rings, polygon);
}

// Looks at a polygon's next edge. Returns the polygon to go on with.
static uint32_t look_over_next_edge(branch_walk *walk, uint32_t polygon)
{
    const tl_nav_rings *rings = walk->rings;
    const uint32_t edge = walk->next[polygon]++;
    const uint32_t to = tl_nav_edge_of(rings, edge).to;
    if (edge == walk->back[polygon] || !tl_nav_ring_is_open(to)) {
        return polygon;
    }
    if ((to & TL_NAV_RING_SEAM) != 0) {
        walk->low[polygon] = 0;
    } else if (walk->number[to] != 0) {
        walk->low[polygon] = tl_min_u32(walk->low[polygon], walk->number[to]);
    } else {
        const uint32_t twin = tl_nav_inner_twin(rings, polygon, edge - tl_nav_ring_first(rings, polygon));
        note_met(walk, to, polygon, tl_nav_ring_first(rings, to) + twin);
        return to;
    }
    return polygon;
}

// Meets all polygons that can be reached from one within the tile. `back` leads beyond a seam, or is NO_EDGE.
static void walk_from(branch_walk *walk, uint32_t polygon, uint32_t back)
{
    note_met(walk, polygon, NO_POLYGON, back);
    while (polygon != NO_POLYGON) {
        if (walk->next[polygon] < tl_nav_ring_first(walk->rings, polygon + 1)) {
            polygon = look_over_next_edge(walk, polygon);
            continue;
        }
        const uint32_t parent = walk->parent[polygon];
        if (parent != NO_POLYGON) {
            walk->low[parent] = tl_min_u32(walk->low[parent], walk->low[polygon]);
        }
        polygon = parent;
    }
}

// A polygon's first open seam, or NO_EDGE.
static uint32_t first_seam(const tl_nav_rings *rings, uint32_t polygon)
{
    for (uint32_t i = tl_nav_ring_first(rings, polygon); i < tl_nav_ring_first(rings, polygon + 1); i++) {
        if (tl_nav_ring_is_seam(tl_nav_edge_of(rings, i).to)) {
            return i;
        }
    }
    return NO_EDGE;
}

// A polygon from which no way but the one to it leads back is the first of a branch; all others belong to that of the
// polygon from which they were met. `end` holds polygon_count + 1 numbers.
static void number_branches(branch_walk *walk, uint32_t *end)
{
    tl_nav_rings *rings = walk->rings;
    uint32_t branches = 1;
    for (uint32_t i = 0; i < walk->count; i++) {
        const uint32_t polygon = walk->order[i], parent = walk->parent[polygon];
        const bool is_first = walk->low[polygon] == walk->number[polygon];
        const uint32_t branch = is_first ? branches++ : parent != NO_POLYGON ? tl_nav_branch_of(rings, parent) : 0;
        tl_nav_set_ring_number(rings, rings->branch, polygon, branch);
        end[branch] = branches;
    }
    rings->branch_count = branches;
    end[0] = branches;
    for (uint32_t i = walk->count; i > 0; i--) {
        const uint32_t polygon = walk->order[i - 1], parent = walk->parent[polygon];
        if (parent != NO_POLYGON) {
            uint32_t *above = &end[tl_nav_branch_of(rings, parent)];
            *above = tl_max_u32(*above, end[tl_nav_branch_of(rings, polygon)]);
        }
    }
}

const uint32_t *tl_nav_find_branches(tl_nav_rings *rings, uint32_t *scratch)
{
    const uint32_t polygons = rings->polygon_count;
    branch_walk walk = { rings,
                         0,
                         scratch,
                         scratch + polygons,
                         scratch + 2 * (size_t)polygons,
                         scratch + 3 * (size_t)polygons,
                         scratch + 4 * (size_t)polygons,
                         scratch + 5 * (size_t)polygons };
    memset(walk.number, 0, polygons * sizeof *walk.number);
    for (uint32_t p = 0; p < polygons; p++) {
        const uint32_t seam = walk.number[p] == 0 ? first_seam(rings, p) : NO_EDGE;
        if (seam != NO_EDGE) {
            walk_from(&walk, p, seam);
        }
    }
    for (uint32_t p = 0; p < polygons; p++) {
        if (walk.number[p] == 0) {
            walk_from(&walk, p, NO_EDGE);
        }
    }
    // No edge is looked at any more.
    number_branches(&walk, walk.next);
    return walk.next;
}

bool tl_nav_leads_astray_over_seam(const tl_navmesh *navmesh, tl_nav_ring_seam from, tl_nav_ring_seam to,
                                   tl_nav_ring_seam goal)
{
    const tl_nav_slot *out = &navmesh->slots[from.slot], *in = &navmesh->slots[to.slot];
    const uint32_t branch = tl_nav_branch_of(&out->rings, from.polygon);
    const uint32_t into = tl_nav_branch_of(&in->rings, to.polygon);
    // All other branches that are beside a seam hang on what lies beyond, which is numbered 0.
    return (branch != 0 && out->anchor_count == 0 && goal.slot == from.slot &&
            tl_nav_is_on_branch(&out->rings, branch, goal.polygon)) ||
           (into != 0 && in->anchor_count == 0 &&
            !(goal.slot == to.slot && tl_nav_is_on_branch(&in->rings, into, goal.polygon)));
}
