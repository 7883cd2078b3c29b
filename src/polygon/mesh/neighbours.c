// SPDX-License-Identifier: MIT
//
// Neighbours: two polygons that run along one edge in opposite directions are linked.
//
// Edges are brought together vertex by vertex: each waits at the lower of its two vertices, where there are a handful,
// and those with the same other end are one edge. A hash of vertex pairs was rejected: vertices that are close in the
// mesh are close in number, and a hash throws that away. Should an edge be claimed more than twice, which only floors
// that lie upon each other can cause, the earliest claims are linked and the edge is counted.

#include "polygon/mesh/polygon_store.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/min_max.h"
#include "base/radix_sort.h"

#include <string.h>

enum { POLYGONS_AHEAD = 8, MANY_POLYGONS = 10000 };

static uint32_t next_polygon_corner(const tl_stored_polygon *polygon, uint32_t place)
{
    return place + 1 < polygon->first + polygon->count ? place + 1 : polygon->first;
}

// Polygons come in no order of place: in a large mesh, where their edges are counted is fetched ahead.
static TL_ALWAYS_INLINE void fetch_polygon(const tl_polygon_store *store, const uint32_t *first, uint32_t p)
{
    if (store->polygon_count >= MANY_POLYGONS && POLYGONS_AHEAD < store->polygon_count - p) {
        const tl_stored_polygon *later = &store->polygons[p + POLYGONS_AHEAD];
        for (uint32_t k = 0; k < later->count; k++) {
            tl_prefetch(&first[store->indices[later->first + k] + 1]);
        }
    }
}

// And where they are put, which the former tells.
static TL_ALWAYS_INLINE void fetch_edge_ends(const tl_polygon_store *store, const uint32_t *first,
                                             const tl_sort_item *ends, uint32_t p)
{
    if (store->polygon_count >= MANY_POLYGONS && POLYGONS_AHEAD / 2 < store->polygon_count - p) {
        const tl_stored_polygon *later = &store->polygons[p + POLYGONS_AHEAD / 2];
        const uint32_t *corners = store->indices + later->first;
        uint32_t to = corners[0];
        for (uint32_t k = later->count; k-- > 0;) {
            tl_prefetch(&ends[first[tl_min_u32(corners[k], to) + 1]]);
            to = corners[k];
        }
    }
}

// All edges by their lower vertex v, in ends[first[v]] to ends[first[v + 1] - 1]: key is the other vertex and, in the
// lowest bit, whether the edge falls to v; value its place; extra its polygon. first[]: [vertex_count + 2], zeroed.
static void gather_edges(const tl_polygon_store *store, uint32_t *first, tl_sort_item *ends)
{
    // A counting sort; first[] is shifted by one while it is filled.
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        const tl_stored_polygon *polygon = &store->polygons[p];
        const uint32_t *corners = store->indices + polygon->first;
        fetch_polygon(store, first, p);
        uint32_t to = corners[0];
        for (uint32_t k = polygon->count; k-- > 0;) {
            const uint32_t from = corners[k];
            first[tl_min_u32(from, to) + 2]++;
            to = from;
        }
    }
    for (uint32_t v = 0; v < store->vertex_count; v++) {
        first[v + 2] += first[v + 1];
    }
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        const tl_stored_polygon *polygon = &store->polygons[p];
        const uint32_t *corners = store->indices + polygon->first;
        fetch_polygon(store, first, p);
        fetch_edge_ends(store, first, ends, p);
        uint32_t to = corners[0];
        for (uint32_t k = polygon->count; k-- > 0;) {
            const uint32_t from = corners[k];
            const tl_sort_item end = { (uint64_t)tl_max_u32(from, to) << 1 | (from > to), polygon->first + k, p };
            ends[first[tl_min_u32(from, to) + 1]++] = end;
            to = from;
        }
    }
}

// Claims of one edge: those that run up in vertex number, then the others.
static void link_claims(tl_polygon_store *store, const tl_sort_item *claims, uint32_t count, tl_polygon_report *report)
{
    uint32_t rising = 0;
    while (rising < count && (claims[rising].key & 1) == 0) {
        rising++;
    }
    const uint32_t falling = count - rising, pairs = tl_min_u32(rising, falling);
    for (uint32_t i = 0; i < pairs; i++) {
        const tl_sort_item *up = &claims[i], *down = &claims[rising + i];
        store->neighbours[up->value] = down->extra;
        store->neighbours[down->value] = up->extra;
    }
    report->link_count += pairs;
    report->non_manifold_edges += rising > 1 || falling > 1;
}

static void link_polygon_edges(tl_polygon_store *store, const tl_sort_item *ends, uint32_t count,
                               tl_polygon_report *report)
{
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        end = begin + 1;
        while (end < count && (ends[end].key ^ ends[begin].key) < 2) {
            end++;
        }
        if (end - begin > 1) { // else an edge of the floor's outline
            link_claims(store, ends + begin, end - begin, report);
        }
    }
}

static uint32_t portal_side_of_edge(const tl_polygon_store *store, const tl_contour_set *contours, uint32_t from,
                                    uint32_t to)
{
    tl_lattice_point a = tl_stored_point(store, from);
    tl_lattice_point b = tl_stored_point(store, to);
    if (a.x == 0 && b.x == 0) {
        return TL_PORTAL | 0u;
    }
    if (a.z == contours->height && b.z == contours->height) {
        return TL_PORTAL | 1u;
    }
    if (a.x == contours->width && b.x == contours->width) {
        return TL_PORTAL | 2u;
    }
    if (a.z == 0 && b.z == 0) {
        return TL_PORTAL | 3u;
    }
    return TL_NO_POLYGON;
}

static void mark_portals(tl_polygon_store *store, const tl_contour_set *contours, tl_polygon_report *report)
{
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        const tl_stored_polygon *polygon = &store->polygons[p];
        for (uint32_t place = polygon->first; place < polygon->first + polygon->count; place++) {
            if (store->neighbours[place] == TL_NO_POLYGON) {
                store->neighbours[place] = portal_side_of_edge(store, contours, store->indices[place],
                                                               store->indices[next_polygon_corner(polygon, place)]);
                report->portal_count += store->neighbours[place] != TL_NO_POLYGON;
            }
        }
    }
}

tl_result tl_link_neighbours(tl_polygon_store *store, tl_arena *scratch, const tl_contour_set *contours,
                             tl_polygon_report *report)
{
    store->neighbours = TL_PUSH(store->arena, uint32_t, store->index_count);
    uint32_t *first = TL_PUSH_ZERO(scratch, uint32_t, (uint64_t)store->vertex_count + 2);
    tl_sort_item *ends = TL_PUSH(scratch, tl_sort_item, store->index_count);
    tl_sort_item *spare = TL_PUSH(scratch, tl_sort_item, store->index_count);
    if (store->neighbours == NULL || first == NULL || ends == NULL || spare == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(store->neighbours, 0xff, store->index_count * sizeof *store->neighbours);
    gather_edges(store, first, ends);
    for (uint32_t v = 0; v < store->vertex_count; v++) {
        const uint32_t count = first[v + 1] - first[v];
        // Stable: of each direction the earliest come first. Most vertices have two or three edges, not worth a call.
        if (count <= TL_FEW_SORT_ITEMS) {
            tl_insertion_sort(ends + first[v], count);
        } else {
            tl_radix_sort(ends + first[v], spare, count);
        }
        link_polygon_edges(store, ends + first[v], count, report);
    }
    if (contours->border_size > 0) {
        mark_portals(store, contours, report);
    }
    return TL_OK;
}
