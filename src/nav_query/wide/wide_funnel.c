// SPDX-License-Identifier: MIT
//
// The first vertices of a path with clearance: the funnel algorithm over the free pieces of the portals that it
// crosses, and a local path within each polygon where the straight line comes too near to a wall. Most polygons need
// none, and the points on their portals are no vertices; so little is left for pulling taut (wide_pull_taut.c). Source:
// Lee, Preparata, Euclidean Shortest Paths in the Presence of Rectilinear Barriers, 1984.

#include "nav_query/wide/wall_cell.h"
#include "nav_query/wide/wide_search.h"

#include "nav_query/plane/crossing.h"

// The way over one portal, into a polygon.
typedef struct pass {
    tl_nav_spot right, left;
    tl_nav_spot spot; // where the path crosses
    uint32_t slot, polygon;
    uint32_t vertex; // or TL_NAV_NO_NODE
    bool is_corner;  // the path turns here
    bool is_blocked; // a wall is too near to the straight way that leads here
} pass;

typedef struct passes {
    pass *at; // [0]: the start, [count - 1]: the goal; both without width
    uint32_t count;
} passes;

static tl_nav_spot portal_spot(float x, float z)
{
    return tl_nav_spot_make((double)x, (double)z);
}

static bool list_passes(const tl_nav_wide_search *search, passes *all)
{
    const tl_nav_node *nodes = search->clearance->query->nodes;
    for (uint32_t i = search->last; i != TL_NAV_NO_NODE; i = nodes[i].parent) {
        all->count++;
    }
    all->at = tl_nav_take_scratch(search->clearance, all->count, sizeof *all->at);
    if (all->at == NULL) {
        return false;
    }
    uint32_t at = all->count;
    for (uint32_t i = search->last; i != TL_NAV_NO_NODE; i = nodes[i].parent) {
        const tl_nav_wide_portal *portal = &search->portals[i];
        pass *p = &all->at[--at];
        p->right = portal_spot(portal->right_x, portal->right_z);
        p->left = portal_spot(portal->left_x, portal->left_z);
        p->slot = nodes[i].slot;
        p->polygon = nodes[i].polygon;
        p->vertex = TL_NAV_NO_NODE;
        p->is_corner = false;
        p->is_blocked = false;
    }
    pass *ends[2] = { &all->at[0], &all->at[all->count - 1] };
    const tl_nav_wide_end *known[2] = { &search->start, &search->goal };
    for (int e = 0; e < 2; e++) {
        ends[e]->right = ends[e]->left = ends[e]->spot = known[e]->spot;
        ends[e]->is_corner = true;
    }
    return true;
}

// The path turns at `to`; between that and the corner before, `from`, it is straight.
static void put_pass_corners(passes *all, uint32_t from, uint32_t to, tl_nav_spot spot)
{
    all->at[to].spot = spot;
    all->at[to].is_corner = true;
    for (uint32_t i = from + 1; i < to; i++) {
        tl_nav_segment portal = { all->at[i].right, all->at[i].left };
        double share = tl_nav_crossing_share(all->at[from].spot, spot, portal);
        all->at[i].spot = tl_nav_spot_lerp(portal.a, portal.b, share);
    }
}

static void pull_through(passes *all)
{
    uint32_t apex = 0;
    while (apex + 1 < all->count) {
        tl_nav_spot from = all->at[apex].spot;
        uint32_t left = apex;
        uint32_t right = apex;
        tl_nav_spot left_spot = from;
        tl_nav_spot right_spot = from;
        uint32_t corner = all->count - 1;
        tl_nav_spot corner_spot = all->at[corner].spot;
        for (uint32_t i = apex + 1; i < all->count; i++) {
            const pass *p = &all->at[i];
            if (tl_nav_is_same_spot(from, right_spot) || tl_nav_spot_turn(from, right_spot, p->right) <= 0.0) {
                if (!tl_nav_is_same_spot(from, left_spot) && tl_nav_spot_turn(from, left_spot, p->right) < 0.0) {
                    corner = left;
                    corner_spot = left_spot;
                    break;
                }
                right = i;
                right_spot = p->right;
            }
            if (tl_nav_is_same_spot(from, left_spot) || tl_nav_spot_turn(from, left_spot, p->left) >= 0.0) {
                if (!tl_nav_is_same_spot(from, right_spot) && tl_nav_spot_turn(from, right_spot, p->left) > 0.0) {
                    corner = right;
                    corner_spot = right_spot;
                    break;
                }
                left = i;
                left_spot = p->left;
            }
        }
        put_pass_corners(all, apex, corner, corner_spot);
        apex = corner;
    }
}

// The way to pass i leads through the polygon behind the one before.
static bool note_blocked(tl_nav_clearance *clearance, passes *all)
{
    bool fits = true;
    for (uint32_t i = 1; i < all->count && fits; i++) {
        tl_nav_scratch scratch = clearance->scratch;
        tl_nav_wall_cell cell;
        fits = tl_nav_wall_cell_of(clearance, all->at[i - 1].slot, all->at[i - 1].polygon, clearance->reach, &cell);
        all->at[i].is_blocked =
            fits && !tl_nav_is_clear(&cell.near, all->at[i - 1].spot, all->at[i].spot, clearance->least);
        clearance->scratch = scratch;
    }
    return fits;
}

static bool is_clear_in(tl_nav_clearance *clearance, const pass *in, tl_nav_spot from, tl_nav_spot to, bool *fits)
{
    tl_nav_scratch scratch = clearance->scratch;
    tl_nav_wall_cell cell;
    *fits = *fits && tl_nav_wall_cell_of(clearance, in->slot, in->polygon, clearance->reach, &cell);
    bool is_clear = *fits && tl_nav_is_clear(&cell.near, from, to, clearance->least);
    clearance->scratch = scratch;
    return is_clear;
}

// Whether the straight way from a spot in the polygon behind pass `first` to one in that behind pass `last` leads over
// the free pieces of all portals between, and is clear.
static bool is_clear_through(tl_nav_clearance *clearance, const passes *all, tl_nav_spot from, uint32_t first,
                             tl_nav_spot to, uint32_t last, bool *fits)
{
    tl_nav_spot at = from;
    for (uint32_t i = first + 1; i <= last; i++) {
        const pass *p = &all->at[i];
        double right = tl_nav_spot_turn(from, to, p->right);
        double left = tl_nav_spot_turn(from, to, p->left);
        if (!(right > 0.0 && left < 0.0)) {
            return false;
        }
        tl_nav_spot spot = tl_nav_spot_lerp(p->right, p->left, right / (right - left));
        if (!is_clear_in(clearance, &all->at[i - 1], at, spot, fits)) {
            return false;
        }
        at = spot;
    }
    return is_clear_in(clearance, &all->at[last], at, to, fits);
}

// Leaves out the vertices on portals that a straight way over the same pieces does without. What forbids a place in a
// polygon reaches to its outline, and never to a piece: so nothing lies between the old way and the new one.
static bool leave_out(tl_nav_clearance *clearance, const passes *all, tl_nav_polyline *path)
{
    bool fits = true;
    for (uint32_t i = 1; i + 1 < all->count && fits; i++) {
        if (all->at[i].vertex == TL_NAV_NO_NODE) {
            continue;
        }
        const tl_nav_polyline_vertex *b = &path->vertices[all->at[i].vertex];
        tl_nav_polyline_vertex *before = &path->vertices[b->before];
        tl_nav_polyline_vertex *next = &path->vertices[b->next];
        uint32_t last = all->at[next->pass].vertex == b->next ? next->pass - 1 : next->pass;
        if (is_clear_through(clearance, all, before->spot, before->pass, next->spot, last, &fits)) {
            before->next = b->next;
            next->before = b->before;
        }
    }
    return fits;
}

bool tl_nav_wide_funnel(const tl_nav_wide_search *search, tl_nav_polyline *path)
{
    tl_nav_clearance *clearance = search->clearance;
    passes all = { NULL, 0 };
    tl_nav_scratch scratch = clearance->scratch;
    if (!list_passes(search, &all)) {
        return false;
    }
    pull_through(&all);
    bool fits = note_blocked(clearance, &all);
    uint32_t behind = TL_NAV_NO_NODE;
    for (uint32_t i = 0; i < all.count && fits; i++) {
        pass *p = &all.at[i];
        if (p->is_corner || p->is_blocked || all.at[i + 1].is_blocked) {
            uint32_t before = behind;
            behind = tl_nav_polyline_insert(path, behind, p->spot, p->slot, p->polygon);
            p->vertex = behind;
            fits = behind != TL_NAV_NO_NODE && (!p->is_blocked || tl_nav_wide_local_path(clearance, path, before));
            for (uint32_t k = before; fits && k != behind && k != TL_NAV_NO_NODE; k = path->vertices[k].next) {
                path->vertices[k].pass = k == before ? path->vertices[k].pass : i - 1;
            }
            if (fits) {
                path->vertices[behind].pass = i;
            }
        }
    }
    fits = fits && leave_out(clearance, &all, path);
    clearance->scratch = scratch;
    clearance->is_full = clearance->is_full || !fits;
    return fits;
}
