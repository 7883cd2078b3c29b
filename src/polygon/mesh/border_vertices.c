// SPDX-License-Identifier: MIT
//
// Vertices that stand on a tile's border only because two regions meet there are removed, so that the edges of both
// tiles along the border match.
//
// The polygons around such a vertex form one fan from border to border. They are taken out, the hole is divided anew
// without the vertex, and the parts are merged. The vertex stays where that would change the floor: when the border
// bends in it, when the fan falls apart, or when its polygons differ in area type. It also stays where its place is
// that of another vertex too and the polygons of both are of one contour, or at one height: an edge that runs past the
// place would have that vertex inside it.

#include "polygon/mesh/polygon_store.h"

#include "base/assert.h"
#include "polygon/merge/polygon_merge.h"
#include "polygon/outline/outline.h"
#include "polygon/triangulate/triangulate.h"

#include <string.h>

// A polygon at a vertex of a border vertex's place; one list per vertex.
typedef struct incidence {
    uint32_t polygon;
    uint32_t next;
} incidence;

typedef struct remover {
    tl_polygon_store *store;
    tl_arena *scratch;
    uint32_t max_corners;
    uint32_t *first;    // [vertex] list of polygons around it, newest first, or TL_NO_VALUE
    uint8_t *is_listed; // [vertex] a border vertex stands at its place
    incidence *incidences;
    uint32_t incidence_count, incidence_capacity;
} remover;

// One polygon of the fan around a vertex: its outline without it runs from `after` to `before`.
typedef struct fan_blade {
    uint32_t polygon;
    uint32_t corner; // of the vertex in the polygon
    uint32_t after, before;
} fan_blade;

static tl_result add_incidences(remover *r, uint32_t p)
{
    const tl_stored_polygon polygon = r->store->polygons[p];
    for (uint32_t k = 0; k < polygon.count; k++) {
        uint32_t v = r->store->indices[polygon.first + k];
        if (!r->is_listed[v]) {
            continue;
        }
        if (r->incidence_count == r->incidence_capacity) {
            incidence *grown = tl_arena_grow(r->scratch, r->incidences, &r->incidence_capacity, 64, sizeof *grown);
            if (grown == NULL) {
                return TL_ERR_MEMORY;
            }
            r->incidences = grown;
        }
        r->incidences[r->incidence_count].polygon = p;
        r->incidences[r->incidence_count].next = r->first[v];
        r->first[v] = r->incidence_count++;
    }
    return TL_OK;
}

static uint32_t corner_at(const tl_polygon_store *store, const tl_stored_polygon *polygon, uint32_t k)
{
    return store->indices[polygon->first + k % polygon->count];
}

// The lowest vertex of a place, from which next_above leads to the others.
static uint32_t first_at_place(const tl_polygon_store *store, uint32_t vertex)
{
    const int32_t *v = store->vertices + 3 * (size_t)vertex;
    tl_key_table places = store->places; // looked at only: the key is there
    return *tl_key_table_at(&places, tl_pair_key((uint32_t)v[0], (uint32_t)v[2]));
}

// False: there are none.
static bool list_places_of_border_vertices(remover *r)
{
    const tl_polygon_store *store = r->store;
    bool has_any = false;
    for (uint32_t v = 0; v < store->vertex_count; v++) {
        if (store->is_border[v]) {
            has_any = true;
            for (uint32_t w = first_at_place(store, v); w != TL_NO_VALUE; w = store->next_above[w]) {
                r->is_listed[w] = 1;
            }
        }
    }
    return has_any;
}

static uint32_t gather_blades(const remover *r, uint32_t vertex, fan_blade *blades)
{
    uint32_t count = 0;
    for (uint32_t i = r->first[vertex]; i != TL_NO_VALUE; i = r->incidences[i].next) {
        const tl_stored_polygon *polygon = &r->store->polygons[r->incidences[i].polygon];
        if (polygon->count == 0) {
            continue;
        }
        uint32_t k = 0;
        while (corner_at(r->store, polygon, k) != vertex) {
            k++;
        }
        fan_blade blade = { r->incidences[i].polygon, k, corner_at(r->store, polygon, k + 1),
                            corner_at(r->store, polygon, k + polygon->count - 1) };
        if (blades != NULL) {
            blades[count] = blade;
        }
        count++;
    }
    return count;
}

// Orders blades so that each begins where the one before it ends. False: they are not one open fan.
static bool sort_fan(fan_blade *blades, uint32_t count)
{
    uint32_t start = 0;
    uint32_t starts = 0;
    for (uint32_t i = 0; i < count; i++) {
        bool has_earlier = false;
        for (uint32_t j = 0; j < count; j++) {
            has_earlier |= blades[j].before == blades[i].after;
        }
        start = has_earlier ? start : i;
        starts += !has_earlier;
    }
    if (starts != 1) {
        return false;
    }
    for (uint32_t placed = 0; placed < count; placed++) {
        uint32_t pick = start;
        for (uint32_t j = placed; j < count && placed > 0; j++) {
            if (blades[j].after == blades[placed - 1].before) {
                pick = j;
                break;
            }
            pick = count;
        }
        if (pick == count) {
            return false;
        }
        fan_blade t = blades[placed];
        blades[placed] = blades[pick];
        blades[pick] = t;
    }
    return true;
}

// The fan's outline without the vertex: from the border edge behind it to the border edge before it.
static uint32_t walk_around(const tl_polygon_store *store, const fan_blade *blades, uint32_t count, uint32_t *outline)
{
    uint32_t made = 0;
    outline[made++] = blades[0].after;
    for (uint32_t i = 0; i < count; i++) {
        const tl_stored_polygon *polygon = &store->polygons[blades[i].polygon];
        for (uint32_t k = 2; k < polygon->count; k++) {
            outline[made++] = corner_at(store, polygon, blades[i].corner + k);
        }
    }
    return made;
}

static tl_stored_polygon common_origin(const tl_polygon_store *store, const fan_blade *blades, uint32_t count)
{
    tl_stored_polygon of = store->polygons[blades[0].polygon];
    for (uint32_t i = 1; i < count; i++) {
        const tl_stored_polygon *other = &store->polygons[blades[i].polygon];
        of.region = of.region == other->region ? of.region : TL_SEVERAL_REGIONS;
        of.contour = of.contour == other->contour ? of.contour : TL_SEVERAL_CONTOURS;
    }
    return of;
}

static bool same_area(const tl_polygon_store *store, const fan_blade *blades, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        if (store->polygons[blades[i].polygon].area != store->polygons[blades[0].polygon].area) {
            return false;
        }
    }
    return true;
}

static bool has_fan_contour(const tl_polygon_store *store, const fan_blade *blades, uint32_t count, uint32_t contour)
{
    for (uint32_t i = 0; i < count; i++) {
        if (store->polygons[blades[i].polygon].contour == contour) {
            return contour != TL_SEVERAL_CONTOURS;
        }
    }
    return false;
}

static bool is_within_heights(const tl_polygon_store *store, const fan_blade *blades, uint32_t count, int32_t y)
{
    int32_t low = INT32_MAX, high = INT32_MIN;
    for (uint32_t i = 0; i < count; i++) {
        const tl_stored_polygon *polygon = &store->polygons[blades[i].polygon];
        for (uint32_t k = 0; k < polygon->count; k++) {
            const int32_t corner_y = store->vertices[3 * (size_t)corner_at(store, polygon, k) + 1];
            low = corner_y < low ? corner_y : low;
            high = corner_y > high ? corner_y : high;
        }
    }
    return low <= y && y <= high;
}

// Whether another vertex at the place must not lie inside an edge of the fan's polygons.
static bool shares_place(const remover *r, uint32_t vertex, const fan_blade *blades, uint32_t count)
{
    const tl_polygon_store *store = r->store;
    for (uint32_t w = first_at_place(store, vertex); w != TL_NO_VALUE; w = store->next_above[w]) {
        for (uint32_t i = w == vertex ? TL_NO_VALUE : r->first[w]; i != TL_NO_VALUE; i = r->incidences[i].next) {
            const tl_stored_polygon *polygon = &store->polygons[r->incidences[i].polygon];
            if (polygon->count > 0 && (has_fan_contour(store, blades, count, polygon->contour) ||
                                       is_within_heights(store, blades, count, store->vertices[3 * (size_t)w + 1]))) {
                return true;
            }
        }
    }
    return false;
}

static tl_result refill(remover *r, const fan_blade *blades, uint32_t blade_count, const uint32_t *outline,
                        const tl_lattice_point *points, uint32_t count)
{
    uint32_t *triangles = TL_PUSH(r->scratch, uint32_t, 3 * (uint64_t)(count - 2));
    uint32_t *twins = TL_PUSH(r->scratch, uint32_t, 3 * (uint64_t)(count - 2));
    if (triangles == NULL || twins == NULL) {
        return TL_ERR_MEMORY;
    }
    const tl_triangulate_input hole = { points, count, NULL, NULL, TL_EARS_BY_SIZE, NULL };
    TL_TRY(tl_triangulate(r->scratch, &hole, triangles, twins));
    tl_convex_parts parts;
    const tl_merge_input input = { points, triangles, twins, count - 2, r->max_corners, NULL, NULL, NULL };
    TL_TRY(tl_merge_triangles(r->scratch, &input, &parts));
    tl_stored_polygon of = common_origin(r->store, blades, blade_count);
    for (uint32_t i = 0; i < blade_count; i++) {
        r->store->polygons[blades[i].polygon].count = 0;
    }
    for (uint32_t p = 0; p < parts.count; p++) {
        TL_TRY(tl_polygon_store_add(r->store, parts.corners + parts.first[p], parts.first[p + 1] - parts.first[p],
                                    outline, &of));
        TL_TRY(add_incidences(r, r->store->polygon_count - 1));
    }
    return TL_OK;
}

static tl_result remove_vertex(remover *r, uint32_t vertex, bool *gone)
{
    *gone = false;
    uint32_t blade_count = gather_blades(r, vertex, NULL);
    fan_blade *blades = TL_PUSH(r->scratch, fan_blade, blade_count);
    if (blades == NULL) {
        return TL_ERR_MEMORY;
    }
    gather_blades(r, vertex, blades);
    if (blade_count == 0 || !sort_fan(blades, blade_count) || !same_area(r->store, blades, blade_count) ||
        shares_place(r, vertex, blades, blade_count)) {
        return TL_OK;
    }
    tl_lattice_point p = tl_stored_point(r->store, vertex);
    tl_lattice_point behind = tl_stored_point(r->store, blades[blade_count - 1].before);
    tl_lattice_point ahead = tl_stored_point(r->store, blades[0].after);
    if (tl_turn(behind, p, ahead) != 0 || tl_dot2(p, behind, ahead) >= 0) {
        return TL_OK;
    }
    uint64_t room = 1;
    for (uint32_t i = 0; i < blade_count; i++) {
        room += r->store->polygons[blades[i].polygon].count;
    }
    uint32_t *outline = TL_PUSH(r->scratch, uint32_t, room);
    tl_contour_vertex *corners = TL_PUSH_ZERO(r->scratch, tl_contour_vertex, room);
    if (outline == NULL || corners == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = walk_around(r->store, blades, blade_count, outline);
    for (uint32_t i = 0; i < count; i++) {
        const int32_t *v = r->store->vertices + 3 * (size_t)outline[i];
        corners[i].x = v[0];
        corners[i].y = v[1];
        corners[i].z = v[2];
    }
    tl_outline plain;
    TL_TRY(tl_outline_prepare(r->scratch, corners, count, 0, &plain));
    if (!plain.is_plain) {
        return TL_OK;
    }
    *gone = true;
    return refill(r, blades, blade_count, outline, plain.nodes.points, count);
}

tl_result tl_remove_border_vertices(tl_polygon_store *store, tl_arena *scratch, uint32_t max_corners, uint32_t *gone,
                                    uint32_t *kept)
{
    remover r;
    memset(&r, 0, sizeof r);
    r.store = store;
    r.scratch = scratch;
    r.max_corners = max_corners;
    r.first = TL_PUSH(scratch, uint32_t, store->vertex_count);
    r.is_listed = TL_PUSH_ZERO(scratch, uint8_t, store->vertex_count);
    if (r.first == NULL || r.is_listed == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(r.first, 0xff, store->vertex_count * sizeof *r.first);
    if (!list_places_of_border_vertices(&r)) {
        return TL_OK;
    }
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        TL_TRY(add_incidences(&r, p));
    }
    if (r.incidence_count == 0) {
        return TL_OK;
    }
    for (uint32_t v = 0; v < store->vertex_count; v++) {
        if (store->is_border[v]) {
            bool is_removed;
            TL_TRY(remove_vertex(&r, v, &is_removed));
            *gone += is_removed;
            *kept += !is_removed;
        }
    }
    return tl_polygon_store_compact(store, scratch);
}
