// SPDX-License-Identifier: MIT
//
// Gates: the links over a seam, joined where one can walk along the seam from one to the next in both places.
//
// Lengths between gates are those between their middles, and what they say of other points of a gate rests on that
// walk: from the middle to any point of the gate it is no farther than straight along the seam. So links are joined
// only where both sides' polygons turn around their common corner by a fan of polygons. Where they are not joined there
// are two gates, which costs some bytes and nothing else.

#include "base/arena.h"
#include "base/assert.h"
#include "nav_world/routes.h"

#include <math.h>
#include <string.h>

// A link over a seam.
typedef struct seam_stretch {
    int32_t low, high;
    const tl_nav_tile *tile[2];
    uint32_t polygon[2];
    float heights[2]; // at low and high
    uint32_t next;    // the stretch that goes on, or UINT32_MAX
    bool goes_on;     // another one's next
} seam_stretch;

typedef struct stretch_list {
    seam_stretch *items;
    uint32_t count;
    uint64_t capacity;
} stretch_list;

// ---------------------------------------------------------------------------------------------------------
// Links of a side.

static int32_t lattice_of(float at, float origin, int32_t tile_index, const tl_nav_tile *tile)
{
    const double steps = floor(((double)at - (double)origin) / (double)tile->cell_size + 0.5);
    return (int32_t)(steps - (double)((int64_t)tile_index * (int64_t)tile->tile_size));
}

static tl_result add_seam_stretch(const tl_allocator *allocator, const tl_nav_tile *tile, uint32_t polygon,
                                  const tl_navmesh *navmesh, const tl_nav_link *link, uint32_t side, stretch_list *list)
{
    if (list->count == list->capacity) {
        seam_stretch *grown = tl_grow_array(allocator, list->items, &list->capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        list->items = grown;
    }
    seam_stretch stretch;
    memset(&stretch, 0, sizeof stretch);
    const bool along_x = side == 1;
    const tl_vec3 a = link->left, b = link->right;
    const int32_t at_a = along_x ? lattice_of(a.x, tile->origin.x, tile->tile_x, tile)
                                 : lattice_of(a.z, tile->origin.z, tile->tile_z, tile);
    const int32_t at_b = along_x ? lattice_of(b.x, tile->origin.x, tile->tile_x, tile)
                                 : lattice_of(b.z, tile->origin.z, tile->tile_z, tile);
    stretch.low = at_a < at_b ? at_a : at_b;
    stretch.high = at_a < at_b ? at_b : at_a;
    stretch.heights[0] = at_a < at_b ? a.y : b.y;
    stretch.heights[1] = at_a < at_b ? b.y : a.y;
    stretch.tile[0] = tile;
    stretch.polygon[0] = polygon;
    stretch.next = UINT32_MAX;
    TL_TRY(tl_navmesh_resolve(navmesh, link->to, &stretch.tile[1], &stretch.polygon[1]));
    list->items[list->count++] = stretch;
    return TL_OK;
}

// The links of a polygon to the place across a side.
static tl_result add_polygon_links(const tl_allocator *allocator, const tl_navmesh *navmesh, uint32_t slot,
                                   const tl_nav_portal *portal, uint32_t side, stretch_list *list)
{
    enum { FEW = 32 };
    tl_nav_link few[FEW];
    tl_nav_link *links = few;
    uint32_t count = 0;
    const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
    const tl_nav_ref ref = tl_navmesh_polygon_ref(navmesh, slot, portal->polygon);
    const uint32_t edge = portal->corner - tl_nav_tile_first_corner(tile, portal->polygon);
    tl_result result = tl_navmesh_links(navmesh, ref, few, FEW, &count);
    uint32_t allocated = 0;
    if (result == TL_INCOMPLETE) {
        allocated = count;
        links = tl_allocate_array(allocator, allocated, sizeof *links);
        result = links == NULL ? TL_ERR_MEMORY : tl_navmesh_links(navmesh, ref, links, allocated, &count);
    }
    for (uint32_t i = 0; result == TL_OK && i < count; i++) {
        const tl_nav_tile *to = NULL;
        result = tl_navmesh_resolve(navmesh, links[i].to, &to, NULL);
        if (result == TL_OK && links[i].edge == edge && (to->tile_x != tile->tile_x || to->tile_z != tile->tile_z)) {
            result = add_seam_stretch(allocator, tile, portal->polygon, navmesh, &links[i], side, list);
        }
    }
    tl_release_array(allocator, allocated > 0 ? links : NULL, allocated, sizeof *links);
    return result;
}

static int compare_numbers(uint64_t a, uint64_t b)
{
    return (a > b) - (a < b);
}

static int compare_stretches(const seam_stretch *a, const seam_stretch *b)
{
    const uint64_t of_a[6] = { (uint64_t)((int64_t)a->low - INT32_MIN),
                               (uint64_t)((int64_t)a->high - INT32_MIN),
                               a->tile[0]->layer,
                               a->polygon[0],
                               a->tile[1]->layer,
                               a->polygon[1] };
    const uint64_t of_b[6] = { (uint64_t)((int64_t)b->low - INT32_MIN),
                               (uint64_t)((int64_t)b->high - INT32_MIN),
                               b->tile[0]->layer,
                               b->polygon[0],
                               b->tile[1]->layer,
                               b->polygon[1] };
    int order = 0;
    for (int i = 0; order == 0 && i < 6; i++) {
        order = compare_numbers(of_a[i], of_b[i]);
    }
    return order;
}

#define TL_HEAP(name)                 last_stretch_##name
#define TL_HEAP_ITEM                  seam_stretch
#define TL_HEAP_BEFORE(context, a, b) (compare_stretches(&(a), &(b)) > 0)
#include "base/heap.inl"

// Heapsort: some tens of stretches, and never quadratic.
static void sort_stretches(seam_stretch *items, uint32_t count)
{
    for (uint32_t i = count / 2; i-- > 0;) {
        last_stretch_sift_down(items, count, i, items[i], NULL);
    }
    for (uint32_t end = count; end > 1;) {
        const seam_stretch last = last_stretch_pop(items, &end, NULL);
        items[end] = last;
    }
}

// ---------------------------------------------------------------------------------------------------------
// From one to the next.

static uint32_t fan_corner(const tl_nav_tile *tile, uint32_t polygon, uint32_t vertex)
{
    const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, polygon);
    for (uint32_t i = corners.begin; i < corners.end; i++) {
        if (tl_nav_tile_corner_vertex(tile, i) == vertex) {
            return i - corners.begin;
        }
    }
    return UINT32_MAX;
}

// The vertex of a polygon at `along` on a side, or UINT32_MAX.
static uint32_t vertex_on_side(const tl_nav_tile *tile, uint32_t polygon, uint32_t side, int32_t along)
{
    const int32_t line = side == 1 || side == 2 ? (int32_t)tile->tile_size : 0;
    const int axis = side % 2 == 0 ? 0 : 2;
    const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, polygon);
    for (uint32_t i = corners.begin; i < corners.end; i++) {
        const uint32_t vertex = tl_nav_tile_corner_vertex(tile, i);
        const tl_nav_lattice_point v = tl_nav_tile_vertex(tile, vertex);
        if (v.at[axis] == line && v.at[2 - axis] == along) {
            return vertex;
        }
    }
    return UINT32_MAX;
}

// Whether a fan of polygons around a vertex leads from one polygon to another within a tile.
static bool fan_leads(const tl_nav_tile *tile, uint32_t from, uint32_t to, uint32_t vertex)
{
    for (uint32_t way = 0; way < 2; way++) {
        uint32_t at = from, before = UINT32_MAX;
        for (uint32_t steps = 0; at != to && steps < tile->polygon_count; steps++) {
            const uint32_t corner = fan_corner(tile, at, vertex);
            uint32_t count = 0;
            (void)tl_nav_tile_corners(tile, at, &count);
            if (corner == UINT32_MAX) {
                break;
            }
            const uint32_t edges[2] = { corner, (corner + count - 1) % count };
            // First by either edge, then by the one it did not come through.
            const uint32_t links[2] = { tl_nav_tile_edge_link(tile, at, edges[0]),
                                        tl_nav_tile_edge_link(tile, at, edges[1]) };
            const uint32_t next = links[before == UINT32_MAX ? way : links[0] == before ? 1 : 0];
            if (next >= tile->polygon_count) {
                break; // a wall or a portal
            }
            before = at;
            at = next;
        }
        if (at == to) {
            return true;
        }
    }
    return false;
}

static bool walks_on(const seam_stretch *a, const seam_stretch *b, int end, uint32_t side)
{
    const tl_nav_tile *tile = a->tile[end];
    if (tile != b->tile[end]) {
        return false;
    }
    if (a->polygon[end] == b->polygon[end]) {
        return true;
    }
    const uint32_t vertex = vertex_on_side(tile, a->polygon[end], side, a->high);
    return vertex != UINT32_MAX && fan_leads(tile, a->polygon[end], b->polygon[end], vertex);
}

// Stretches are sorted by low: those that may go on lie behind.
static void join_stretches(stretch_list *list, uint32_t side)
{
    const uint32_t across = side == 2 ? 0 : 3;
    for (uint32_t i = 0; i < list->count; i++) {
        seam_stretch *from = &list->items[i];
        for (uint32_t j = i + 1; j < list->count && list->items[j].low <= from->high; j++) {
            seam_stretch *to = &list->items[j];
            if (to->low == from->high && !to->goes_on && walks_on(from, to, 0, side) && walks_on(from, to, 1, across)) {
                from->next = j;
                to->goes_on = true;
                break;
            }
        }
    }
}

static tl_result add_gate(const tl_allocator *allocator, const stretch_list *list, uint32_t first, uint32_t side,
                          const int32_t place[2], tl_nav_gate_list *out)
{
    uint32_t last = first;
    while (list->items[last].next != UINT32_MAX) {
        last = list->items[last].next;
    }
    const int64_t low = list->items[first].low, high = list->items[last].high;
    uint32_t middle = first;
    while (2 * (int64_t)list->items[middle].high < low + high) {
        middle = list->items[middle].next;
    }
    const seam_stretch *at = &list->items[middle];
    const double part = (0.5 * (double)(low + high) - (double)at->low) / ((double)at->high - (double)at->low);
    if (out->count == out->capacity) {
        tl_nav_gate *grown = tl_grow_array(allocator, out->gates, &out->capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        out->gates = grown;
    }
    const tl_nav_gate gate = { place[0],
                               place[1],
                               side,
                               (int32_t)low,
                               (int32_t)high,
                               (float)((double)at->heights[0] +
                                       part * ((double)at->heights[1] - (double)at->heights[0])),
                               { at->tile[0]->layer, at->tile[1]->layer },
                               { at->polygon[0], at->polygon[1] } };
    if (out->count >= TL_ROUTE_MAX_GATES) {
        return TL_ERR_LIMIT;
    }
    out->gates[out->count++] = gate;
    return TL_OK;
}

static tl_result find_side_gates(const tl_allocator *allocator, const tl_navmesh *navmesh, uint32_t side,
                                 const int32_t place[2], stretch_list *list, tl_nav_gate_list *out)
{
    list->count = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        if (tile == NULL || tile->tile_x != 0 || tile->tile_z != 0) {
            continue;
        }
        const uint32_t end = tl_nav_tile_side_first(tile, side + 1);
        for (uint32_t p = tl_nav_tile_side_first(tile, side); p < end; p++) {
            TL_TRY(add_polygon_links(allocator, navmesh, slot, &tl_nav_tile_portals(tile)[p], side, list));
        }
    }
    sort_stretches(list->items, list->count);
    join_stretches(list, side);
    for (uint32_t i = 0; i < list->count; i++) {
        if (!list->items[i].goes_on) {
            TL_TRY(add_gate(allocator, list, i, side, place, out));
        }
    }
    return TL_OK;
}

tl_result tl_nav_find_gates(const tl_allocator *allocator, const tl_navmesh *navmesh, int32_t x, int32_t z,
                            tl_nav_gate_list *list)
{
    const int32_t place[2] = { x, z };
    stretch_list stretches = { NULL, 0, 0 };
    tl_result result = find_side_gates(allocator, navmesh, 1, place, &stretches, list);
    if (result == TL_OK) {
        result = find_side_gates(allocator, navmesh, 2, place, &stretches, list);
    }
    tl_release_array(allocator, stretches.items, stretches.capacity, sizeof *stretches.items);
    return result;
}
