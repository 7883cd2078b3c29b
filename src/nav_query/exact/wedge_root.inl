// SPDX-License-Identifier: MIT
//
// A root of the exact search from which all is open, the start or where a link lands: all polygons that hold it, on an
// edge or in a vertex several, one found from another.

#ifndef TALUS_SRC_NAV_QUERY_WEDGE_ROOT_INL
#define TALUS_SRC_NAV_QUERY_WEDGE_ROOT_INL

#include "nav_query/exact/wedge_step.inl"

enum { MAX_ROOT_HOLDERS = 64 };

// The wedges that hold a root: `first`, and others that follow one another.
typedef struct root_holders {
    uint32_t first, others;
    uint32_t count;
} root_holders;

static inline uint32_t holder_at(const root_holders *holders, uint32_t i)
{
    return i == 0 ? holders->first : holders->others + i - 1;
}

static inline void add_holder(wedge_search *s, root_holders *holders, uint32_t slot, uint32_t polygon, uint32_t parent)
{
    for (uint32_t i = 0; i < holders->count; i++) {
        const tl_nav_wedge *wedge = &s->query->wedges[holder_at(holders, i)];
        if (wedge->slot == slot && wedge->polygon == polygon) {
            return;
        }
    }
    uint32_t index = holders->count < MAX_ROOT_HOLDERS ? new_wedge(s) : TL_NAV_NO_NODE;
    if (index != TL_NAV_NO_NODE) {
        s->query->wedges[index] = s->query->wedges[parent];
        s->query->wedges[index].slot = slot;
        s->query->wedges[index].polygon = polygon;
        s->query->wedges[index].edge = TL_NAV_WEDGE_HOLDS;
        s->query->wedges[index].parent = parent;
        holders->count++;
    }
}

// Goes through the edges of a polygon that holds the root: adds the polygons behind those it lies on, or else looks
// through all others.
static inline void look_out(wedge_search *s, uint32_t index, root_holders *gathered)
{
    const tl_nav_wedge wedge = s->query->wedges[index];
    const wedge_origin root = { wedge.root_x, wedge.root_z, wedge.cost };
    const step_from from = step_from_polygon(s, index, wedge.slot, wedge.polygon);
    for (uint32_t i = 0; i < from.ring.count; i++) {
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&from.ring, i))) {
            continue;
        }
        seen_edge edge = see_edge(&from, i, wedge.root_x, wedge.root_z);
        edge_view v = view_of(s, &edge);
        bool on_edge = v.edge_on && is_root_within(s, &edge);
        if (gathered != NULL && on_edge) {
            tl_nav_ring_seam to = tl_nav_ring_across(s->navmesh, from.slot, tl_nav_ring_to(&from.ring, i));
            const tl_nav_ring_seam here = { from.slot, from.polygon };
            if (may_go(s, here, to)) {
                add_holder(s, gathered, to.slot, to.polygon, index);
            }
        } else if (gathered == NULL && !on_edge && v.edge_on) {
            add_edge_on(s, &from, i, root, &edge);
        } else if (gathered == NULL && !on_edge && v.facing) {
            add_wedge(s, &from, i, root, &edge, edge.left, edge.right);
        }
    }
}

// Looks from the root of wedge `first`, which lies in its polygon, through all edges around it. Where a polygon that
// holds it holds the goal too, and no short cut beats the straight way, that wedge is returned, and there is nothing
// else to look for.
static inline uint32_t look_from_root(wedge_search *s, uint32_t first)
{
    root_holders holders = { first, s->query->wedge_count, 1 };
    for (uint32_t i = 0; i < holders.count; i++) {
        look_out(s, holder_at(&holders, i), &holders);
    }
    for (uint32_t i = 0; i < holders.count; i++) {
        const tl_nav_wedge *wedge = &s->query->wedges[holder_at(&holders, i)];
        if (wedge->slot == s->in->goal_slot && wedge->polygon == s->in->goal_polygon) {
            double straight = way_to(s, wedge, s->goal_x, s->goal_z).length;
            if (straight <= s->detour) {
                return holder_at(&holders, i);
            }
            offer_wedge(s, holder_at(&holders, i), (float)(wedge->cost + straight));
        }
    }
    for (uint32_t i = 0; i < holders.count; i++) {
        const tl_nav_wedge *wedge = &s->query->wedges[holder_at(&holders, i)];
        if (s->navmesh->slots[wedge->slot].anchor_count > 0) {
            cross_wedge_links(s, holder_at(&holders, i));
        }
    }
    for (uint32_t i = 0; i < holders.count; i++) {
        look_out(s, holder_at(&holders, i), NULL);
    }
    return TL_NAV_NO_NODE;
}

#endif
