// SPDX-License-Identifier: MIT
//
// The nearest polygon: branch and bound over the tiles' box trees, the nearer child first.
//
// The measure punishes floors overhead by the agent's height (nav_query.h), so that a point anywhere on an agent's body
// finds the floor it stands on. Every operation of the bound is monotone and mirrors the measure's own, so rounding
// never prunes the answer, and the result is bit by bit that of trying all polygons. The branches of the bound stay:
// without them, or with both children's boxes held against the search's at once, it takes 6 to 18% longer.

#include "base/min_max.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/navmesh/offmesh_anchor.h"
#include "nav_query/navmesh/tile_walk.h"
#include "nav_query/plane/surface.h"

typedef struct nearest_search {
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    tl_vec3 center;
    tl_aabb box;
    float best; // squared measure
    uint32_t best_slot, best_polygon;
    tl_vec3 best_point;
    bool on_island; // only polygons of `island` count, anywhere, by their plain distance
    uint32_t island;
    bool any_flags; // polygons that no filter passes count too
} nearest_search;

// The vertical part of the measure for a floor `above` metres over the centre (negative: under it).
static float vertical_measure(const nearest_search *search, const tl_nav_tile *tile, float above)
{
    return !search->on_island && above > tile->agent_max_climb ? above + tile->agent_height : above;
}

static float measure_point(const nearest_search *search, const tl_nav_tile *tile, tl_vec3 point)
{
    float dx = point.x - search->center.x;
    float dz = point.z - search->center.z;
    float dy = vertical_measure(search, tile, point.y - search->center.y);
    return dx * dx + dz * dz + dy * dy;
}

// What boxes are held against in one tile.
typedef struct box_gaps_search {
    tl_nav_tile_boxes boxes;
    tl_f32x3 center;
    tl_nav_node_box box;  // of the search
    float climb, penalty; // a floor more than the one above the centre counts as the other farther
} box_gaps_search;

static box_gaps_search begin_boxes(const nearest_search *search, const tl_nav_tile *tile)
{
    const box_gaps_search s = { tl_nav_tile_boxes_of(tile),
                                tl_f32x3_of(search->center),
                                { tl_f32x3_of(search->box.min), tl_f32x3_of(search->box.max) },
                                tile->agent_max_climb,
                                tile->agent_height };
    return s;
}

typedef struct pending_tile_node {
    uint32_t node;
    float bound; // NaN: it has nothing for the search
} pending_tile_node;

// The distances to a box along the axes, 0 within.
static inline tl_vec3 gaps_to_box(const box_gaps_search *s, const tl_nav_node_box *box)
{
    const tl_f32x3 below = tl_f32x3_sub(box->min, s->center), above = tl_f32x3_sub(s->center, box->max);
    return tl_f32x3_get(tl_f32x3_max(tl_f32x3_max(below, above), tl_f32x3_of(tl_vec3_make(0.0f, 0.0f, 0.0f))));
}

// The least measure that any point of a node's box can have.
static inline pending_tile_node look_at_node(const box_gaps_search *s, uint32_t node)
{
    const tl_nav_node_box box = tl_nav_box_of_node(&s->boxes, node);
    const tl_vec3 gap = gaps_to_box(s, &box);
    pending_tile_node pending = { node, NAN };
    if (tl_nav_node_overlaps(&box, &s->box)) {
        const bool is_above = gap.y > s->climb && tl_f32x3_get(box.min).y > tl_f32x3_get(s->center).y;
        const float dy = is_above ? gap.y + s->penalty : gap.y;
        pending.bound = gap.x * gap.x + gap.z * gap.z + dy * dy;
    }
    return pending;
}

static void try_nearest(nearest_search *search, uint32_t slot, uint32_t polygon)
{
    const tl_nav_tile *tile = search->navmesh->slots[slot].tile;
    if ((!search->any_flags && !tl_nav_passes(search->filter, tile, polygon)) ||
        (search->on_island && tl_nav_island_of(search->navmesh, slot, polygon) != search->island)) {
        return;
    }
    bool inside = false;
    tl_vec3 point = tl_nav_clamp_to_polygon(tile, polygon, search->center, &inside);
    float dx = point.x - search->center.x;
    float dz = point.z - search->center.z;
    if (dx * dx + dz * dz > search->best) {
        return; // whatever its height
    }
    point.y = tl_nav_surface_height(tile, polygon, point.x, point.z);
    if (!search->on_island && !tl_aabb_contains(search->box, point)) {
        return;
    }
    float distance = measure_point(search, tile, point);
    bool wins_tie = distance == search->best &&
                    (slot < search->best_slot || (slot == search->best_slot && polygon < search->best_polygon));
    if (distance < search->best || wins_tie) {
        search->best = distance;
        search->best_slot = slot;
        search->best_polygon = polygon;
        search->best_point = point;
    }
}

static void search_tile_nearest(nearest_search *search, uint32_t slot)
{
    const box_gaps_search s = begin_boxes(search, search->navmesh->slots[slot].tile);
    // A step down leaves one node behind, so the depth bounds the stack.
    pending_tile_node stack[TL_NAV_MAX_TILE_DEPTH + 1];
    uint32_t depth = 0;
    pending_tile_node at = look_at_node(&s, 0);
    for (;;) {
        if (at.bound <= search->best) {
            const uint32_t link = s.boxes.nodes[at.node].link;
            if ((link & TL_NAV_NODE_LEAF) == 0) {
                const pending_tile_node a = look_at_node(&s, at.node + 1);
                const pending_tile_node b = look_at_node(&s, tl_nav_tile_node_skip(s.boxes.nodes, at.node + 1));
                const bool ordered = a.bound <= b.bound;
                stack[depth++] = ordered ? b : a;
                at = ordered ? a : b;
                continue;
            }
            try_nearest(search, slot, link & ~TL_NAV_NODE_LEAF);
        }
        if (depth == 0) {
            return;
        }
        at = stack[--depth];
    }
}

// The squared distance to a box.
static inline pending_tile_node measure_node(const box_gaps_search *s, uint32_t node)
{
    const tl_nav_node_box box = tl_nav_box_of_node(&s->boxes, node);
    const tl_vec3 gap = gaps_to_box(s, &box);
    const pending_tile_node pending = { node, gap.x * gap.x + gap.z * gap.z + gap.y * gap.y };
    return pending;
}

// More components than this are not asked one by one: there are some in each bit.
enum { MAX_MASKED_COMPONENTS = 256 };

static bool is_component_on_island(const nearest_search *search, const tl_nav_rings *rings, uint32_t component)
{
    const tl_nav_islands *islands = &search->navmesh->islands;
    const uint32_t label = islands->nodes[tl_nav_ring_islands(rings)[component]].labels[TL_NAV_ISLANDS];
    return tl_nav_label_root(islands->labels[TL_NAV_ISLANDS], label) == search->island;
}

// The bits of a tile's components that are on the island. 0: none is.
static uint32_t bits_on_island(const nearest_search *search, const tl_nav_rings *rings)
{
    uint32_t bits = rings->component_count > MAX_MASKED_COMPONENTS ? UINT32_MAX : 0;
    for (uint32_t i = 0; i < rings->component_count && bits != UINT32_MAX; i++) {
        bits |= is_component_on_island(search, rings, i) ? tl_nav_component_bit(rings, i) : 0;
    }
    return bits & ~TL_NAV_MIXED_COMPONENTS;
}

// The same for the nearest polygon of an island: all polygons around a point that cannot be reached are of others, so
// what holds only components of other islands is left out as a whole.
static void search_tile_on_island(nearest_search *search, uint32_t slot)
{
    const box_gaps_search s = begin_boxes(search, search->navmesh->slots[slot].tile);
    const tl_nav_rings *rings = &search->navmesh->slots[slot].rings;
    const uint32_t bits = bits_on_island(search, rings);
    if (bits == 0) {
        return;
    }
    pending_tile_node stack[TL_NAV_MAX_TILE_DEPTH + 1];
    uint32_t depth = 0;
    pending_tile_node at = measure_node(&s, 0);
    uint32_t known = TL_NAV_MIXED_COMPONENTS; // the component that was asked for last
    bool known_is_on = false;
    for (;;) {
        const uint32_t component = tl_nav_node_component(rings, at.node);
        bool is_on = at.bound <= search->best;
        if (is_on && (component & TL_NAV_MIXED_COMPONENTS) != 0) {
            is_on = (component & bits) != 0;
        } else if (is_on) {
            known_is_on = component == known ? known_is_on : is_component_on_island(search, rings, component);
            known = component;
            is_on = known_is_on;
        }
        const uint32_t link = s.boxes.nodes[at.node].link;
        if (is_on && (link & TL_NAV_NODE_LEAF) == 0) {
            const pending_tile_node a = measure_node(&s, at.node + 1);
            const pending_tile_node b = measure_node(&s, tl_nav_tile_node_skip(s.boxes.nodes, at.node + 1));
            const bool ordered = a.bound <= b.bound;
            stack[depth++] = ordered ? b : a;
            at = ordered ? a : b;
            continue;
        }
        if (is_on) {
            try_nearest(search, slot, link & ~TL_NAV_NODE_LEAF);
        }
        if (depth == 0) {
            return;
        }
        at = stack[--depth];
    }
}

static void search_place(nearest_search *search, int64_t x, int64_t z)
{
    const tl_navmesh *navmesh = search->navmesh;
    for (uint32_t slot = tl_nav_find_slot(navmesh, x, z); slot != TL_NAV_NO_SLOT;
         slot = tl_nav_next_slot(navmesh, slot)) {
        search_tile_nearest(search, slot);
    }
}

// How far a place of the grid is from the centre along one axis, in metres, less a cell for rounding.
static double gap_to_place(const tl_navmesh *navmesh, int64_t place, double origin, double center)
{
    double cell = (double)navmesh->cell_size;
    double low = origin + (double)place * cell * (double)navmesh->tile_size;
    double high = low + cell * (double)navmesh->tile_size;
    double gap = (center < low ? low - center : center - high) - cell;
    return gap > 0.0 ? gap : 0.0;
}

static int64_t tile_place_of(const tl_navmesh *navmesh, double along, int64_t first, int64_t last)
{
    double place = floor(along / ((double)navmesh->cell_size * (double)navmesh->tile_size));
    return place < (double)first ? first : place > (double)last ? last : (int64_t)place;
}

// The places of a box, the centre's own first. What is farther away than the best so far is not even looked up: on
// large worlds that is memory which nobody has touched.
static void search_places(nearest_search *search, const tl_nav_tile_walk *places)
{
    const tl_navmesh *navmesh = search->navmesh;
    const double x = (double)search->center.x;
    const double z = (double)search->center.z;
    const int64_t home_x = tile_place_of(navmesh, x - (double)navmesh->origin.x, places->first_x, places->last_x);
    const int64_t home_z = tile_place_of(navmesh, z - (double)navmesh->origin.z, places->z, places->last_z);
    search_place(search, home_x, home_z);
    for (int64_t place_z = places->z; place_z <= places->last_z; place_z++) {
        double dz = gap_to_place(navmesh, place_z, (double)navmesh->origin.z, z);
        for (int64_t place_x = places->first_x; place_x <= places->last_x; place_x++) {
            double dx = gap_to_place(navmesh, place_x, (double)navmesh->origin.x, x);
            if ((place_x != home_x || place_z != home_z) && dx * dx + dz * dz <= (double)search->best) {
                search_place(search, place_x, place_z);
            }
        }
    }
}

static void search_tiles(nearest_search *search)
{
    tl_nav_tile_walk walk = tl_nav_tiles_over(search->navmesh, search->box);
    if (walk.by_place) {
        search_places(search, &walk);
        return;
    }
    for (uint32_t slot = 0; (slot = tl_nav_next_tile(&walk)) != TL_NAV_NO_SLOT;) {
        search_tile_nearest(search, slot);
    }
}

static tl_result write_nearest(const nearest_search *search, tl_nav_location *location_out)
{
    if (search->best_slot == TL_NAV_NO_SLOT) {
        return TL_NOT_FOUND;
    }
    location_out->polygon = tl_nav_make_ref(search->navmesh, search->best_slot, search->best_polygon);
    location_out->point = search->best_point;
    return TL_OK;
}

tl_result tl_navmesh_find_nearest(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_vec3 center,
                                  tl_vec3 half_extents, tl_nav_location *location_out)
{
    tl_nav_location none = { TL_NAV_NO_REF, { 0.0f, 0.0f, 0.0f } };
    if (location_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *location_out = none;
    if (navmesh == NULL || !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_is_finite(center) || !tl_nav_is_finite(half_extents)) {
        return TL_ERR_NOT_FINITE;
    }
    if (half_extents.x < 0.0f || half_extents.y < 0.0f || half_extents.z < 0.0f) {
        return TL_ERR_ARGUMENT;
    }
    tl_aabb box = { tl_sub(center, half_extents), tl_add(center, half_extents) };
    nearest_search search = {
        navmesh, filter, center, box, INFINITY, TL_NAV_NO_SLOT, TL_NO_POLYGON, { 0.0f, 0.0f, 0.0f }, false, 0, false
    };
    search_tiles(&search);
    return write_nearest(&search, location_out);
}

tl_result tl_nav_find_nearest_of_any_flags(const tl_navmesh *navmesh, tl_vec3 center, tl_vec3 half_extents,
                                           tl_nav_location *location_out)
{
    const tl_aabb box = { tl_sub(center, half_extents), tl_add(center, half_extents) };
    nearest_search search = { navmesh, NULL, center, box, INFINITY, TL_NAV_NO_SLOT, TL_NO_POLYGON, { 0.0f, 0.0f, 0.0f },
                              false,   0,    true };
    search_tiles(&search);
    return write_nearest(&search, location_out);
}

// All tiles, those at the point's own place first: what they hold is most often near, and then most others are done
// with by their first box.
static void search_island(nearest_search *search)
{
    const tl_navmesh *navmesh = search->navmesh;
    const double size = (double)navmesh->cell_size * (double)navmesh->tile_size;
    const double x = floor(((double)search->center.x - (double)navmesh->origin.x) / size);
    const double z = floor(((double)search->center.z - (double)navmesh->origin.z) / size);
    const bool has_home = fabs(x) < 2147483647.0 && fabs(z) < 2147483647.0; // false: one tile, which has no size
    const int64_t home_x = has_home ? (int64_t)x : 0;
    const int64_t home_z = has_home ? (int64_t)z : 0;
    for (uint32_t slot = has_home ? tl_nav_find_slot(navmesh, home_x, home_z) : TL_NAV_NO_SLOT; slot != TL_NAV_NO_SLOT;
         slot = tl_nav_next_slot(navmesh, slot)) {
        search_tile_on_island(search, slot);
    }
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        const tl_nav_tile *tile = navmesh->slots[slot].tile;
        if (tile != NULL && !(has_home && tile->tile_x == home_x && tile->tile_z == home_z)) {
            search_tile_on_island(search, slot);
        }
    }
}

tl_result tl_navmesh_find_nearest_reachable(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref from,
                                            tl_vec3 point, tl_nav_location *location_out)
{
    tl_nav_location none = { TL_NAV_NO_REF, { 0.0f, 0.0f, 0.0f } };
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (location_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *location_out = none;
    if (navmesh == NULL || !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_is_finite(point)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!tl_nav_split_ref(navmesh, from, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    tl_aabb everywhere = { { -INFINITY, -INFINITY, -INFINITY }, { INFINITY, INFINITY, INFINITY } };
    nearest_search search = {
        navmesh, filter, point, everywhere, INFINITY, TL_NAV_NO_SLOT, TL_NO_POLYGON, { 0.0f, 0.0f, 0.0f },
        true,    0,      false
    };
    search.island = tl_nav_island_of(navmesh, slot, polygon);
    search_island(&search);
    return write_nearest(&search, location_out);
}
