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
#include "nav_query/navmesh/tile_links.h"

#include <string.h>

enum { LAST_SALT = 0xffff };

static const int32_t SIDE_STEP[TL_NAV_SIDE_COUNT][2] = { { -1, 0 }, { 0, 1 }, { 1, 0 }, { 0, -1 }, { 0, 0 } };

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

// Makes room for a quarter more slots: each has hundreds of bytes, so room to spare would be dear. Two buckets a slot,
// or more.
static tl_result grow_slots(tl_navmesh *navmesh)
{
    if (navmesh->slot_count >= TL_NAV_MAX_TILES) {
        return TL_ERR_LIMIT;
    }
    const uint32_t capacity = navmesh->slot_capacity == 0 ? 1 : navmesh->slot_capacity + navmesh->slot_capacity / 4 + 3;
    uint32_t bucket_count = 2;
    while (bucket_count < 2 * capacity) {
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

// The slot that the next tile will get.
static tl_result reserve_slot(tl_navmesh *navmesh, uint32_t *slot_out)
{
    if (navmesh->free_slots == TL_NAV_NO_SLOT && navmesh->slot_count == navmesh->slot_capacity) {
        TL_TRY(grow_slots(navmesh));
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

static uint64_t count_inner_links(const tl_nav_tile *tile)
{
    const uint32_t *links = tl_nav_tile_at(tile, tile->links);
    uint64_t count = 0;
    for (uint32_t k = 0; k < tile->corner_count; k++) {
        count += links[k] < TL_NAV_LINK_PORTAL ? 1 : 0;
    }
    return count;
}

// A tile around a new one that gets links to it: what becomes of its facing side and its rings.
typedef struct seam_neighbour {
    uint32_t slot, side; // the new tile's side
    uint32_t added;      // links
    tl_nav_side_links facing;
    tl_nav_rings rings;
} seam_neighbour;

// What a new tile brings: links of its sides and of its neighbours' facing ones, its own rings and theirs, areas. All
// made before anything is changed.
typedef struct seam_set {
    seam_neighbour *neighbours; // [capacity]
    uint32_t neighbour_count, neighbour_capacity;
    tl_nav_side_links own[TL_NAV_SIDE_COUNT];
    tl_nav_rings rings;
    tl_nav_areas areas;
    void *keeper; // of an owned tile (tl_nav_slot)
} seam_set;

// Of the tiles that a side faces: the first one's slot; tl_nav_next_slot gives the others. Beyond a cut lies the place
// itself.
static uint32_t first_facing(const tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z, uint32_t side)
{
    return tl_nav_find_slot(navmesh, (int64_t)tile_x + SIDE_STEP[side][0], (int64_t)tile_z + SIDE_STEP[side][1]);
}

static void free_seams(const tl_navmesh *navmesh, const tl_nav_tile *tile, seam_set *seams)
{
    tl_release_array(&navmesh->allocator, seams->keeper, 0, 1);
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        tl_nav_free_side(&navmesh->allocator, &seams->own[side]);
    }
    for (uint32_t i = 0; i < seams->neighbour_count; i++) {
        tl_nav_free_side(&navmesh->allocator, &seams->neighbours[i].facing);
        tl_nav_rings_free(&navmesh->allocator, &seams->neighbours[i].rings);
    }
    tl_release_array(&navmesh->allocator, seams->neighbours, seams->neighbour_capacity, sizeof *seams->neighbours);
    tl_nav_rings_free(&navmesh->allocator, &seams->rings);
    tl_nav_areas_free(&navmesh->allocator, &seams->areas, tile->polygon_count);
}

// Adds fresh links to those of a side, which may have none yet. Takes the fresh ones over, also on failure.
static tl_result extend_side(const tl_allocator *allocator, const tl_nav_side_links *side, tl_nav_side_links *fresh,
                             tl_nav_side_links *out)
{
    if (side->first == NULL) {
        *out = *fresh;
        return TL_OK;
    }
    const tl_result result = tl_nav_join_sides(allocator, side, fresh, out);
    tl_nav_free_side(allocator, fresh);
    return result;
}

// Links the new tile with one that a side of it faces, if there is anything to link.
static tl_result make_link(const tl_navmesh *navmesh, const tl_nav_tile *tile, uint32_t slot, uint32_t side,
                           uint32_t facing_slot, seam_set *seams)
{
    const tl_allocator *allocator = &navmesh->allocator;
    tl_nav_side_links own, facing, joined;
    const tl_nav_tile_side near = { tile, slot, side };
    const tl_nav_tile_side far = { navmesh->slots[facing_slot].tile, facing_slot, tl_nav_facing_side(side) };
    TL_TRY(tl_nav_link_sides(allocator, &near, &far, &own, &facing));
    if (own.link_count == 0) {
        return TL_OK;
    }
    tl_result result = extend_side(allocator, &seams->own[side], &own, &joined);
    if (result != TL_OK) {
        tl_nav_free_side(allocator, &facing);
        return result;
    }
    if (joined.first != own.first) {
        tl_nav_free_side(allocator, &seams->own[side]);
    }
    seams->own[side] = joined;
    seam_neighbour *neighbour = &seams->neighbours[seams->neighbour_count];
    memset(neighbour, 0, sizeof *neighbour);
    neighbour->slot = facing_slot;
    neighbour->side = side;
    neighbour->added = facing.link_count;
    TL_TRY(extend_side(allocator, &navmesh->slots[facing_slot].sides[tl_nav_facing_side(side)], &facing,
                       &neighbour->facing));
    seams->neighbour_count++;
    return TL_OK;
}

static tl_result make_links(const tl_navmesh *navmesh, const tl_nav_tile *tile, uint32_t slot, seam_set *seams)
{
    uint32_t count = 0;
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        for (uint32_t facing = first_facing(navmesh, tile->tile_x, tile->tile_z, side); facing != TL_NAV_NO_SLOT;
             facing = tl_nav_next_slot(navmesh, facing)) {
            count++;
        }
    }
    seams->neighbours = tl_allocate_array(&navmesh->allocator, count, sizeof *seams->neighbours);
    if (seams->neighbours == NULL) {
        return TL_ERR_MEMORY;
    }
    seams->neighbour_capacity = count;
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        for (uint32_t facing = first_facing(navmesh, tile->tile_x, tile->tile_z, side); facing != TL_NAV_NO_SLOT;
             facing = tl_nav_next_slot(navmesh, facing)) {
            TL_TRY(make_link(navmesh, tile, slot, side, facing, seams));
        }
    }
    return TL_OK;
}

static tl_result make_tile_rings(const tl_navmesh *navmesh, const tl_nav_tile *tile, seam_set *seams)
{
    const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT];
    for (uint32_t i = 0; i < TL_NAV_SIDE_COUNT; i++) {
        sides[i] = &seams->own[i];
    }
    TL_TRY(tl_nav_rings_make(&navmesh->allocator, tile, sides, NULL, 0, &seams->rings));
    for (uint32_t n = 0; n < seams->neighbour_count; n++) {
        seam_neighbour *neighbour = &seams->neighbours[n];
        const tl_nav_slot *slot = &navmesh->slots[neighbour->slot];
        for (uint32_t i = 0; i < TL_NAV_SIDE_COUNT; i++) {
            sides[i] = i == tl_nav_facing_side(neighbour->side) ? &neighbour->facing : &slot->sides[i];
        }
        TL_TRY(tl_nav_rings_make(&navmesh->allocator, slot->tile, sides, &slot->rings,
                                 tl_nav_facing_side(neighbour->side), &neighbour->rings));
    }
    return TL_OK;
}

static tl_result make_seams(const tl_navmesh *navmesh, const tl_nav_tile *tile, uint32_t slot, seam_set *seams)
{
    memset(seams, 0, sizeof *seams);
    tl_result result = make_links(navmesh, tile, slot, seams);
    if (result == TL_OK) {
        result = make_tile_rings(navmesh, tile, seams);
    }
    if (result == TL_OK) {
        result = tl_nav_areas_make(&navmesh->allocator, tile, &seams->areas);
    }
    if (result != TL_OK) {
        free_seams(navmesh, tile, seams);
    }
    return result;
}

static bool is_remade(const seam_set *seams, uint32_t slot)
{
    for (uint32_t n = 0; seams != NULL && n < seams->neighbour_count; n++) {
        if (seams->neighbours[n].slot == slot) {
            return true;
        }
    }
    return false;
}

static tl_result own_rings(tl_navmesh *navmesh, uint32_t slot)
{
    tl_nav_touch_slot(navmesh, slot);
    tl_nav_rings *rings = &navmesh->slots[slot].rings;
    return tl_nav_is_shared(navmesh->history, rings->block) ? tl_nav_rings_copy(&navmesh->allocator, rings) : TL_OK;
}

// Before a tile comes, with these seams, or leaves, NULL: of the tiles around its place, what the change will write to
// and older versions have is copied. Fans reach as far as the corners of the place.
static tl_result own_surroundings(tl_navmesh *navmesh, const tl_nav_tile *tile, const seam_set *seams)
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
            if (navmesh->slots[slot].tile != tile && !is_remade(seams, slot)) {
                TL_TRY(own_rings(navmesh, slot));
            }
        }
    }
    for (uint32_t side = 0; navmesh->history != NULL && seams == NULL && side < TL_NAV_SIDE_COUNT; side++) {
        for (uint32_t slot = first_facing(navmesh, tile->tile_x, tile->tile_z, side); slot != TL_NAV_NO_SLOT;
             slot = tl_nav_next_slot(navmesh, slot)) {
            tl_nav_side_links *links = &navmesh->slots[slot].sides[tl_nav_facing_side(side)];
            if (navmesh->slots[slot].tile != tile && tl_nav_is_shared(navmesh->history, links->first)) {
                TL_TRY(tl_nav_copy_side(&navmesh->allocator, links));
            }
        }
    }
    return TL_OK;
}

static void install_seams(tl_navmesh *navmesh, uint32_t slot, seam_set *seams)
{
    navmesh->slots[slot].keeper = seams->keeper;
    navmesh->slots[slot].rings = seams->rings;
    navmesh->slots[slot].areas = seams->areas;
    memcpy(navmesh->slots[slot].sides, seams->own, sizeof seams->own);
    tl_nav_area_table_change(navmesh, slot, 1);
    tl_nav_note_edit(navmesh, slot);
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        navmesh->link_count += seams->own[side].link_count;
    }
    for (uint32_t n = 0; n < seams->neighbour_count; n++) {
        seam_neighbour *made = &seams->neighbours[n];
        tl_nav_slot *neighbour = &navmesh->slots[made->slot];
        tl_nav_free_side(&navmesh->allocator, &neighbour->sides[tl_nav_facing_side(made->side)]);
        neighbour->sides[tl_nav_facing_side(made->side)] = made->facing;
        navmesh->link_count += made->added;
        tl_nav_rings_free(&navmesh->allocator, &neighbour->rings);
        neighbour->rings = made->rings;
        tl_nav_note_edit(navmesh, made->slot);
    }
    tl_release_array(&navmesh->allocator, seams->neighbours, seams->neighbour_capacity, sizeof *seams->neighbours);
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
        for (uint32_t slot = first_facing(navmesh, tile_x, tile_z, side); slot != TL_NAV_NO_SLOT;
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

tl_result tl_navmesh_add_tile(tl_navmesh *navmesh, const tl_nav_tile *tile, tl_nav_tile_ownership ownership)
{
    if (navmesh == NULL || tile == NULL || (navmesh->tile_count > 0 && !same_lattice(navmesh, tile))) {
        return TL_ERR_ARGUMENT;
    }
    if (tl_nav_find_layer_slot(navmesh, tile->tile_x, tile->layer, tile->tile_z) != TL_NAV_NO_SLOT) {
        return TL_ERR_ARGUMENT;
    }
    uint32_t index = 0;
    seam_set seams;
    TL_TRY(reserve_slot(navmesh, &index));
    TL_TRY(make_seams(navmesh, tile, index, &seams));
    tl_result reserved = tl_nav_reserve_islands(navmesh, seams.rings.component_count);
    if (reserved == TL_OK) {
        reserved = own_surroundings(navmesh, tile, &seams);
    }
    if (reserved == TL_OK && navmesh->history != NULL && ownership == TL_NAV_TILE_OWNED) {
        seams.keeper = tl_nav_keep_tile(navmesh->history);
        reserved = seams.keeper != NULL ? TL_OK : TL_ERR_MEMORY;
    }
    if (reserved != TL_OK) {
        free_seams(navmesh, tile, &seams);
        return reserved;
    }

    begin_edit(navmesh, tile->tile_x, tile->tile_z);
    const uint64_t edit = navmesh->edit.number;
    tl_nav_slot *slot = &navmesh->slots[index];
    tl_nav_keep(seams.keeper, tile);
    if (index == navmesh->free_slots) {
        navmesh->free_slots = slot->next;
    } else {
        navmesh->slot_count++;
        slot->salt = 1;
    }
    slot->tile = tile;
    slot->ownership = ownership;
    slot->inner_links = count_inner_links(tile);
    chain_slot(navmesh, index);
    install_seams(navmesh, index, &seams);
    tl_nav_join_islands(navmesh, index);
    number_fans(navmesh, index, tile->tile_x, tile->tile_z, edit);
    note_tile(navmesh, tile);
    navmesh->origin = tile->origin;
    navmesh->cell_size = tile->cell_size;
    navmesh->cell_height = tile->cell_height;
    navmesh->tile_size = tile->tile_size;
    navmesh->tile_count++;
    navmesh->link_count += slot->inner_links;
    navmesh->polygon_count += tile->polygon_count;
    tl_nav_anchor_near(navmesh, index, false);
    tl_nav_split_islands(navmesh);
    return TL_OK;
}

// Takes the links to a slot out of the tiles around it.
static void unlink_slot(tl_navmesh *navmesh, uint32_t index)
{
    const tl_nav_slot *slot = &navmesh->slots[index];
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        navmesh->link_count -= slot->sides[side].link_count;
        for (uint32_t facing = first_facing(navmesh, slot->tile->tile_x, slot->tile->tile_z, side);
             facing != TL_NAV_NO_SLOT; facing = tl_nav_next_slot(navmesh, facing)) {
            uint32_t dropped = facing == index
                                   ? 0
                                   : tl_nav_drop_links(&navmesh->allocator,
                                                       &navmesh->slots[facing].sides[tl_nav_facing_side(side)], index);
            if (dropped > 0) {
                navmesh->link_count -= dropped;
                tl_nav_rings_close(&navmesh->slots[facing].rings, index);
                tl_nav_note_edit(navmesh, facing);
            }
        }
    }
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
    unlink_slot(navmesh, index);
    unchain_slot(navmesh, index);
    navmesh->tile_count--;
    navmesh->link_count -= slot->inner_links;
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
