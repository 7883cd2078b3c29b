// SPDX-License-Identifier: MIT

#include "nav_query/navmesh/tile_seams.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

static const int32_t SIDE_STEP[TL_NAV_SIDE_COUNT][2] = { { -1, 0 }, { 0, 1 }, { 1, 0 }, { 0, -1 }, { 0, 0 } };

uint32_t tl_nav_first_facing(const tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z, uint32_t side)
{
    return tl_nav_find_slot(navmesh, (int64_t)tile_x + SIDE_STEP[side][0], (int64_t)tile_z + SIDE_STEP[side][1]);
}

void tl_nav_seams_free(const tl_navmesh *navmesh, tl_nav_seams *seams)
{
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        tl_nav_free_side(&navmesh->allocator, &seams->own[side]);
    }
    for (uint32_t i = 0; i < seams->neighbour_count; i++) {
        tl_nav_free_side(&navmesh->allocator, &seams->neighbours[i].facing);
        tl_nav_rings_free(&navmesh->allocator, &seams->neighbours[i].rings);
    }
    tl_release_array(&navmesh->allocator, seams->neighbours, seams->neighbour_capacity, sizeof *seams->neighbours);
    tl_nav_rings_free(&navmesh->allocator, &seams->rings);
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
                           uint32_t facing_slot, tl_nav_seams *seams)
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
    tl_nav_seam_neighbour *neighbour = &seams->neighbours[seams->neighbour_count];
    memset(neighbour, 0, sizeof *neighbour);
    neighbour->slot = facing_slot;
    neighbour->side = side;
    neighbour->added = facing.link_count;
    TL_TRY(extend_side(allocator, &navmesh->slots[facing_slot].sides[tl_nav_facing_side(side)], &facing,
                       &neighbour->facing));
    seams->neighbour_count++;
    return TL_OK;
}

static tl_result make_links(const tl_navmesh *navmesh, const tl_nav_tile *tile, uint32_t slot, tl_nav_seams *seams)
{
    uint32_t count = 0;
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        for (uint32_t facing = tl_nav_first_facing(navmesh, tile->tile_x, tile->tile_z, side); facing != TL_NAV_NO_SLOT;
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
        for (uint32_t facing = tl_nav_first_facing(navmesh, tile->tile_x, tile->tile_z, side); facing != TL_NAV_NO_SLOT;
             facing = tl_nav_next_slot(navmesh, facing)) {
            TL_TRY(make_link(navmesh, tile, slot, side, facing, seams));
        }
    }
    return TL_OK;
}

// The links on all sides of a tile around, with those to the new one. Rings point into the tile as it was added: a
// changed one goes before them.
static const tl_nav_tile *sides_around(const tl_navmesh *navmesh, const tl_nav_seam_neighbour *neighbour,
                                       const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT])
{
    const tl_nav_slot *slot = &navmesh->slots[neighbour->slot];
    for (uint32_t i = 0; i < TL_NAV_SIDE_COUNT; i++) {
        sides[i] = i == tl_nav_facing_side(neighbour->side) ? &neighbour->facing : &slot->sides[i];
    }
    return slot->baked != NULL ? slot->baked : slot->tile;
}

static tl_result make_tile_rings(const tl_navmesh *navmesh, const tl_nav_tile *tile, tl_nav_seams *seams)
{
    const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT];
    for (uint32_t i = 0; i < TL_NAV_SIDE_COUNT; i++) {
        sides[i] = &seams->own[i];
    }
    TL_TRY(tl_nav_rings_make(&navmesh->allocator, tile, sides, NULL, 0, &seams->rings));
    for (uint32_t n = 0; n < seams->neighbour_count; n++) {
        tl_nav_seam_neighbour *neighbour = &seams->neighbours[n];
        const tl_nav_rings *before = &navmesh->slots[neighbour->slot].rings;
        const uint32_t changed_side = tl_nav_facing_side(neighbour->side);
        const tl_nav_tile *around = sides_around(navmesh, neighbour, sides);
        neighbour->reopens = tl_nav_rings_can_reopen(before, around, sides, changed_side);
        if (!neighbour->reopens) {
            TL_TRY(tl_nav_rings_make(&navmesh->allocator, around, sides, before, changed_side, &neighbour->rings));
        }
    }
    return TL_OK;
}

tl_result tl_nav_seams_make(const tl_navmesh *navmesh, const tl_nav_tile *tile, uint32_t slot, tl_nav_seams *seams_out)
{
    memset(seams_out, 0, sizeof *seams_out);
    tl_result result = make_links(navmesh, tile, slot, seams_out);
    if (result == TL_OK) {
        result = make_tile_rings(navmesh, tile, seams_out);
    }
    if (result != TL_OK) {
        tl_nav_seams_free(navmesh, seams_out);
    }
    return result;
}

static uint32_t count_side_links(const tl_nav_side_links *sides)
{
    uint32_t count = 0;
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        count += sides[side].link_count;
    }
    return count;
}

uint32_t tl_nav_seams_most(const tl_navmesh *navmesh, const tl_nav_seams *seams)
{
    uint32_t most = count_side_links(seams->own);
    for (uint32_t n = 0; n < seams->neighbour_count; n++) {
        const tl_nav_seam_neighbour *neighbour = &seams->neighbours[n];
        const uint32_t count = count_side_links(navmesh->slots[neighbour->slot].sides) + neighbour->added;
        most = count > most ? count : most;
    }
    return most;
}

bool tl_nav_seams_remake(const tl_nav_seams *seams, uint32_t slot)
{
    for (uint32_t n = 0; seams != NULL && n < seams->neighbour_count; n++) {
        if (seams->neighbours[n].slot == slot) {
            return !seams->neighbours[n].reopens;
        }
    }
    return false;
}

void tl_nav_seams_install(tl_navmesh *navmesh, uint32_t slot, tl_nav_seams *seams)
{
    navmesh->slots[slot].rings = seams->rings;
    memcpy(navmesh->slots[slot].sides, seams->own, sizeof seams->own);
    tl_nav_note_edit(navmesh, slot);
    navmesh->link_count += count_side_links(seams->own);
    for (uint32_t n = 0; n < seams->neighbour_count; n++) {
        tl_nav_seam_neighbour *made = &seams->neighbours[n];
        tl_nav_slot *neighbour = &navmesh->slots[made->slot];
        if (made->reopens) {
            const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT];
            const tl_nav_tile *around = sides_around(navmesh, made, sides);
            tl_nav_rings_reopen(&neighbour->rings, around, sides, tl_nav_facing_side(made->side));
        } else {
            tl_nav_rings_free(&navmesh->allocator, &neighbour->rings);
            neighbour->rings = made->rings;
        }
        tl_nav_free_side(&navmesh->allocator, &neighbour->sides[tl_nav_facing_side(made->side)]);
        neighbour->sides[tl_nav_facing_side(made->side)] = made->facing;
        navmesh->link_count += made->added;
        tl_nav_note_edit(navmesh, made->slot);
    }
    tl_release_array(&navmesh->allocator, seams->neighbours, seams->neighbour_capacity, sizeof *seams->neighbours);
}

void tl_nav_unlink_slot(tl_navmesh *navmesh, uint32_t slot)
{
    const tl_nav_slot *leaving = &navmesh->slots[slot];
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        navmesh->link_count -= leaving->sides[side].link_count;
        for (uint32_t facing = tl_nav_first_facing(navmesh, leaving->tile->tile_x, leaving->tile->tile_z, side);
             facing != TL_NAV_NO_SLOT; facing = tl_nav_next_slot(navmesh, facing)) {
            uint32_t dropped = facing == slot
                                   ? 0
                                   : tl_nav_drop_links(&navmesh->allocator,
                                                       &navmesh->slots[facing].sides[tl_nav_facing_side(side)], slot);
            if (dropped > 0) {
                navmesh->link_count -= dropped;
                tl_nav_rings_close(&navmesh->slots[facing].rings, slot);
                tl_nav_note_edit(navmesh, facing);
            }
        }
    }
}
