// SPDX-License-Identifier: MIT
//
// The list is sorted by island (connected component), so that an island is a range of it, and a random area is turned
// into a polygon by binary search, on all of the navmesh or on one island.

#include "nav_audit/polygon_list.h"

#include "base/arena.h"
#include "base/radix_sort.h"

#include <string.h>

static uint64_t count_polygons(const tl_navmesh *navmesh)
{
    uint64_t count = 0;
    for (uint32_t slot = 0; navmesh != NULL && slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        count += tile != NULL ? tile->polygon_count : 0;
    }
    return count;
}

static void fill_polygons(const tl_navmesh *navmesh, tl_audit_polygon *polygons, tl_sort_item *items)
{
    uint32_t at = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++, at++) {
            const tl_audit_polygon polygon = { tl_navmesh_polygon_ref(navmesh, slot, p), tile, p, 0, 0.0, 0 };
            polygons[at] = polygon;
            (void)tl_navmesh_island(navmesh, polygon.ref, &polygons[at].island);
            items[at].key = polygons[at].island;
            items[at].value = at;
            items[at].extra = 0;
        }
    }
}

static void sort_by_island(tl_audit_polygon_list *list, const tl_audit_polygon *unsorted, tl_sort_item *items)
{
    tl_radix_sort(items, items + list->count, list->count);
    for (uint32_t i = 0; i < list->count; i++) {
        list->polygons[i] = unsorted[items[i].value];
        list->polygons[i].area_before = list->area;
        list->area += tl_nav_tile_polygon_area(list->polygons[i].tile, list->polygons[i].polygon);
    }
}

tl_result tl_audit_list_polygons(const tl_navmesh *navmesh, const tl_allocator *allocator,
                                 tl_audit_polygon_list *list_out)
{
    const uint64_t count = count_polygons(navmesh);
    memset(list_out, 0, sizeof *list_out);
    list_out->allocator = allocator;
    if (count == 0) {
        return TL_OK;
    }
    if (count > UINT32_MAX / 2) {
        return TL_ERR_LIMIT;
    }
    list_out->count = (uint32_t)count;
    list_out->polygons = tl_allocate_array(allocator, count, sizeof *list_out->polygons);
    tl_audit_polygon *unsorted = tl_allocate_array(allocator, count, sizeof *unsorted);
    tl_sort_item *items = tl_allocate_array(allocator, 2 * count, sizeof *items);
    const bool fits = list_out->polygons != NULL && unsorted != NULL && items != NULL;
    if (fits) {
        fill_polygons(navmesh, unsorted, items);
        sort_by_island(list_out, unsorted, items);
    } else {
        tl_audit_polygons_free(list_out);
    }
    tl_release_array(allocator, unsorted, count, sizeof *unsorted);
    tl_release_array(allocator, items, 2 * count, sizeof *items);
    return fits ? TL_OK : TL_ERR_MEMORY;
}

void tl_audit_polygons_free(tl_audit_polygon_list *list)
{
    tl_release_array(list->allocator, list->polygons, list->count, sizeof *list->polygons);
    list->polygons = NULL;
    list->count = 0;
}

double tl_audit_area_before(const tl_audit_polygon_list *list, uint32_t index)
{
    return index < list->count ? list->polygons[index].area_before : list->area;
}

uint32_t tl_audit_island_around(const tl_audit_polygon_list *list, uint32_t index, uint32_t *begin_out)
{
    const tl_audit_polygon *all = list->polygons;
    const uint32_t island = all[index].island;
    uint32_t low = 0, high = index; // the first of the island lies in [low, high]
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (all[middle].island < island) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    *begin_out = low;
    uint32_t end = index + 1, past = list->count; // the first behind it in [end, past]
    while (end < past) {
        const uint32_t middle = end + (past - end) / 2;
        if (all[middle].island == island) {
            end = middle + 1;
        } else {
            past = middle;
        }
    }
    return end;
}
