// SPDX-License-Identifier: MIT
//
// Flags and areas that change at run time: copy on write, a tile at a time.
//
// Queries read flags and areas in the tile, a load beside others of the same polygon. An overlay beside the tiles would
// make each of them ask twice, and filters' own functions, which take a tile and a polygon, would not see it. A copy
// costs the memory of those tiles alone that are changed, leaves mapped files as they are, and is a tile like any
// other: it can be written, exported and checked. The tile as it was added is kept, so that a rebake that gives the
// same bytes is seen to be the same.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_query/navmesh/navmesh.h"

#include <string.h>
#include <talus/nav_state.h>

enum { NO_AREA = 0 };

tl_result tl_navmesh_polygon_flags(const tl_navmesh *navmesh, tl_nav_ref polygon, uint64_t *flags_out)
{
    uint32_t slot = 0, index = 0;
    if (flags_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *flags_out = 0;
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, polygon, &slot, &index)) {
        return TL_ERR_STALE;
    }
    *flags_out = tl_nav_tile_flags(navmesh->slots[slot].tile, index);
    return TL_OK;
}

tl_result tl_navmesh_polygon_area(const tl_navmesh *navmesh, tl_nav_ref polygon, uint8_t *area_out)
{
    uint32_t slot = 0, index = 0;
    if (area_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *area_out = 0;
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, polygon, &slot, &index)) {
        return TL_ERR_STALE;
    }
    *area_out = tl_nav_tile_area(navmesh->slots[slot].tile, index);
    return TL_OK;
}

// The copy of a slot's tile that may be written to, flags such as these too, made now if need be, also where older
// versions have the one that is there; NULL: out of memory.
static tl_nav_tile *writable_tile(tl_navmesh *navmesh, uint32_t index, uint64_t flags)
{
    tl_nav_slot *slot = &navmesh->slots[index];
    const bool is_shared = navmesh->history != NULL && slot->changed_in != navmesh->history->draft;
    const bool is_wider = flags > UINT8_MAX && (slot->tile->wide & TL_NAV_WIDE_FLAGS) == 0;
    if (slot->changed == NULL || is_shared || is_wider) {
        tl_nav_tile *copy = NULL;
        if (tl_nav_tile_copy(slot->tile, is_wider, &navmesh->allocator, &copy) != TL_OK) {
            return NULL;
        }
        slot->baked = slot->changed != NULL ? slot->baked : slot->tile;
        tl_blob_free(slot->changed); // NULL, or an older version's: it waits
        slot->changed = copy;
        slot->changed_in = navmesh->history != NULL ? navmesh->history->draft : 0;
        slot->tile = copy;
    }
    return slot->changed;
}

// Tells searches under way that have seen the tile. What is derived from tiles knows no flags and no areas, and stays.
static void note_state(tl_navmesh *navmesh, uint32_t index)
{
    const tl_nav_tile *tile = navmesh->slots[index].tile;
    const uint64_t before = navmesh->edit.number;
    tl_nav_begin_edit(navmesh, tile->tile_x, tile->tile_z);
    tl_nav_note_edit(navmesh, index);
    for (int kind = 0; kind < TL_NAV_DERIVED_KINDS; kind++) {
        if (navmesh->derived[kind] != NULL && navmesh->derived[kind]->outlive != NULL) {
            navmesh->derived[kind]->outlive(navmesh, before);
        }
    }
}

static void write_flags(tl_navmesh *navmesh, tl_nav_tile *tile, uint32_t polygon, uint64_t flags)
{
    tl_nav_count_flags(&navmesh->flags, tl_nav_tile_flags(tile, polygon), -1);
    tl_nav_count_flags(&navmesh->flags, flags, 1);
    tl_nav_tile_set_flags(tile, polygon, flags);
}

tl_result tl_navmesh_set_polygon_flags(tl_navmesh *navmesh, tl_nav_ref polygon, uint64_t flags)
{
    uint32_t slot = 0, index = 0;
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, polygon, &slot, &index)) {
        return TL_ERR_STALE;
    }
    if (tl_nav_tile_flags(navmesh->slots[slot].tile, index) == flags) {
        return TL_OK;
    }
    tl_nav_tile *tile = writable_tile(navmesh, slot, flags);
    if (tile == NULL) {
        return TL_ERR_MEMORY;
    }
    write_flags(navmesh, tile, index, flags);
    tl_nav_settle_flags(&navmesh->flags);
    note_state(navmesh, slot);
    return TL_OK;
}

tl_result tl_navmesh_set_polygon_area(tl_navmesh *navmesh, tl_nav_ref polygon, uint8_t area)
{
    uint32_t slot = 0, index = 0;
    if (navmesh == NULL || area == NO_AREA) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_split_ref(navmesh, polygon, &slot, &index)) {
        return TL_ERR_STALE;
    }
    if (tl_nav_tile_area(navmesh->slots[slot].tile, index) == area) {
        return TL_OK;
    }
    tl_nav_tile *tile = writable_tile(navmesh, slot, 0);
    if (tile == NULL) {
        return TL_ERR_MEMORY;
    }
    ((uint8_t *)tl_nav_tile_to_write(tile, tile->areas))[index] = area;
    note_state(navmesh, slot);
    return TL_OK;
}

tl_result tl_navmesh_store_state(const tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z,
                                 tl_nav_polygon_state *states_out, uint32_t capacity, uint32_t *count_out)
{
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (navmesh == NULL || (states_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    const tl_nav_tile *tile = tl_navmesh_find_layer(navmesh, tile_x, layer, tile_z);
    if (tile == NULL) {
        return TL_NOT_FOUND;
    }
    *count_out = tile->polygon_count;
    for (uint32_t p = 0; p < tile->polygon_count && p < capacity; p++) {
        memset(&states_out[p], 0, sizeof states_out[p]); // callers may file the bytes
        states_out[p].flags = tl_nav_tile_flags(tile, p);
        states_out[p].area = tl_nav_tile_area(tile, p);
    }
    return capacity < tile->polygon_count ? TL_INCOMPLETE : TL_OK;
}

static bool has_state(const tl_nav_tile *tile, const tl_nav_polygon_state *states)
{
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        if (tl_nav_tile_flags(tile, p) != states[p].flags || tl_nav_tile_area(tile, p) != states[p].area) {
            return false;
        }
    }
    return true;
}

static tl_result check_states(const tl_nav_tile *tile, const tl_nav_polygon_state *states, uint32_t count,
                              tl_report *report)
{
    if (count != tile->polygon_count) {
        return tl_report_fail(report, TL_ERR_STALE, "state", count < tile->polygon_count ? count : tile->polygon_count,
                              "restore it to the tile that it was stored of: this one has another number of polygons");
    }
    for (uint32_t p = 0; p < count; p++) {
        if (states[p].area == NO_AREA) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "state", p, "give areas from 1 to 255");
        }
    }
    return TL_OK;
}

tl_result tl_navmesh_restore_state(tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z,
                                   const tl_nav_polygon_state *states, uint32_t count, tl_report *report)
{
    tl_report_begin(report, "state");
    if (navmesh == NULL || (states == NULL && count > 0)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, navmesh == NULL ? "navmesh" : "states", "pass a pointer");
    }
    const uint32_t slot = tl_nav_find_layer_slot(navmesh, tile_x, layer, tile_z);
    if (slot == TL_NAV_NO_SLOT) {
        return TL_NOT_FOUND;
    }
    TL_TRY(check_states(navmesh->slots[slot].tile, states, count, report));
    if (has_state(navmesh->slots[slot].tile, states)) {
        return TL_OK;
    }
    uint64_t all_flags = 0;
    for (uint32_t p = 0; p < count; p++) {
        all_flags |= states[p].flags;
    }
    tl_nav_tile *tile = writable_tile(navmesh, slot, all_flags);
    if (tile == NULL) {
        return tl_report_fail(report, TL_ERR_MEMORY, NULL, TL_NO_ELEMENT, NULL);
    }
    uint8_t *areas = tl_nav_tile_to_write(tile, tile->areas);
    for (uint32_t p = 0; p < count; p++) {
        write_flags(navmesh, tile, p, states[p].flags);
        areas[p] = states[p].area;
    }
    tl_nav_settle_flags(&navmesh->flags);
    note_state(navmesh, slot);
    return TL_OK;
}

tl_result tl_navmesh_reset_state(tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z)
{
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    const uint32_t index = tl_nav_find_layer_slot(navmesh, tile_x, layer, tile_z);
    if (index == TL_NAV_NO_SLOT) {
        return TL_NOT_FOUND;
    }
    tl_nav_slot *slot = &navmesh->slots[index];
    if (slot->changed != NULL) {
        tl_nav_count_tile_flags(navmesh, slot->tile, -1);
        tl_nav_drop_changes(slot);
        tl_nav_count_tile_flags(navmesh, slot->tile, 1);
        note_state(navmesh, index);
    }
    return TL_OK;
}

bool tl_navmesh_is_state_changed(const tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z)
{
    const uint32_t slot = tl_nav_find_layer_slot(navmesh, tile_x, layer, tile_z);
    return slot != TL_NAV_NO_SLOT && navmesh->slots[slot].changed != NULL;
}
