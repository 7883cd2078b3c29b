// SPDX-License-Identifier: MIT
//
// The swap of a place's tiles for those that were made anew: what is the same byte for byte stays. So a change in one
// storey takes out that storey only, and paths and agents on the others keep their references.

#include "nav_query/navmesh/navmesh.h"

#include <string.h>

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
                                memcmp(stack->tiles[i], tile, tile->blob.size) != 0)) {
        i++;
    }
    return i;
}

// Takes out what is not wanted, and off the stack what is there.
static void keep_same(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z, tl_nav_tile_stack *stack)
{
    uint32_t slot = tl_nav_find_slot(navmesh, tile_x, tile_z);
    while (slot != TL_NAV_NO_SLOT) {
        const uint32_t next = tl_nav_next_slot(navmesh, slot);
        const tl_nav_tile *tile = navmesh->slots[slot].tile;
        const uint32_t same = find_same(stack, tile);
        if (same < stack->count) {
            tl_blob_free(stack->tiles[same]);
            stack->tiles[same] = NULL;
        } else {
            (void)tl_navmesh_remove_layer(navmesh, tile_x, tile->layer, tile_z);
        }
        slot = next;
    }
}

tl_result tl_navmesh_replace_tiles(tl_navmesh *navmesh, int32_t tile_x, int32_t tile_z, tl_nav_tile_stack *stack)
{
    tl_result result = TL_ERR_ARGUMENT;
    if (navmesh == NULL || stack == NULL) {
        return result;
    }
    if (are_of_place(stack, tile_x, tile_z)) {
        keep_same(navmesh, tile_x, tile_z, stack);
        result = TL_OK;
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
