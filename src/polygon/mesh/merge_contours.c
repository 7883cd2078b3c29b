// SPDX-License-Identifier: MIT
//
// A region whose outline came in several contours is divided contour by contour, and polygons that meet at the seam are
// left apart. Here all polygons of one region and area are merged once more: as fans, whose inner edges are removed
// first, so that each is whole again before the seams are tried.

#include "polygon/mesh/merge_contours.h"

#include "base/assert.h"
#include "base/radix_sort.h"
#include "polygon/optimal/divide_outline.h"
#include "polygon/triangulate/fans.h"

// Members of one region and area, by rising number; values of sorted items.
static bool has_seam(const tl_polygon_store *store, const tl_sort_item *members, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        if (store->polygons[members[i].value].contour != store->polygons[members[0].value].contour) {
            return true;
        }
    }
    return false;
}

// Parts that hold several members take their place.
static tl_result replace(tl_polygon_store *store, tl_arena *scratch, const tl_sort_item *members, uint32_t count,
                         const tl_convex_parts *parts)
{
    uint32_t *held = TL_PUSH_ZERO(scratch, uint32_t, parts->count);
    tl_stored_polygon *of = TL_PUSH(scratch, tl_stored_polygon, parts->count);
    if (held == NULL || of == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t triangle = 0;
    for (uint32_t i = 0; i < count; i++) {
        const tl_stored_polygon *polygon = &store->polygons[members[i].value];
        uint32_t part = parts->part_of[triangle];
        if (held[part]++ == 0) {
            of[part] = *polygon;
        } else if (of[part].contour != polygon->contour) {
            of[part].contour = TL_SEVERAL_CONTOURS;
        }
        triangle += polygon->count - 2;
    }
    triangle = 0;
    for (uint32_t i = 0; i < count; i++) {
        tl_stored_polygon *polygon = &store->polygons[members[i].value];
        uint32_t part = parts->part_of[triangle];
        triangle += polygon->count - 2;
        polygon->count = held[part] > 1 ? 0 : polygon->count;
    }
    for (uint32_t p = 0; p < parts->count; p++) {
        if (held[p] > 1) {
            TL_TRY(tl_polygon_store_add(store, parts->corners + parts->first[p], parts->first[p + 1] - parts->first[p],
                                        NULL, &of[p]));
        }
    }
    return TL_OK;
}

static tl_result merge_members(tl_polygon_store *store, tl_arena *scratch, const tl_lattice_point *points,
                               const tl_sort_item *members, uint32_t count, uint32_t max_corners, uint32_t *gone)
{
    uint32_t triangles = 0;
    for (uint32_t i = 0; i < count; i++) {
        triangles += store->polygons[members[i].value].count - 2;
    }
    tl_fans fans;
    if (!tl_fans_init(&fans, scratch, triangles)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        const tl_stored_polygon *polygon = &store->polygons[members[i].value];
        tl_fans_add(&fans, store->indices + polygon->first, polygon->count, NULL);
    }
    uint32_t pairs = 0;
    TL_TRY(tl_pair_edges(scratch, fans.corners, fans.twins, 3 * triangles, &pairs));
    tl_convex_parts parts;
    const tl_merge_input input = { points, fans.corners, fans.twins, triangles, max_corners, fans.joined, NULL, NULL };
    TL_TRY(tl_merge_triangles(scratch, &input, &parts));
    *gone += count - parts.count;
    return parts.count < count ? replace(store, scratch, members, count, &parts) : TL_OK;
}

tl_result tl_merge_across_contours(tl_polygon_store *store, tl_arena *scratch, uint32_t max_corners, uint32_t *gone)
{
    tl_sort_item *items = TL_PUSH(scratch, tl_sort_item, 2 * (uint64_t)store->polygon_count);
    tl_lattice_point *points = TL_PUSH(scratch, tl_lattice_point, store->vertex_count);
    if (items == NULL || points == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t p = 0; p < store->polygon_count; p++) {
        const tl_stored_polygon *polygon = &store->polygons[p];
        if (polygon->contour != TL_SEVERAL_CONTOURS) {
            tl_sort_item item = { tl_pair_key(polygon->region, polygon->area), p, 0 };
            items[count++] = item;
        }
    }
    tl_radix_sort(items, items + count, count);
    for (uint32_t v = 0; v < store->vertex_count; v++) {
        points[v] = tl_stored_point(store, v);
    }
    uint32_t end;
    for (uint32_t first = 0; first < count; first = end) {
        for (end = first; end < count && items[end].key == items[first].key; end++) {
        }
        if (has_seam(store, items + first, end - first)) {
            tl_arena_mark mark = tl_arena_get_mark(scratch);
            TL_TRY(merge_members(store, scratch, points, items + first, end - first, max_corners, gone));
            tl_arena_rollback(scratch, mark);
        }
    }
    return *gone > 0 ? tl_polygon_store_compact(store, scratch) : TL_OK;
}
