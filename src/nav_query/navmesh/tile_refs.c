// SPDX-License-Identifier: MIT
//
// Lookups in the table of tiles: slots, tiles by their place, references to polygons, the links of a polygon and points
// of it.

#include "nav_query/navmesh/navmesh.h"
#include "nav_query/navmesh/ways.h"
#include "nav_query/plane/surface.h"

// The first slot from `slot` on in its chain whose tile is at a place.
static uint32_t first_in_chain(const tl_navmesh *navmesh, uint32_t slot, int64_t tile_x, int64_t tile_z)
{
    while (slot != TL_NAV_NO_SLOT &&
           (navmesh->slots[slot].tile->tile_x != tile_x || navmesh->slots[slot].tile->tile_z != tile_z)) {
        slot = navmesh->slots[slot].next;
    }
    return slot;
}

uint32_t tl_nav_find_slot(const tl_navmesh *navmesh, int64_t tile_x, int64_t tile_z)
{
    if (navmesh->bucket_count == 0 || tile_x < INT32_MIN || tile_x > INT32_MAX || tile_z < INT32_MIN ||
        tile_z > INT32_MAX) {
        return TL_NAV_NO_SLOT;
    }
    return first_in_chain(navmesh, navmesh->buckets[tl_nav_place_bucket(navmesh, (int32_t)tile_x, (int32_t)tile_z)],
                          tile_x, tile_z);
}

uint32_t tl_nav_next_slot(const tl_navmesh *navmesh, uint32_t slot)
{
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    return first_in_chain(navmesh, navmesh->slots[slot].next, tile->tile_x, tile->tile_z);
}

uint32_t tl_nav_find_layer_slot(const tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z)
{
    uint32_t slot = tl_nav_find_slot(navmesh, tile_x, tile_z);
    while (slot != TL_NAV_NO_SLOT && navmesh->slots[slot].tile->layer != layer) {
        slot = tl_nav_next_slot(navmesh, slot);
    }
    return slot;
}

uint32_t tl_navmesh_tile_count(const tl_navmesh *navmesh)
{
    return navmesh->tile_count;
}

uint32_t tl_navmesh_slot_count(const tl_navmesh *navmesh)
{
    return navmesh->slot_count;
}

const tl_nav_tile *tl_navmesh_slot_tile(const tl_navmesh *navmesh, uint32_t slot)
{
    return slot < navmesh->slot_count ? navmesh->slots[slot].tile : NULL;
}

uint64_t tl_navmesh_link_count(const tl_navmesh *navmesh)
{
    return navmesh->link_count;
}

uint64_t tl_navmesh_edit_count(const tl_navmesh *navmesh)
{
    return navmesh->edit.number;
}

tl_nav_ref tl_navmesh_polygon_ref(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
    return tile != NULL && polygon < tile->polygon_count ? tl_nav_make_ref(navmesh, slot, polygon) : TL_NAV_NO_REF;
}

bool tl_nav_split_ref(const tl_navmesh *navmesh, tl_nav_ref ref, uint32_t *slot_out, uint32_t *polygon_out)
{
    uint32_t polygon = (uint32_t)(ref & ((1u << TL_NAV_REF_POLYGON_BITS) - 1));
    uint32_t slot = (uint32_t)(ref >> TL_NAV_REF_POLYGON_BITS) & ((1u << TL_NAV_REF_SLOT_BITS) - 1);
    uint32_t salt = (uint32_t)(ref >> (TL_NAV_REF_POLYGON_BITS + TL_NAV_REF_SLOT_BITS));
    if (slot >= navmesh->slot_count || navmesh->slots[slot].tile == NULL || navmesh->slots[slot].salt != salt ||
        polygon >= navmesh->slots[slot].tile->polygon_count) {
        return false;
    }
    *slot_out = slot;
    *polygon_out = polygon;
    return true;
}

tl_result tl_navmesh_resolve(const tl_navmesh *navmesh, tl_nav_ref ref, const tl_nav_tile **tile_out,
                             uint32_t *polygon_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (tile_out != NULL) {
        *tile_out = NULL;
    }
    if (polygon_out != NULL) {
        *polygon_out = 0;
    }
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, ref, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    if (tile_out != NULL) {
        *tile_out = navmesh->slots[slot].tile;
    }
    if (polygon_out != NULL) {
        *polygon_out = polygon;
    }
    return TL_OK;
}

tl_result tl_navmesh_links(const tl_navmesh *navmesh, tl_nav_ref ref, tl_nav_link *links_out, uint32_t capacity,
                           uint32_t *count_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (navmesh == NULL || count_out == NULL || (links_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (!tl_nav_split_ref(navmesh, ref, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    tl_nav_ways ways = tl_nav_ways_of(navmesh, slot, polygon);
    tl_nav_way way;
    while (tl_nav_ways_next(&ways, &way)) {
        if (*count_out < capacity) {
            tl_nav_link link = { tl_nav_make_ref(navmesh, way.slot, way.polygon), way.edge, way.left, way.right };
            links_out[*count_out] = link;
        }
        (*count_out)++;
    }
    return *count_out <= capacity ? TL_OK : TL_INCOMPLETE;
}

const tl_nav_tile *tl_navmesh_find_layer(const tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z)
{
    uint32_t slot = tl_nav_find_layer_slot(navmesh, tile_x, layer, tile_z);
    return slot != TL_NAV_NO_SLOT ? navmesh->slots[slot].tile : NULL;
}

const tl_nav_tile *tl_navmesh_find_tile(const tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z)
{
    const tl_nav_tile *lowest = NULL;
    for (uint32_t slot = tl_nav_find_slot(navmesh, tile_x, tile_z); slot != TL_NAV_NO_SLOT;
         slot = tl_nav_next_slot(navmesh, slot)) {
        const tl_nav_tile *tile = navmesh->slots[slot].tile;
        lowest = lowest == NULL || tile->layer < lowest->layer ? tile : lowest;
    }
    return lowest;
}

tl_result tl_navmesh_closest_point(const tl_navmesh *navmesh, tl_nav_ref ref, tl_vec3 point, tl_vec3 *closest_out,
                                   bool *inside_out)
{
    uint32_t slot = 0;
    uint32_t polygon = 0;
    bool inside = false;
    if (inside_out != NULL) {
        *inside_out = false;
    }
    if (navmesh == NULL || closest_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *closest_out = tl_vec3_make(0.0f, 0.0f, 0.0f);
    if (!tl_nav_is_finite(point)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!tl_nav_split_ref(navmesh, ref, &slot, &polygon)) {
        return TL_ERR_STALE;
    }
    *closest_out = tl_nav_closest_on_surface(navmesh->slots[slot].tile, polygon, point, &inside);
    if (inside_out != NULL) {
        *inside_out = inside;
    }
    return TL_OK;
}

tl_result tl_navmesh_height(const tl_navmesh *navmesh, tl_nav_ref ref, float x, float z, float *height_out)
{
    tl_vec3 closest;
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (height_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *height_out = 0.0f;
    // A point over the surface is over the polygon: its outline need not be asked.
    if (navmesh != NULL && isfinite(x) && isfinite(z) && tl_nav_split_ref(navmesh, ref, &slot, &polygon) &&
        tl_nav_find_surface_height(navmesh->slots[slot].tile, polygon, x, z, height_out)) {
        return TL_OK;
    }
    tl_result result = tl_navmesh_closest_point(navmesh, ref, tl_vec3_make(x, 0.0f, z), &closest, NULL);
    if (result == TL_OK) {
        *height_out = closest.y;
    }
    return result;
}
