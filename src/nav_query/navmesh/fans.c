// SPDX-License-Identifier: MIT
//
// Vertices at which a shortest path may turn: those of walls, where the free way around is wider than a half plane.
//
// From a wall the polygons around a vertex are visited one by one, over seams too, up to the next wall: a fan. Its
// vertices in all those rings get one number, so that a search knows them for one place; two fans that touch in a point
// (on two floors, or on two sides of a wall) have two. All other vertices have none. A fan is wider than a half plane
// when one of its edges lies beyond the first one's line, which takes signs only.
// Where a polygon is linked to two floors over the same stretch of a seam, the ways around its ends fork. All vertices
// there count as places to turn at, walls or not.

#include "nav_query/navmesh/fans.h"

#include "base/assert.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/ring_step.h"

#include "math/tolerance.h"

#include <string.h>

typedef struct vertex_fan {
    // The polygons around the vertex have these walls of their own, and this name for it; NULL: they have none.
    tl_nav_ring_walls *walls[TL_NAV_MAX_FAN];
    uint32_t *turns[TL_NAV_MAX_FAN];
    uint32_t count;
    double x, z;             // the vertex
    double first_x, first_z; // along the first edge
    double last_x, last_z;   // along the last one
    bool is_beside;          // it has turned away from its first edge's line, or to where that comes from
    bool is_wide;
    bool is_odd; // walls do not tell on which hand to turn: ways fork, or go more than once around, or too many
} vertex_fan;

// The rings of a slot, to be written.
static const tl_nav_rings *rings_to_write(const tl_navmesh *navmesh, uint32_t slot)
{
    const tl_nav_rings *rings = &navmesh->slots[slot].rings;
    TL_ASSERT(!tl_nav_is_shared(navmesh->history, rings->edges.narrow));
    return rings;
}

static void add_member(tl_navmesh *navmesh, tl_nav_ring_place at, const tl_nav_ring *ring, vertex_fan *f)
{
    const tl_nav_rings *rings = rings_to_write(navmesh, at.slot);
    const uint32_t walls = tl_nav_walls_number(tl_nav_ring_edge_at(ring, at.edge));
    f->walls[f->count] = walls >= TL_NAV_WALLS_FIRST ? &rings->walls[walls] : NULL;
    f->turns[f->count++] = &rings->turns[walls];
}

static void begin_fan(vertex_fan *f, const tl_vec3 *first, const tl_vec3 *first_end)
{
    f->count = 0;
    f->x = (double)first->x;
    f->z = (double)first->z;
    f->first_x = (double)first_end->x - f->x;
    f->first_z = (double)first_end->z - f->z;
    f->is_beside = false;
    f->is_wide = false;
    f->is_odd = false;
}

// A fan turns left from its first edge: while it is no wider than a half plane nothing lies on the right. Around the
// end of a slit nothing need lie there either: the fan comes back to where it began.
static void widen_fan(vertex_fan *f, const tl_vec3 *end)
{
    double dx = (double)end->x - f->x;
    double dz = (double)end->z - f->z;
    f->last_x = dx;
    f->last_z = dz;
    double ahead = f->first_x * dz;
    double aside = f->first_z * dx;
    double error = TL_CROSS_ERROR * (fabs(ahead) + fabs(aside));
    const bool is_left = ahead - aside < -error;
    const bool is_right = ahead - aside > error;
    const double along = f->first_x * dx + f->first_z * dz;
    // Once past the line and back on its left side: the fan winds up a spiral stair, more than once around.
    f->is_odd = f->is_odd || (f->is_wide && is_left);
    f->is_wide = f->is_wide || is_right || (f->is_beside && !is_left && along > 0.0);
    f->is_beside = f->is_beside || is_left || along < 0.0;
}

// Whether a ring runs back at a vertex: links lie over one another there.
static bool forks_at(const tl_nav_rings *rings, const tl_nav_ring *ring, double x, double z)
{
    for (uint32_t i = 0; i < ring->count && rings->has_back; i++) {
        const tl_vec3 *end = &ring->points[i + 1 < ring->count ? i + 1 : 0];
        bool touches = ((double)ring->points[i].x == x && (double)ring->points[i].z == z) ||
                       ((double)end->x == x && (double)end->z == z);
        if (tl_nav_ring_to(ring, i) == TL_NAV_RING_BACK && touches) {
            return true;
        }
    }
    return false;
}

// Gathers the fan that begins with the edge at `begin`, over the edges that end in its vertex; false when it is closed.
static bool gather_fan(tl_navmesh *navmesh, tl_nav_ring_place begin, vertex_fan *f)
{
    tl_nav_ring ring = tl_nav_ring_at(navmesh, begin.slot, begin.polygon);
    begin_fan(f, &ring.points[begin.edge], &ring.points[begin.edge + 1 < ring.count ? begin.edge + 1 : 0]);
    tl_nav_ring_place at = begin;
    for (;;) {
        tl_nav_note_edit(navmesh, at.slot);
        add_member(navmesh, at, &ring, f);
        uint32_t before = at.edge > 0 ? at.edge - 1 : ring.count - 1;
        widen_fan(f, &ring.points[before]);
        f->is_odd =
            f->is_odd || f->count == TL_NAV_MAX_FAN || forks_at(&navmesh->slots[at.slot].rings, &ring, f->x, f->z);
        if (f->count == TL_NAV_MAX_FAN || !tl_nav_ring_is_open(tl_nav_ring_to(&ring, before))) {
            return true;
        }
        at = tl_nav_ring_twin(navmesh, at.slot, at.polygon, &ring, before);
        if (at.slot == begin.slot && at.polygon == begin.polygon && at.edge == begin.edge) {
            return false;
        }
        ring = tl_nav_ring_at(navmesh, at.slot, at.polygon);
    }
}

// ---------------------------------------------------------------------------------------------------------
// Within one tile.

// An edge of a tile's rings, and the ring.
typedef struct tile_place {
    tl_nav_ring ring;
    uint32_t polygon, edge;
} tile_place;

static tile_place tile_place_at(const tl_nav_rings *rings, uint32_t polygon, uint32_t edge)
{
    const tile_place place = { tl_nav_ring_of(rings, polygon), polygon, edge };
    return place;
}

// The same edge as the polygon across has it. False: that is none of the tile.
static inline bool cross_in_tile(const tl_nav_rings *rings, tile_place *at)
{
    const uint32_t to = tl_nav_ring_to(&at->ring, at->edge);
    if (to >= TL_NAV_RING_SEAM) {
        return false;
    }
    *at = tile_place_at(rings, to, tl_nav_inner_twin(rings, at->polygon, at->edge));
    return true;
}

// Among all of the tile's.
static uint64_t edge_of(const tile_place *at)
{
    return (uint64_t)at->ring.first + at->edge;
}

static bool is_ring_portal(tl_nav_ring_edge edge)
{
    return edge.to != TL_NAV_RING_WALL || tl_nav_ring_twin_hint(edge) != 0; // TL_NAV_RING_ON_PORTAL, or closed
}

// Goes to where a fan begins in its tile. True: nowhere, the tile's polygons lie all around. A fan of more polygons
// than are gathered is left where that many have been seen: where far from the origin vertices have the same floats,
// going around one need not come back.
static bool goes_around(const tl_nav_rings *rings, tile_place *at)
{
    const uint64_t from = edge_of(at);
    for (uint32_t i = 1; i < TL_NAV_MAX_FAN && cross_in_tile(rings, at); i++) {
        at->edge = at->edge + 1 < at->ring.count ? at->edge + 1 : 0;
        if (edge_of(at) == from) {
            return true;
        }
    }
    return false;
}

// Gives all edges of a tile's part of a fan the same walls. `own`: the next ones of their own; true when they are
// taken.
static bool assign_walls(const tl_nav_rings *rings, tile_place from, uint32_t own, uint32_t *walls_of)
{
    tile_place at = from;
    const bool is_closed = goes_around(rings, &at);
    const tile_place begin = at;
    const uint64_t first = edge_of(&begin);
    vertex_fan f;
    begin_fan(&f, &begin.ring.points[begin.edge],
              &begin.ring.points[begin.edge + 1 < begin.ring.count ? begin.edge + 1 : 0]);
    bool is_own = !is_closed && is_ring_portal(tl_nav_edge_of(rings, first));
    do {
        walls_of[edge_of(&at)] = own;
        f.count++;
        at.edge = at.edge > 0 ? at.edge - 1 : at.ring.count - 1;
        widen_fan(&f, &at.ring.points[at.edge]);
        const tl_nav_ring_edge edge = tl_nav_ring_edge_at(&at.ring, at.edge);
        is_own = is_own || (edge.to >= TL_NAV_RING_SEAM && is_ring_portal(edge));
    } while (f.count < TL_NAV_MAX_FAN && cross_in_tile(rings, &at) && edge_of(&at) != first);
    // What is too large to be gathered, or is not met on the way back, counts as a place to turn at: it is not known to
    // be none.
    uint32_t *const at_from = &walls_of[edge_of(&from)];
    if (is_own || *at_from != own || f.count == TL_NAV_MAX_FAN || (!is_closed && (f.is_wide || f.is_odd))) {
        *at_from = own;
        return true;
    }
    for (at = begin; f.count > 0; f.count--) {
        walls_of[edge_of(&at)] = is_closed ? TL_NAV_WALLS_NONE : TL_NAV_WALLS_CONVEX;
        at.edge = at.edge > 0 ? at.edge - 1 : at.ring.count - 1;
        cross_in_tile(rings, &at);
    }
    return false;
}

uint32_t tl_nav_assign_walls(const tl_nav_rings *rings, uint32_t *walls_of)
{
    uint32_t walls = TL_NAV_WALLS_FIRST;
    memset(walls_of, 0xff, (size_t)rings->edge_count * sizeof *walls_of);
    for (uint32_t p = 0; p < rings->polygon_count; p++) {
        const tile_place place = tile_place_at(rings, p, 0);
        for (uint32_t i = 0; i < place.ring.count; i++) {
            if (walls_of[place.ring.first + i] == UINT32_MAX) {
                walls += assign_walls(rings, tile_place_at(rings, p, i), walls, walls_of) ? 1 : 0;
            }
        }
    }
    return walls;
}

// ---------------------------------------------------------------------------------------------------------
// Over all tiles.

static void number_fan(tl_navmesh *navmesh, tl_nav_ring_place begin)
{
    vertex_fan f;
    bool is_walled = gather_fan(navmesh, begin, &f);
    uint32_t number = (is_walled && f.is_wide) || f.is_odd ? ++navmesh->last_fan : 0;
    tl_nav_ring_walls walls = { 0.0f, 0.0f, 0.0f, 0.0f };
    if (!f.is_odd) {
        tl_nav_ring_walls known = { (float)f.first_x, (float)f.first_z, (float)f.last_x, (float)f.last_z };
        walls = known;
    }
    for (uint32_t i = 0; i < f.count; i++) {
        // Without walls of its own it is no place to turn at; only where tiles do not meet at their portals can others
        // of the fan be.
        if (f.walls[i] != NULL) {
            *f.walls[i] = walls;
            *f.turns[i] = number;
        }
    }
}

bool tl_nav_find_fan(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ring_place *at)
{
    const tl_nav_ring_place from = *at;
    for (uint32_t i = 0; i < TL_NAV_MAX_FAN; i++) {
        const tl_nav_ring ring = tl_nav_ring_at(navmesh, at->slot, at->polygon);
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, at->edge))) {
            return true;
        }
        tl_nav_ring_place next = tl_nav_ring_twin(navmesh, at->slot, at->polygon, &ring, at->edge);
        if (filter != NULL && !tl_nav_passes(filter, navmesh->slots[next.slot].tile, next.polygon)) {
            return true;
        }
        *at = next;
        const uint32_t count = tl_nav_ring_at(navmesh, at->slot, at->polygon).count;
        at->edge = at->edge + 1 < count ? at->edge + 1 : 0;
        if (at->slot == from.slot && at->polygon == from.polygon && at->edge == from.edge) {
            return false;
        }
    }
    return true;
}

static void number_fans_of(tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    const tl_nav_rings *rings = &navmesh->slots[slot].rings;
    const tl_nav_ring ring = tl_nav_ring_of(rings, polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        tl_nav_ring_place place = { slot, polygon, i };
        const uint32_t to = tl_nav_ring_to(&ring, i);
        if (!tl_nav_ring_is_open(to)) {
            number_fan(navmesh, place);
        } else if ((to & TL_NAV_RING_SEAM) != 0 || rings->has_back) {
            // The fan comes in over a seam: it may begin in a tile that is not looked at.
            tl_nav_find_fan(navmesh, NULL, &place);
            number_fan(navmesh, place);
        }
    }
}

void tl_nav_set_seam_twin(const tl_nav_rings *rings, uint64_t place, uint32_t twin, uint32_t count)
{
    const uint32_t near = twin >> tl_nav_seam_twin_shift(count);
    tl_nav_ring_edge edge = tl_nav_edge_of(rings, place);
    tl_nav_ring_seam *seam = &rings->seams[tl_nav_ring_seam_number(edge.to)];
    seam->slot = (seam->slot & (TL_NAV_MAX_TILES - 1)) | (near >> TL_NAV_RING_TWIN_BITS) * TL_NAV_MAX_TILES;
    edge.mark = (edge.mark & ~(uint32_t)TL_NAV_RING_FAR_TWIN) | (near & TL_NAV_RING_FAR_TWIN);
    tl_nav_set_edge(rings, place, edge);
}

// Over the portals of a side: notes for each edge where its twin stands, and for the twin where the edge does. Portals
// and the edges of a polygon across run along the side in opposite orders, a gap of wall between two at most.
static void find_seam_twins(tl_navmesh *navmesh, uint32_t slot, uint32_t side)
{
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    const tl_nav_portal *portals = tl_nav_tile_portals(tile);
    const tl_nav_rings *rings = rings_to_write(navmesh, slot);
    tl_nav_ring_place last = { TL_NAV_NO_SLOT, 0, 0 };
    uint32_t across_count = 0;
    for (uint32_t i = tl_nav_tile_side_first(tile, side); i < tl_nav_tile_side_first(tile, side + 1); i++) {
        tl_nav_ring_place place = { slot, portals[i].polygon, 0 };
        const tl_nav_ring ring = tl_nav_ring_at(navmesh, slot, place.polygon);
        for (uint32_t k = 0; k < ring.count; k++) {
            if (!tl_nav_ring_is_seam(tl_nav_ring_to(&ring, k))) {
                continue;
            }
            const uint64_t edge = (uint64_t)ring.first + k;
            const tl_nav_ring_seam to = tl_nav_ring_across(navmesh, slot, tl_nav_ring_to(&ring, k));
            if (to.slot == last.slot && to.polygon == last.polygon) {
                tl_nav_set_seam_twin(rings, edge, last.edge > 4 ? last.edge - 4 : 0, across_count);
            }
            last = tl_nav_ring_twin(navmesh, slot, place.polygon, &ring, k);
            const tl_nav_ring across = tl_nav_ring_at(navmesh, last.slot, last.polygon);
            across_count = across.count;
            tl_nav_set_seam_twin(rings, edge, last.edge, across_count);
            // A polygon may reach from side to side: what lies across there keeps its twin where older versions have
            // it. A twin over a seam only says where to look first.
            if (tl_nav_is_shared(navmesh->history, navmesh->slots[last.slot].rings.edges.narrow)) {
                continue;
            }
            // Where tiles do not meet at their portals no edge across is the twin, and any may stand there.
            if (last.edge < across_count && tl_nav_ring_is_seam(tl_nav_ring_to(&across, last.edge))) {
                tl_nav_set_seam_twin(rings_to_write(navmesh, last.slot), (uint64_t)across.first + last.edge, k,
                                     ring.count);
            }
        }
    }
}

void tl_nav_number_fans(tl_navmesh *navmesh, uint32_t slot)
{
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        find_seam_twins(navmesh, slot, side);
    }
    for (uint32_t p = 0; p < navmesh->slots[slot].rings.polygon_count; p++) {
        number_fans_of(navmesh, slot, p);
    }
}

// From where a portal begins in its polygon's ring to where it ends, both included: all of the ring where links of two
// floors run back and forth.
static void number_fans_of_portal(tl_navmesh *navmesh, uint32_t slot, const tl_nav_portal *portal)
{
    const tl_nav_rings *rings = &navmesh->slots[slot].rings;
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    uint32_t corner_count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, portal->polygon, &corner_count);
    uint32_t corner = portal->corner - tl_nav_tile_first_corner(tile, portal->polygon);
    const tl_vec3 begin = corners[corner];
    const tl_vec3 end = corners[corner + 1 < corner_count ? corner + 1 : 0];
    const tl_nav_ring ring = tl_nav_ring_of(rings, portal->polygon);
    uint32_t first = 0;
    while (first + 1 < ring.count && (ring.points[first].x != begin.x || ring.points[first].z != begin.z)) {
        first++;
    }
    for (uint32_t i = 0, at = first; i < ring.count; i++, at = at + 1 < ring.count ? at + 1 : 0) {
        tl_nav_ring_place place = { slot, portal->polygon, at };
        bool is_last = ring.points[at].x == end.x && ring.points[at].z == end.z && !rings->has_back;
        tl_nav_find_fan(navmesh, NULL, &place);
        number_fan(navmesh, place);
        if (is_last) {
            break;
        }
    }
}

void tl_nav_number_fans_on_side(tl_navmesh *navmesh, uint32_t slot, uint32_t side)
{
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    const tl_nav_portal *portals = tl_nav_tile_portals(tile);
    find_seam_twins(navmesh, slot, side);
    for (uint32_t i = tl_nav_tile_side_first(tile, side); i < tl_nav_tile_side_first(tile, side + 1); i++) {
        number_fans_of_portal(navmesh, slot, &portals[i]);
    }
}
