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
#include "base/radix_sort.h"

#include <string.h>

static uint32_t next_polygon_corner(const tl_stored_polygon *polygon, uint32_t place)
{
    return place + 1 < polygon->first + polygon->count ? place + 1 : polygon->first;
}

// All edges by their lower vertex v, in ends[first[v]] to ends[first[v + 1] - 1]: key is the other vertex and, in the
// lowest bit, whether the edge falls to v; value its place; extra its polygon. first[]: [vertex_count + 2], zeroed.
static void gather_edges(const tl_polygon_store *store, uint32_t *first, tl_sort_item *ends)
{
    // A counting sort; first[] is shifted by one while it is filled.
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        const tl_stored_polygon *polygon = &store->polygons[p];
        for (uint32_t place = polygon->first; place < polygon->first + polygon->count; place++) {
            uint32_t from = store->indices[place], to = store->indices[next_polygon_corner(polygon, place)];
            first[(from < to ? from : to) + 2]++;
        }
    }
    for (uint32_t v = 0; v < store->vertex_count; v++) {
        first[v + 2] += first[v + 1];
    }
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        const tl_stored_polygon *polygon = &store->polygons[p];
        for (uint32_t place = polygon->first; place < polygon->first + polygon->count; place++) {
            uint32_t from = store->indices[place], to = store->indices[next_polygon_corner(polygon, place)];
            uint32_t low = from < to ? from : to, high = from < to ? to : from;
            tl_sort_item end = { (uint64_t)high << 1 | (from > to), place, p };
            ends[first[low + 1]++] = end;
        }
    }
}

// Claims of one edge: `rising` of them run up in vertex number, and the others follow.
static void link_claims(tl_polygon_store *store, const tl_sort_item *claims, uint32_t rising, uint32_t falling,
                        tl_polygon_report *report)
{
    const uint32_t pairs = rising < falling ? rising : falling;
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
        uint32_t rising = 0;
        for (end = begin; end < count && ends[end].key >> 1 == ends[begin].key >> 1; end++) {
            rising += (ends[end].key & 1) == 0;
        }
        link_claims(store, ends + begin, rising, end - begin - rising, report);
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
        // Stable: of each direction the earliest come first.
        tl_radix_sort(ends + first[v], spare, first[v + 1] - first[v]);
        link_polygon_edges(store, ends + first[v], first[v + 1] - first[v], report);
    }
    if (contours->border_size > 0) {
        mark_portals(store, contours, report);
    }
    return TL_OK;
}
