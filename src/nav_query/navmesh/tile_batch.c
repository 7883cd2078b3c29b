// SPDX-License-Identifier: MIT
//
// Several tiles in one call. Adding: all of a list, or none. Replacing the tiles of a place by rebaked ones: a tile
// with the same bytes stays, so a change in one storey takes out that storey only, and paths and agents on the others
// keep their references.

#include "base/assert.h"
#include "base/host.h"
#include "nav_query/navmesh/navmesh.h"

#include <string.h>

// Takes the first tiles of a list out again; they stay the caller's.
static void take_back(tl_navmesh *navmesh, tl_nav_tile *const *tiles, uint32_t count)
{
    for (uint32_t i = count; i > 0; i--) {
        const tl_nav_tile *tile = tiles[i - 1];
        uint32_t slot = tl_nav_find_slot(navmesh, tile->tile_x, tile->tile_z);
        while (navmesh->slots[slot].tile != tile) {
            slot = tl_nav_next_slot(navmesh, slot);
        }
        navmesh->slots[slot].ownership = TL_NAV_TILE_BORROWED;
        tl_nav_keep(navmesh->slots[slot].keeper, NULL);
        (void)tl_navmesh_remove_layer(navmesh, tile->tile_x, tile->layer, tile->tile_z);
    }
}

static const char *advice_on(tl_result result)
{
    switch (result) {
    case TL_ERR_ARGUMENT:
        return "add one tile a place and layer, all with the same origin, cell sizes and tile_size";
    case TL_ERR_LIMIT:
        return "add fewer tiles";
    default:
        return "give it more memory";
    }
}

tl_result tl_navmesh_add_tiles(tl_navmesh *navmesh, tl_nav_tile *const *tiles, uint32_t count,
                               tl_nav_tile_ownership ownership, tl_report *report)
{
    tl_report_begin(report, "tiles");
    if (navmesh == NULL || (tiles == NULL && count > 0)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, navmesh == NULL ? "navmesh" : "tiles", "pass a pointer");
    }
    for (uint32_t i = 0; i < count; i++) {
        const tl_result result = tl_navmesh_add_tile(navmesh, tiles[i], ownership);
        if (result != TL_OK) {
            take_back(navmesh, tiles, i);
            return tl_report_fail(report, result, "tile", i, advice_on(result));
        }
    }
    return TL_OK;
}

static bool are_of_place(const tl_nav_tile_stack *stack, int32_t tile_x, int32_t tile_z)
{
    for (uint32_t i = 0; i < stack->count; i++) {
        if (stack->tiles[i]->tile_x != tile_x || stack->tiles[i]->tile_z != tile_z) {
            return false;
        }
    }
    return true;
}

// The place in the stack of a tile with these bytes, or the stack's count.
static uint32_t find_same(const tl_nav_tile_stack *stack, const tl_nav_tile *tile)
{
    uint32_t i = 0;
    while (i < stack->count && (stack->tiles[i] == NULL || stack->tiles[i]->blob.size != tile->blob.size ||
                                memcmp(stack->tiles[i], tile, (size_t)tile->blob.size) != 0)) {
        i++;
    }
    return i;
}

// Takes out what is not wanted, and off the stack what is there.
static tl_result keep_same(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z, tl_nav_tile_stack *stack)
{
    uint32_t slot = tl_nav_find_slot(navmesh, tile_x, tile_z);
    while (slot != TL_NAV_NO_SLOT) {
        const uint32_t next = tl_nav_next_slot(navmesh, slot);
        const tl_nav_slot *at = &navmesh->slots[slot];
        const tl_nav_tile *tile = at->baked != NULL ? at->baked : at->tile; // what games changed does not count
        const uint32_t same = find_same(stack, tile);
        if (same < stack->count) {
            tl_blob_free(stack->tiles[same]);
            stack->tiles[same] = NULL;
        } else {
            TL_TRY(tl_navmesh_remove_layer(navmesh, tile_x, tile->layer, tile_z));
        }
        slot = next;
    }
    return TL_OK;
}

tl_result tl_navmesh_replace_tiles(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z, tl_nav_tile_stack *stack)
{
    tl_result result = TL_ERR_ARGUMENT;
    if (navmesh == NULL || stack == NULL) {
        return result;
    }
    if (are_of_place(stack, tile_x, tile_z)) {
        result = keep_same(navmesh, tile_x, tile_z, stack);
    }
    for (uint32_t i = 0; result == TL_OK && i < stack->count; i++) {
        if (stack->tiles[i] != NULL) {
            result = tl_navmesh_add_tile(navmesh, stack->tiles[i], TL_NAV_TILE_OWNED);
            stack->tiles[i] = result == TL_OK ? NULL : stack->tiles[i];
        }
    }
    tl_nav_tile_stack_free(stack);
    return result;
}
