// SPDX-License-Identifier: MIT
//
// All polygons that overlap a zone: found by the BVHs of the tiles around it, then tested exactly.

#include "base/assert.h"
#include "nav_query/filter/nav_filter.h"
#include "nav_query/navmesh/tile_walk.h"
#include "nav_query/plane/zone.h"

typedef struct zone_search {
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    const tl_nav_zone_test *zone;
    tl_aabb box;
    tl_nav_ref *polygons;
    uint32_t capacity, count;
} zone_search;

// Whether the own box of a leaf's polygon meets the search's.
static bool polygon_meets_box(const zone_search *search, const tl_nav_tile *tile, const tl_nav_tile_boxes *boxes,
                              uint32_t leaf, const tl_nav_node_box *wanted)
{
    const tl_nav_node_box within = tl_nav_box_within_leaf(boxes, leaf);
    if (tl_nav_node_overlaps(&within, wanted)) {
        return true;
    }
    const tl_nav_surface surface = tl_nav_tile_surface(tile, boxes->nodes[leaf].link & ~TL_NAV_NODE_LEAF);
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < surface.vertex_count; i++) {
        box = tl_aabb_add_point(box, surface.vertices[i]);
    }
    return tl_aabb_overlaps(box, search->box);
}

static void try_in_zone(zone_search *search, uint32_t slot, uint32_t polygon)
{
    const tl_nav_tile *tile = search->navmesh->slots[slot].tile;
    uint32_t corner_count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &corner_count);
    if (!tl_nav_passes(search->filter, tile, polygon) ||
        !tl_nav_zone_meets_polygon(search->zone, corners, corner_count)) {
        return;
    }
    if (search->count < search->capacity) {
        search->polygons[search->count] = tl_nav_make_ref(search->navmesh, slot, polygon);
    }
    search->count++;
}

static void search_tile_in_zone(zone_search *search, uint32_t slot)
{
    const tl_nav_tile *tile = search->navmesh->slots[slot].tile;
    const tl_nav_tile_boxes boxes = tl_nav_tile_boxes_of(tile);
    const tl_nav_node_box wanted = { tl_f32x3_of(search->box.min), tl_f32x3_of(search->box.max) };
    if (!tl_aabb_overlaps(tile->bounds, search->box)) {
        return;
    }
    for (uint32_t i = 0; i < tile->node_count;) {
        const tl_nav_node_box box = tl_nav_box_of_node(&boxes, i);
        const uint32_t link = boxes.nodes[i].link;
        const bool overlaps = tl_nav_node_overlaps(&box, &wanted), is_leaf = (link & TL_NAV_NODE_LEAF) != 0;
        if (overlaps && is_leaf && polygon_meets_box(search, tile, &boxes, i, &wanted)) {
            try_in_zone(search, slot, link & ~TL_NAV_NODE_LEAF);
        }
        i = overlaps || is_leaf ? i + 1 : link;
    }
}

tl_result tl_navmesh_find_polygons(const tl_navmesh *navmesh, const tl_nav_filter *filter, const tl_nav_zone *zone,
                                   const tl_nav_height_range *heights, tl_nav_ref *polygons_out, uint32_t capacity,
                                   uint32_t *count_out)
{
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (navmesh == NULL || zone == NULL || (polygons_out == NULL && capacity > 0) || !tl_nav_filter_is_begun(filter)) {
        return TL_ERR_ARGUMENT;
    }
    const float min_y = heights != NULL ? heights->min : -INFINITY;
    const float max_y = heights != NULL ? heights->max : INFINITY;
    tl_nav_zone_test test;
    TL_TRY(tl_nav_zone_begin(zone, &test));
    if (isnan(min_y) || isnan(max_y)) {
        return TL_ERR_NOT_FINITE;
    }
    tl_aabb box = { { test.min_x, min_y, test.min_z }, { test.max_x, max_y, test.max_z } };
    zone_search search = { navmesh, filter, &test, box, polygons_out, capacity, 0 };
    tl_nav_tile_walk walk = tl_nav_tiles_over(navmesh, box);
    for (uint32_t slot = 0; (slot = tl_nav_next_tile(&walk)) != TL_NAV_NO_SLOT;) {
        search_tile_in_zone(&search, slot);
    }
    *count_out = search.count;
    return search.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
