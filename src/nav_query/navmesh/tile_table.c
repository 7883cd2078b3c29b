// SPDX-License-Identifier: MIT
//
// The table of tiles: slots with salts, found by their place through a chained hash; the layers of a place stand in one
// chain.
//
// A slot's salt changes when its tile leaves, so that an old reference to the slot is recognized. When the salts of a
// slot are used up the slot is retired: a reference never comes to mean another polygon.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_query/navmesh/area_table.h"
#include "nav_query/navmesh/fans.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/navmesh/offmesh_anchor.h"
#include "nav_query/navmesh/tile_seams.h"

#include <string.h>

enum { LAST_SALT = 0xffff };

tl_result tl_navmesh_create(const tl_allocator *allocator, tl_navmesh **navmesh_out)
{
    if (navmesh_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *navmesh_out = NULL;
    tl_navmesh *navmesh = tl_allocate_array(allocator, 1, sizeof *navmesh);
    if (navmesh == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(navmesh, 0, sizeof *navmesh);
    navmesh->allocator = tl_allocator_or_default(allocator);
    navmesh->free_slots = TL_NAV_NO_SLOT;
    *navmesh_out = navmesh;
    return TL_OK;
}

void tl_nav_drop_changes(tl_nav_slot *slot)
{
    if (slot->changed != NULL) {
        tl_blob_free(slot->changed);
        slot->tile = slot->baked;
        slot->changed = NULL;
        slot->baked = NULL;
    }
}

static void free_slot_content(tl_navmesh *navmesh, tl_nav_slot *slot)
{
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        tl_nav_free_side(&navmesh->allocator, &slot->sides[side]);
    }
    // A borrowed tile may be gone by now: its counts are not asked of it.
    tl_nav_drop_changes(slot);
    tl_nav_areas_free(&navmesh->allocator, &slot->areas, slot->rings.polygon_count);
    tl_nav_rings_free(&navmesh->allocator, &slot->rings);
    if (slot->keeper != NULL) {
        tl_release_array(&navmesh->allocator, slot->keeper, 0, 1);
        slot->keeper = NULL;
    } else if (slot->ownership == TL_NAV_TILE_OWNED && slot->tile != NULL) {
        // The navmesh was given the blob to free; const only says that queries never write to it.
        union {
            const tl_nav_tile *read;
            tl_nav_tile *write;
        } tile = { slot->tile };
        tl_blob_free(tile.write);
    }
    slot->tile = NULL;
}

void tl_nav_free_content(tl_navmesh *navmesh)
{
    for (int kind = 0; kind < TL_NAV_DERIVED_KINDS; kind++) {
        if (navmesh->derived[kind] != NULL) {
            navmesh->derived[kind]->free_all(navmesh);
        }
    }
    for (uint32_t i = 0; i < navmesh->slot_count; i++) {
        free_slot_content(navmesh, &navmesh->slots[i]);
    }
    tl_allocator allocator = navmesh->allocator;
    tl_release_array(&allocator, navmesh->slots, navmesh->slot_capacity, sizeof *navmesh->slots);
    tl_release_array(&allocator, navmesh->buckets, navmesh->bucket_count, sizeof *navmesh->buckets);
    tl_nav_free_islands(navmesh);
    tl_nav_free_offmesh(navmesh);
    tl_release_array(&allocator, navmesh->area_table, (uint64_t)navmesh->slot_capacity + 1,
                     sizeof *navmesh->area_table);
}

void tl_navmesh_destroy(tl_navmesh *navmesh)
{
    if (navmesh != NULL) {
        TL_ASSERT(navmesh->history == NULL); // else it is a version: tl_nav_versions_destroy
        tl_allocator allocator = navmesh->allocator;
        tl_nav_free_content(navmesh);
        tl_release_array(&allocator, navmesh, 1, sizeof *navmesh);
    }
}

static void chain_slot(tl_navmesh *navmesh, uint32_t slot)
{
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    uint32_t bucket = tl_nav_place_bucket(navmesh, tile->tile_x, tile->tile_z);
    navmesh->slots[slot].next = navmesh->buckets[bucket];
    navmesh->buckets[bucket] = slot;
    tl_nav_touch_slot(navmesh, slot);
    tl_nav_touch(navmesh->history, TL_NAV_PAGED_BUCKETS, bucket);
}

static void unchain_slot(tl_navmesh *navmesh, uint32_t slot)
{
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    const uint32_t bucket = tl_nav_place_bucket(navmesh, tile->tile_x, tile->tile_z);
    uint32_t *at = &navmesh->buckets[bucket];
    tl_nav_touch(navmesh->history, TL_NAV_PAGED_BUCKETS, bucket);
    while (*at != slot) {
        tl_nav_touch_slot(navmesh, *at);
        at = &navmesh->slots[*at].next;
    }
    *at = navmesh->slots[slot].next;
}

// Makes room for so many slots, and a bucket a slot, or more.
static tl_result grow_slots(tl_navmesh *navmesh, uint32_t capacity)
{
    uint32_t bucket_count = 2;
    while (bucket_count < capacity) {
        bucket_count *= 2;
    }
    tl_nav_slot *slots = tl_allocate_array(&navmesh->allocator, capacity, sizeof *slots);
    uint32_t *buckets = tl_allocate_array(&navmesh->allocator, bucket_count, sizeof *buckets);
    uint64_t *area_table = tl_allocate_array(&navmesh->allocator, (uint64_t)capacity + 1, sizeof *area_table);
    if (slots == NULL || buckets == NULL || area_table == NULL) {
        tl_release_array(&navmesh->allocator, area_table, (uint64_t)capacity + 1, sizeof *area_table);
        tl_release_array(&navmesh->allocator, slots, capacity, sizeof *slots);
        tl_release_array(&navmesh->allocator, buckets, bucket_count, sizeof *buckets);
        return TL_ERR_MEMORY;
    }
    memset(slots, 0, capacity * sizeof *slots);
    if (navmesh->slot_count > 0) {
        memcpy(slots, navmesh->slots, navmesh->slot_count * sizeof *slots);
    }
    tl_nav_area_table_fill(area_table, capacity, slots, navmesh->slot_count);
    tl_release_array(&navmesh->allocator, navmesh->area_table, (uint64_t)navmesh->slot_capacity + 1,
                     sizeof *area_table);
    tl_release_array(&navmesh->allocator, navmesh->slots, navmesh->slot_capacity, sizeof *slots);
    tl_release_array(&navmesh->allocator, navmesh->buckets, navmesh->bucket_count, sizeof *buckets);
    navmesh->area_table = area_table;
    navmesh->slots = slots;
    navmesh->slot_capacity = capacity;
    navmesh->buckets = buckets;
    navmesh->bucket_count = bucket_count;
    memset(buckets, 0xff, navmesh->bucket_count * sizeof *buckets);
    tl_nav_touch_all(navmesh->history, TL_NAV_PAGED_SLOTS, capacity);
    tl_nav_touch_all(navmesh->history, TL_NAV_PAGED_BUCKETS, navmesh->bucket_count);
    tl_nav_touch_all(navmesh->history, TL_NAV_PAGED_AREAS, (uint64_t)capacity + 1);
    for (uint32_t i = 0; i < navmesh->slot_count; i++) {
        if (slots[i].tile != NULL) {
            chain_slot(navmesh, i);
        }
    }
    return TL_OK;
}

tl_result tl_navmesh_reserve_tiles(tl_navmesh *navmesh, uint32_t count)
{
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (count > TL_NAV_MAX_TILES - navmesh->slot_count) {
        return TL_ERR_LIMIT;
    }
    if (navmesh->slot_count + count > navmesh->slot_capacity) {
        TL_TRY(grow_slots(navmesh, navmesh->slot_count + count));
    }
    return tl_nav_reserve_islands(navmesh, count);
}

// The slot that the next tile will get. Where there is none the table grows by an eighth: each slot has hundreds of
// bytes, so room to spare would be dear.
static tl_result reserve_slot(tl_navmesh *navmesh, uint32_t *slot_out)
{
    if (navmesh->free_slots == TL_NAV_NO_SLOT && navmesh->slot_count == navmesh->slot_capacity) {
        if (navmesh->slot_count >= TL_NAV_MAX_TILES) {
            return TL_ERR_LIMIT;
        }
        TL_TRY(grow_slots(navmesh, navmesh->slot_count + navmesh->slot_count / 8 + 1));
    }
    *slot_out = navmesh->free_slots != TL_NAV_NO_SLOT ? navmesh->free_slots : navmesh->slot_count;
    return TL_OK;
}

static bool same_lattice(const tl_navmesh *navmesh, const tl_nav_tile *tile)
{
    return navmesh->origin.x == tile->origin.x && navmesh->origin.y == tile->origin.y &&
           navmesh->origin.z == tile->origin.z && navmesh->cell_size == tile->cell_size &&
           navmesh->cell_height == tile->cell_height && navmesh->tile_size == tile->tile_size;
}

// Ways between polygons of the tile.
static uint64_t count_inner_links(const tl_nav_tile *tile)
{
    uint64_t count = 0;
    for (uint32_t k = 0; k < tile->corner_count; k++) {
        count += tl_nav_tile_link(tile, k) < TL_NAV_LINK_PORTAL ? 1 : 0;
    }
    return count;
}

static tl_result own_rings(tl_navmesh *navmesh, uint32_t slot)
{
    tl_nav_touch_slot(navmesh, slot);
    tl_nav_rings *rings = &navmesh->slots[slot].rings;
    return tl_nav_is_shared(navmesh->history, rings->edges.narrow) ? tl_nav_rings_copy(&navmesh->allocator, rings)
                                                                   : TL_OK;
}

// Before a tile comes, with these seams, or leaves, NULL: of the tiles around its place, what the change will write to
// and older versions have is copied. Fans reach as far as the corners of the place.
static tl_result own_surroundings(tl_navmesh *navmesh, const tl_nav_tile *tile, const tl_nav_seams *seams)
{
    const bool all = navmesh->last_fan > UINT32_MAX / 2; // number_fans
    for (uint32_t slot = 0; all && navmesh->history != NULL && slot < navmesh->slot_count; slot++) {
        if (navmesh->slots[slot].tile != NULL) {
            TL_TRY(own_rings(navmesh, slot));
        }
    }
    for (int64_t i = 0; navmesh->history != NULL && i < 9; i++) {
        for (uint32_t slot = tl_nav_find_slot(navmesh, tile->tile_x + i % 3 - 1, tile->tile_z + i / 3 - 1);
             slot != TL_NAV_NO_SLOT; slot = tl_nav_next_slot(navmesh, slot)) {
            if (navmesh->slots[slot].tile != tile && !tl_nav_seams_remake(seams, slot)) {
                TL_TRY(own_rings(navmesh, slot));
            }
        }
    }
    for (uint32_t side = 0; navmesh->history != NULL && seams == NULL && side < TL_NAV_SIDE_COUNT; side++) {
        for (uint32_t slot = tl_nav_first_facing(navmesh, tile->tile_x, tile->tile_z, side); slot != TL_NAV_NO_SLOT;
             slot = tl_nav_next_slot(navmesh, slot)) {
            tl_nav_side_links *links = &navmesh->slots[slot].sides[tl_nav_facing_side(side)];
            if (navmesh->slots[slot].tile != tile && tl_nav_is_shared(navmesh->history, links->first)) {
                TL_TRY(tl_nav_copy_side(&navmesh->allocator, links));
            }
        }
    }
    return TL_OK;
}

// Gives numbers to the turning vertices of a slot that is new, or TL_NAV_NO_SLOT, and of the sides that face its place
// in the tiles that changed since an edit began. Numbers are handed out once; before they run out, all anew.
static void number_fans(tl_navmesh *navmesh, uint32_t new_slot, int32_t tile_x, int32_t tile_z, uint64_t edit)
{
    if (navmesh->last_fan > UINT32_MAX / 2) {
        navmesh->last_fan = 0;
        for (uint32_t i = 0; i < navmesh->slot_count; i++) {
            if (navmesh->slots[i].tile != NULL) {
                tl_nav_number_fans(navmesh, i);
            }
        }
        return;
    }
    if (new_slot != TL_NAV_NO_SLOT) {
        tl_nav_number_fans(navmesh, new_slot);
    }
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        for (uint32_t slot = tl_nav_first_facing(navmesh, tile_x, tile_z, side); slot != TL_NAV_NO_SLOT;
             slot = tl_nav_next_slot(navmesh, slot)) {
            if (slot != new_slot && navmesh->slots[slot].last_edit.number >= edit) {
                tl_nav_number_fans_on_side(navmesh, slot, tl_nav_facing_side(side));
            }
        }
    }
}

void tl_nav_count_tile_flags(tl_navmesh *navmesh, const tl_nav_tile *tile, int sign)
{
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        tl_nav_count_flags(&navmesh->flags, tl_nav_tile_flags(tile, p), sign);
    }
    tl_nav_settle_flags(&navmesh->flags);
}

// What is known of all tiles so far.
static void note_tile(tl_navmesh *navmesh, const tl_nav_tile *tile)
{
    if (navmesh->tile_count == 0) {
        navmesh->extent = 0.0f;
    }
    const tl_aabb *box = &tile->bounds;
    navmesh->extent = tl_maxf(navmesh->extent, tl_maxf(fabsf(box->min.x), fabsf(box->max.x)));
    navmesh->extent = tl_maxf(navmesh->extent, tl_maxf(fabsf(box->min.z), fabsf(box->max.z)));
    tl_nav_count_tile_flags(navmesh, tile, 1);
}

// Begins a change of the tile at a place, for all that is derived from tiles too.
static void begin_edit(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z)
{
    tl_nav_begin_edit(navmesh, tile_x, tile_z);
    for (int kind = 0; kind < TL_NAV_DERIVED_KINDS; kind++) {
        if (navmesh->derived[kind] != NULL && navmesh->derived[kind]->invalidate != NULL) {
            navmesh->derived[kind]->invalidate(navmesh, tile_x, tile_z);
        }
    }
}

// What a tile brings, made before anything is changed.
typedef struct new_tile {
    tl_nav_seams seams;
    tl_nav_areas areas;
    void *keeper; // of an owned tile (tl_nav_slot)
} new_tile;

static tl_result make_new_tile(tl_navmesh *navmesh, const tl_nav_tile *tile, uint32_t slot,
                               tl_nav_tile_ownership ownership, new_tile *fresh)
{
    memset(fresh, 0, sizeof *fresh);
    TL_TRY(tl_nav_seams_make(navmesh, tile, slot, &fresh->seams));
    tl_result result = tl_nav_areas_make(&navmesh->allocator, tile, &fresh->areas);
    if (result == TL_OK) {
        result = tl_nav_reserve_islands(navmesh, fresh->seams.rings.component_count);
    }
    if (result == TL_OK) {
        result = tl_nav_reserve_seeds(navmesh, tl_nav_seams_most(navmesh, &fresh->seams), navmesh->offmesh.capacity);
    }
    if (result == TL_OK) {
        result = own_surroundings(navmesh, tile, &fresh->seams);
    }
    if (result == TL_OK && navmesh->history != NULL && ownership == TL_NAV_TILE_OWNED) {
        fresh->keeper = tl_nav_keep_tile(navmesh->history);
        result = fresh->keeper != NULL ? TL_OK : TL_ERR_MEMORY;
    }
    if (result != TL_OK) {
        tl_nav_seams_free(navmesh, &fresh->seams);
        tl_nav_areas_free(&navmesh->allocator, &fresh->areas, tile->polygon_count);
    }
    return result;
}

tl_result tl_navmesh_add_tile(tl_navmesh *navmesh, const tl_nav_tile *tile, tl_nav_tile_ownership ownership)
{
    if (navmesh == NULL || tile == NULL || (navmesh->tile_count > 0 && !same_lattice(navmesh, tile))) {
        return TL_ERR_ARGUMENT;
    }
    if (tl_nav_find_layer_slot(navmesh, tile->tile_x, tile->layer, tile->tile_z) != TL_NAV_NO_SLOT) {
        return TL_ERR_ARGUMENT;
    }
    uint32_t index = 0;
    new_tile fresh;
    TL_TRY(reserve_slot(navmesh, &index));
    TL_TRY(make_new_tile(navmesh, tile, index, ownership, &fresh));

    begin_edit(navmesh, tile->tile_x, tile->tile_z);
    const uint64_t edit = navmesh->edit.number;
    tl_nav_slot *slot = &navmesh->slots[index];
    tl_nav_keep(fresh.keeper, tile);
    if (index == navmesh->free_slots) {
        navmesh->free_slots = slot->next;
    } else {
        navmesh->slot_count++;
        slot->salt = 1;
    }
    slot->tile = tile;
    slot->ownership = ownership;
    chain_slot(navmesh, index);
    slot->keeper = fresh.keeper;
    slot->areas = fresh.areas;
    tl_nav_area_table_change(navmesh, index, 1);
    tl_nav_seams_install(navmesh, index, &fresh.seams);
    tl_nav_join_islands(navmesh, index);
    number_fans(navmesh, index, tile->tile_x, tile->tile_z, edit);
    note_tile(navmesh, tile);
    navmesh->origin = tile->origin;
    navmesh->cell_size = tile->cell_size;
    navmesh->cell_height = tile->cell_height;
    navmesh->tile_size = tile->tile_size;
    navmesh->tile_count++;
    navmesh->link_count += count_inner_links(tile);
    navmesh->polygon_count += tile->polygon_count;
    tl_nav_anchor_near(navmesh, index, false);
    tl_nav_split_islands(navmesh);
    return TL_OK;
}

static tl_result remove_slot(tl_navmesh *navmesh, uint32_t index)
{
    tl_nav_slot *slot = &navmesh->slots[index];
    TL_TRY(own_surroundings(navmesh, slot->tile, NULL));
    const int32_t tile_x = slot->tile->tile_x, tile_z = slot->tile->tile_z;
    begin_edit(navmesh, tile_x, tile_z);
    const uint64_t edit = navmesh->edit.number;
    tl_nav_note_edit(navmesh, index);
    tl_nav_leave_islands(navmesh, index);
    tl_nav_unlink_slot(navmesh, index);
    unchain_slot(navmesh, index);
    navmesh->tile_count--;
    navmesh->link_count -= count_inner_links(slot->tile);
    navmesh->polygon_count -= slot->tile->polygon_count;
    tl_nav_area_table_change(navmesh, index, -1);
    tl_nav_count_tile_flags(navmesh, slot->tile, -1);
    free_slot_content(navmesh, slot);
    tl_nav_anchor_near(navmesh, index, true);
    tl_nav_split_islands(navmesh);
    number_fans(navmesh, TL_NAV_NO_SLOT, tile_x, tile_z, edit);
    if (slot->salt < LAST_SALT) {
        slot->salt++;
        slot->next = navmesh->free_slots;
        navmesh->free_slots = index;
    }
    return TL_OK;
}

tl_result tl_navmesh_remove_layer(tl_navmesh *navmesh, int32_t tile_x, uint32_t layer, int32_t tile_z)
{
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    uint32_t index = tl_nav_find_layer_slot(navmesh, tile_x, layer, tile_z);
    if (index == TL_NAV_NO_SLOT) {
        return TL_NOT_FOUND;
    }
    return remove_slot(navmesh, index);
}

tl_result tl_navmesh_remove_tile(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z)
{
    if (navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    uint32_t index = tl_nav_find_slot(navmesh, tile_x, tile_z);
    if (index == TL_NAV_NO_SLOT) {
        return TL_NOT_FOUND;
    }
    for (; index != TL_NAV_NO_SLOT; index = tl_nav_find_slot(navmesh, tile_x, tile_z)) {
        TL_TRY(remove_slot(navmesh, index));
    }
    return TL_OK;
}
