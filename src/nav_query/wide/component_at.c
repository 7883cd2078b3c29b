// SPDX-License-Identifier: MIT
//
// The connected component of a polygon's free pieces that a spot inside it can reach: the polygon is cut in two by a
// line through the spot, which then lies on an outline, and the components of the two halves are joined over the cut.

#include "nav_query/wide/free_pieces.h"

#include "base/disjoint_sets.h"

#include <string.h>

// One side of the cut.
typedef struct half {
    tl_nav_spot corners[TL_NAV_MAX_CORNERS + 2];
    bool is_on_cut[TL_NAV_MAX_CORNERS + 2];
    uint32_t count;
    uint32_t cut_edge;        // that lies on the line; UINT32_MAX: none
    uint32_t first_component; // among the components of both
    tl_nav_pieces pieces;
} half;

static void add_half_corner(half *out, tl_nav_spot corner, bool is_on_cut)
{
    out->corners[out->count] = corner;
    out->is_on_cut[out->count++] = is_on_cut;
}

// The part of an outline on one side, 1 or -1, of the line through a and b.
static void cut_half(const tl_nav_spot *corners, uint32_t count, tl_nav_spot a, tl_nav_spot b, double side, half *out)
{
    memset(out, 0, sizeof *out);
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_spot p = corners[i];
        tl_nav_spot q = corners[i + 1 < count ? i + 1 : 0];
        double own = side * tl_nav_spot_turn(a, b, p);
        double next = side * tl_nav_spot_turn(a, b, q);
        if (own >= 0.0) {
            add_half_corner(out, p, own == 0.0);
        }
        if ((own > 0.0 && next < 0.0) || (own < 0.0 && next > 0.0)) {
            add_half_corner(out, tl_nav_spot_lerp(p, q, own / (own - next)), true);
        }
    }
    // Less than a triangle: the line runs along an edge, or through a corner.
    out->count = out->count < 3 ? 0 : out->count;
    out->cut_edge = UINT32_MAX;
    for (uint32_t i = 0; i < out->count; i++) {
        if (out->is_on_cut[i] && out->is_on_cut[i + 1 < out->count ? i + 1 : 0]) {
            out->cut_edge = i;
        }
    }
}

// Joins components over the stretches of the cut that are free. The halves run along it in opposite directions.
static void join_over_cut(const half halves[2], uint32_t *components)
{
    for (uint32_t i = 0; i < halves[0].pieces.count; i++) {
        const tl_nav_piece *a = &halves[0].pieces.pieces[i];
        for (uint32_t k = 0; k < halves[1].pieces.count && a->edge == halves[0].cut_edge; k++) {
            const tl_nav_piece *b = &halves[1].pieces.pieces[k];
            if (b->edge == halves[1].cut_edge && fmax(a->from, 1.0 - b->to) < fmin(a->to, 1.0 - b->from)) {
                tl_disjoint_sets_unite(components, halves[1].first_component + b->component, a->component);
            }
        }
    }
}

// The joined component of a spot on the cut, or TL_NAV_NO_COMPONENT.
static uint32_t component_on_cut(const half halves[2], uint32_t *components, tl_nav_spot spot, double slack)
{
    for (int h = 0; h < 2; h++) {
        const tl_nav_piece *piece = tl_nav_piece_at(&halves[h].pieces, halves[h].corners, halves[h].count, spot, slack);
        if (piece != NULL) {
            return tl_disjoint_sets_find(components, halves[h].first_component + piece->component);
        }
    }
    return TL_NAV_NO_COMPONENT;
}

// The component of the whole outline's pieces that a joined component has a piece of.
static uint32_t component_of_whole(const half halves[2], uint32_t *components, uint32_t component,
                                   const tl_nav_pieces *pieces, const tl_nav_spot *corners, uint32_t count,
                                   double slack)
{
    for (int h = 0; h < 2; h++) {
        for (uint32_t i = 0; i < halves[h].pieces.count; i++) {
            const tl_nav_piece *piece = &halves[h].pieces.pieces[i];
            if (piece->edge == halves[h].cut_edge ||
                tl_disjoint_sets_find(components, halves[h].first_component + piece->component) != component) {
                continue;
            }
            tl_nav_spot p = halves[h].corners[piece->edge];
            tl_nav_spot q = halves[h].corners[piece->edge + 1 < halves[h].count ? piece->edge + 1 : 0];
            const tl_nav_piece *whole =
                tl_nav_piece_at(pieces, corners, count, tl_nav_spot_lerp(p, q, 0.5 * (piece->from + piece->to)), slack);
            if (whole != NULL) {
                return whole->component;
            }
        }
    }
    return TL_NAV_NO_COMPONENT;
}

bool tl_nav_component_at(tl_nav_clearance *clearance, const tl_nav_wall_cell *cell, const tl_nav_pieces *pieces,
                         tl_nav_spot spot, tl_nav_spot other, uint32_t *component_out, bool *joined_out)
{
    const tl_nav_spot *corners = cell->corners;
    const uint32_t count = cell->count;
    const tl_nav_near_walls *near = &cell->near;
    tl_nav_scratch scratch = clearance->scratch;
    bool is_same = spot.x == other.x && spot.z == other.z;
    tl_nav_spot to = is_same ? tl_nav_spot_make(spot.x + 1.0, spot.z) : other;
    half halves[2];
    cut_half(corners, count, spot, to, 1.0, &halves[0]);
    cut_half(corners, count, spot, to, -1.0, &halves[1]);
    for (int h = 0; h < 2; h++) {
        if (halves[h].count > 0 &&
            !tl_nav_cut_outline(clearance, halves[h].corners, halves[h].count, near, &halves[h].pieces)) {
            return false;
        }
    }
    halves[1].first_component = halves[0].pieces.component_count;
    uint32_t component_count = halves[0].pieces.component_count + halves[1].pieces.component_count;
    uint32_t *components = tl_nav_take_scratch(clearance, component_count, sizeof *components);
    if (components == NULL) {
        return false;
    }
    tl_disjoint_sets_init(components, component_count);
    join_over_cut(halves, components);
    uint32_t component = component_on_cut(halves, components, spot, clearance->slack);
    *component_out = TL_NAV_NO_COMPONENT;
    if (component != TL_NAV_NO_COMPONENT) {
        *component_out = component_of_whole(halves, components, component, pieces, corners, count, clearance->slack);
    }
    if (joined_out != NULL) {
        *joined_out = component != TL_NAV_NO_COMPONENT &&
                      component == component_on_cut(halves, components, other, clearance->slack);
    }
    clearance->scratch = scratch;
    return true;
}
