// SPDX-License-Identifier: MIT
//
// A tile divided into layers: tiles of some of its polygons each, with cuts where they were linked.
//
// Layers are made from the finished tile, so that contours, polygons and detail are those of the whole place: nothing
// is cut that was not an edge before, and the two sides of a cut have the same two vertices. To divide the floors
// before (heightfield layers, as others do) simplifies both sides of each cut by themselves, and has to mend what then
// no longer fits.

#include "nav_format/tile_subset.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/radix_sort.h"

#include <string.h>

// Where the polygon across has the same edge; it is there, since links are mutual.
static uint32_t twin_corner(const tl_nav_tile *tile, uint32_t p, uint32_t k)
{
    const uint32_t q = tl_nav_tile_link(tile, k);
    const uint32_t end = tl_nav_tile_corner_vertex(tile, tl_nav_tile_next_corner(tile, p, k));
    uint32_t twin = tl_nav_tile_first_corner(tile, q);
    while (tl_nav_tile_link(tile, twin) != p || tl_nav_tile_corner_vertex(tile, twin) != end) {
        twin++;
    }
    TL_ASSERT(twin < tl_nav_tile_first_corner(tile, q + 1));
    return twin;
}

// Numbers the cuts of each pair of vertices. All but the first are of floors that lie upon each other.
static tl_result number_cuts(const tl_nav_tile *tile, const uint32_t *layers, tl_arena *arena, uint32_t *ordinals)
{
    tl_sort_item *items = TL_PUSH(arena, tl_sort_item, tile->corner_count);
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, tile->corner_count);
    if (items == NULL || scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, p);
        for (uint32_t k = corners.begin; k < corners.end; k++) {
            const uint32_t across = tl_nav_tile_link(tile, k);
            if (across < TL_NAV_LINK_PORTAL && across > p && layers[across] != layers[p]) {
                const uint32_t a = tl_nav_tile_corner_vertex(tile, k);
                const uint32_t b = tl_nav_tile_corner_vertex(tile, tl_nav_tile_next_corner(tile, p, k));
                const uint64_t key = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
                tl_sort_item item = { key, k, p };
                items[count++] = item;
            }
        }
    }
    tl_radix_sort(items, scratch, count);
    for (uint32_t i = 0, ordinal = 0; i < count; i++) {
        ordinal = i > 0 && items[i].key == items[i - 1].key ? ordinal + 1 : 0;
        ordinals[items[i].value] = ordinals[twin_corner(tile, items[i].extra, items[i].value)] = ordinal;
    }
    return TL_OK;
}

// The lowest number above `layer`, or from 0 on when that is UINT32_MAX; UINT32_MAX: there is none.
static uint32_t next_layer(const tl_nav_tile *tile, const uint32_t *layers, uint32_t layer)
{
    uint32_t next = UINT32_MAX;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        next = (layer == UINT32_MAX || layers[p] > layer) && layers[p] < next ? layers[p] : next;
    }
    return next;
}

static tl_result make_layers(const tl_nav_tile *tile, const tl_nav_layering *layering, const tl_allocator *allocator,
                             tl_nav_tile_stack *stack, tl_report *report)
{
    uint32_t count = 0;
    for (uint32_t layer = next_layer(tile, layering->layers, UINT32_MAX); layer != UINT32_MAX;
         layer = next_layer(tile, layering->layers, layer)) {
        count++;
    }
    stack->tiles = tl_allocate_array(allocator, count, sizeof(*stack->tiles));
    if (stack->tiles == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(stack->tiles, 0, count * sizeof(*stack->tiles));
    stack->count = count;
    stack->allocator = tl_allocator_or_default(allocator);
    for (uint32_t i = 0, layer = UINT32_MAX; i < count; i++) {
        layer = next_layer(tile, layering->layers, layer);
        TL_TRY(tl_nav_tile_layer(tile, layering, layer, allocator, &stack->tiles[i], report));
    }
    return TL_OK;
}

tl_result tl_nav_tile_divide(const tl_nav_tile *tile, const uint32_t *layers, const tl_allocator *allocator,
                             tl_nav_tile_stack *stack_out, tl_report *report_out)
{
    tl_report_begin(report_out, "divide tile");
    TL_REFUSE_NULL(stack_out, report_out);
    memset(stack_out, 0, sizeof *stack_out);
    TL_REFUSE_NULL(tile, report_out);
    TL_REFUSE_NULL(layers, report_out);
    tl_report_begin(report_out, "divide tile");
    if (tile->layer != 0 || tl_nav_tile_side_first(tile, TL_NAV_SIDE_CUT) < tile->portal_count) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "tile", "divide the whole tile: this is a layer already");
    }
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        if (layers[p] > TL_NAV_MAX_LAYER) {
            return tl_report_fail(report_out, TL_ERR_ARGUMENT, "polygon", p, "give layers of 0 to 65535");
        }
    }
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    uint32_t *ordinals = TL_PUSH_ZERO(&arena, uint32_t, tile->corner_count);
    tl_result result = ordinals != NULL ? number_cuts(tile, layers, &arena, ordinals) : TL_ERR_MEMORY;
    if (result == TL_OK) {
        const tl_nav_layering layering = { layers, ordinals };
        result = make_layers(tile, &layering, allocator, stack_out, report_out);
    }
    tl_arena_free(&arena);
    if (result != TL_OK) {
        tl_nav_tile_stack_free(stack_out);
    }
    return result;
}

void tl_nav_tile_stack_free(tl_nav_tile_stack *stack)
{
    if (stack != NULL) {
        tl_blob_array_free(&stack->allocator, stack->tiles, stack->count);
        memset(stack, 0, sizeof *stack);
    }
}
